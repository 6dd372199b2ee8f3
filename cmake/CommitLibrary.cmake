# SPDX-License-Identifier: Apache-2.0
# skein_commit: objects that define skein::kCommit and skein::kCommitDate (Commit.cmake), for the program and the benchmarks.
# The source is looked at with every build, and rewritten only if the commit, or what is not committed yet, has changed.
set(commit_source ${PROJECT_BINARY_DIR}/commit.cpp)
add_custom_target(
  skein_commit_source
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${commit_source}
          -P ${CMAKE_CURRENT_LIST_DIR}/Commit.cmake
  BYPRODUCTS ${commit_source}
  VERBATIM)
add_library(skein_commit OBJECT ${commit_source})
add_dependencies(skein_commit skein_commit_source)
