# SPDX-License-Identifier: Apache-2.0
# For tests of a SCRIPT that checks a repository: small ones, made in the folder SCRATCH.
find_program(PYTHON python3)
if(NOT PYTHON)
  message("skipped: no python3")
endif()

# expect(EXIT_CODE PATTERN path text [path text ...]): of a repository of these files.
function(expect exit_code pattern)
  file(REMOVE_RECURSE ${SCRATCH})
  while(ARGN)
    list(POP_FRONT ARGN path text)
    file(WRITE ${SCRATCH}/${path} "${text}\n")
  endwhile()
  execute_process(COMMAND git init -q ${SCRATCH} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${PYTHON} -I -S ${SCRIPT} ${SCRATCH} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL exit_code OR NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "${pattern} expected, but exit code ${result} and:\n${output}")
  endif()
endfunction()
