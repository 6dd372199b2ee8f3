# SPDX-License-Identifier: Apache-2.0
# Builds PAGE, the page of skein report, from the FILES of SOURCE in the folder WORK with NPM. What fails is said, and
# no error: the program then says that it has no page.
foreach(file IN LISTS FILES)
  configure_file(${SOURCE}/${file} ${WORK}/${file} COPYONLY)
endforeach()

function(run_npm)
  execute_process(COMMAND ${NPM} ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  set(npm_failed ${result} PARENT_SCOPE)
  set(npm_output "${output}" PARENT_SCOPE)
endfunction()

# Packages are fetched when the lock file is another one: by npm install, which takes the versions of the lock file, too, but
# which registries that lack some other platform's packages can serve.
file(SHA256 ${WORK}/package-lock.json lock)
set(installed "")
if(EXISTS ${WORK}/installed)
  file(READ ${WORK}/installed installed)
endif()
if(NOT installed STREQUAL lock)
  run_npm(install --prefer-offline --no-audit --no-fund --fetch-retries=1 --fetch-timeout=20000)
  if(npm_failed)
    message(STATUS "The page of skein report is not built: npm install failed (no network?)\n${npm_output}")
    return()
  endif()
  file(WRITE ${WORK}/installed ${lock})
endif()
run_npm(run build)
if(npm_failed)
  message(FATAL_ERROR "The page of skein report does not build:\n${npm_output}")
endif()
configure_file(${WORK}/dist/report.html ${PAGE} COPYONLY)
