# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a C++ source that defines skein::kCommit and skein::kCommitDate, commit and its date of the git work
# tree SOURCE, if it is not so already: runs with every build, and costs a compilation of these lines only if that has changed.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/GitCommit.cmake)
find_git_commit(${SOURCE} %cs)
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "namespace skein {
extern const char* const kCommit;
const char* const kCommit = \"@commit@\";
extern const char* const kCommitDate;
const char* const kCommitDate = \"@formatted_commit@\";
}  // namespace skein
" @ONLY)
