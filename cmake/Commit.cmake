# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a C++ source that defines skein::kCommit with the commit of the git work tree SOURCE, if it is not so
# already: runs with every build, and costs a compilation of these lines only after a commit.
cmake_minimum_required(VERSION 3.25)
set(commit unknown)
find_program(git git)
if(git)
  # SOURCE may lie unpacked inside another work tree, whose commit says nothing about it.
  execute_process(COMMAND ${git} -C ${SOURCE} rev-parse --show-toplevel OUTPUT_VARIABLE top ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  get_filename_component(top "${top}" REALPATH)
  get_filename_component(source "${SOURCE}" REALPATH)
  if(top STREQUAL source)
    execute_process(COMMAND ${git} -C ${SOURCE} describe --always --dirty --abbrev=10 --match=
                    OUTPUT_VARIABLE description ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failure)
    if(NOT failure)
      set(commit ${description})
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "namespace skein {
extern const char* const kCommit;
const char* const kCommit = \"@commit@\";
}  // namespace skein
" @ONLY)
