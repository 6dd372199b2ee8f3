# SPDX-License-Identifier: Apache-2.0
# Runs SCRIPT with ARGUMENTS, without installed Python packages and with SEARCH_PATH (if any) as the PATH, and checks its
# exit code and that PATTERN matches all it printed. What prints that it is skipped is not checked. The folder
# SCRATCH (if any) is for its temporary files; it is removed, unless the test fails.
find_program(PYTHON python3)
if(NOT PYTHON)
  message("skipped: no python3")
  return()
endif()
if(SEARCH_PATH)
  # A launcher of Python versions needs the PATH itself; what it launches does not.
  execute_process(COMMAND ${PYTHON} -c "import sys; print(sys.executable)" OUTPUT_VARIABLE PYTHON
                  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(ENV{PATH} ${SEARCH_PATH})
endif()
if(SCRATCH)
  file(REMOVE_RECURSE ${SCRATCH})
  file(MAKE_DIRECTORY ${SCRATCH})
  set(ENV{TMPDIR} ${SCRATCH})
endif()
execute_process(COMMAND ${PYTHON} -I -S ${SCRIPT} ${ARGUMENTS} RESULT_VARIABLE code OUTPUT_VARIABLE output
                ERROR_VARIABLE output)
if(output MATCHES "^skipped: ")
  message("${output}")
  return()
endif()
if(NOT code STREQUAL EXIT_CODE OR NOT output MATCHES "${PATTERN}")
  message(FATAL_ERROR "${SCRIPT} ${ARGUMENTS}: exit code ${code} (${EXIT_CODE} expected), and it printed:\n${output}\n"
                      "where this was to match: ${PATTERN}")
endif()
if(SCRATCH)
  file(REMOVE_RECURSE ${SCRATCH})
endif()
