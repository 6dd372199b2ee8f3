# SPDX-License-Identifier: Apache-2.0
# Builds PAGE, the page of skein report, from the FILES of SOURCE in the folder WORK with NPM. Packages that cannot be
# had are said, and no error: the program then says that it has no page. What fails leaves no page of earlier sources.
file(REMOVE ${PAGE})
file(REMOVE_RECURSE ${WORK}/src ${WORK}/tests) # tsc and vitest read all that is there
foreach(file IN LISTS FILES)
  configure_file(${SOURCE}/${file} ${WORK}/${file} COPYONLY)
endforeach()

function(run_npm)
  execute_process(COMMAND ${NPM} ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  set(npm_failed ${result} PARENT_SCOPE)
  set(npm_output "${output}" PARENT_SCOPE)
endfunction()

# The lock file whose packages were installed, or could not be, by its hash; nothing if there was none.
function(read_lock name)
  set(lock "")
  if(EXISTS ${WORK}/${name})
    file(READ ${WORK}/${name} lock)
  endif()
  set(${name} "${lock}" PARENT_SCOPE)
endfunction()

# Packages are fetched when the lock file is another one: by npm install, which takes the versions of the lock file, too, but
# which registries that lack some other platform's packages can serve. A registry is asked once, not in every build.
file(SHA256 ${WORK}/package-lock.json lock)
read_lock(installed)
read_lock(unreachable)
if(NOT installed STREQUAL lock)
  set(retry "scripts/setup --viewer lets the next build ask again")
  if(unreachable STREQUAL lock)
    message(STATUS "The page of skein report is not built: its packages could not be had; ${retry}")
    return()
  endif()
  file(REMOVE ${WORK}/installed)
  run_npm(install --prefer-offline --no-audit --no-fund --fetch-retries=0 --fetch-timeout=20000)
  if(npm_failed)
    file(WRITE ${WORK}/unreachable ${lock})
    message(STATUS "The page of skein report is not built: npm install failed (no network?); ${retry}\n${npm_output}")
    return()
  endif()
  file(WRITE ${WORK}/installed ${lock})
endif()
run_npm(run build)
if(npm_failed)
  message(FATAL_ERROR "The page of skein report does not build:\n${npm_output}")
endif()
configure_file(${WORK}/dist/report.html ${PAGE} COPYONLY)
