# SPDX-License-Identifier: Apache-2.0
# When the page of skein report is built, and when it is left out: a project of the viewer alone is built with a Node and an
# npm that only pretend.
file(REMOVE_RECURSE ${SCRATCH})
file(COPY ${ROOT}/viewer/CMakeLists.txt DESTINATION ${SCRATCH}/viewer)
file(COPY ${ROOT}/cmake/BuildViewer.cmake DESTINATION ${SCRATCH}/cmake)
file(WRITE ${SCRATCH}/CMakeLists.txt [[
cmake_minimum_required(VERSION 3.25)
project(page NONE)
set(CMAKE_INSTALL_DATADIR share)
set(SKEIN_VIEWER_BUILD ${PROJECT_BINARY_DIR}/page_build)
add_subdirectory(viewer)
]])
set(page ${SCRATCH}/build/viewer/report.html)

# write_program(NAME line ...): a shell script.
function(write_program name)
  list(JOIN ARGN "\n" lines)
  file(WRITE ${SCRATCH}/${name} "#!/bin/sh\n${lines}\n")
  file(CHMOD ${SCRATCH}/${name} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endfunction()

# write_npm(EXIT_CODE): one that counts its installations, which end so, and builds a page that is the lock file.
function(write_npm exit_code)
  write_program(npm "test $1 = run && mkdir -p dist && exec cp package-lock.json dist/report.html"
                "echo install >> ${SCRATCH}/installations" "exit ${exit_code}")
endfunction()

# expect(PAGE INSTALLATIONS NODE PATTERN): a build with that Node ends well, prints what matches, and leaves that page
# (nothing if there is to be none) after so many installations in all.
function(expect page_text installations node pattern)
  write_program(node "echo v${node}")
  execute_process(COMMAND ${CMAKE_COMMAND} -G ${GENERATOR} -S ${SCRATCH} -B ${SCRATCH}/build -DSKEIN_NODE=${SCRATCH}/node
                          -DSKEIN_NPM=${SCRATCH}/npm OUTPUT_VARIABLE configured COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${SCRATCH}/build OUTPUT_VARIABLE built COMMAND_ERROR_IS_FATAL ANY)
  set(found "")
  if(EXISTS ${page})
    file(READ ${page} found)
  endif()
  file(STRINGS ${SCRATCH}/installations calls)
  list(LENGTH calls count)
  if(NOT found STREQUAL page_text OR NOT count EQUAL installations OR NOT "${configured}${built}" MATCHES "${pattern}")
    message(FATAL_ERROR "page '${found}' ('${page_text}' expected), ${count} installations (${installations} expected), printed:\n"
                        "${configured}${built}\nwhere this was to match: ${pattern}")
  endif()
endfunction()

file(TOUCH ${SCRATCH}/installations)
set(lock_file ${SCRATCH}/viewer/package-lock.json)
file(WRITE ${lock_file} first)
write_npm(0)
expect("" 0 16.20.2 "With Node 16.20.2, which is older than 18: skein report has no page")
expect(first 1 18.0.0 "")
expect(first 1 22.1.0 "") # nothing has changed

# A lock file whose packages cannot be had: no page of the earlier one, and npm is asked once.
file(WRITE ${lock_file} second)
write_npm(1)
expect("" 2 22.1.0 "The page of skein report is not built: npm install failed")
expect("" 2 22.1.0 "its packages could not be had; scripts/setup --viewer")
write_npm(0)
expect("" 2 22.1.0 "")
file(REMOVE ${SCRATCH}/build/page_build/unreachable)
expect(second 3 22.1.0 "")

# A source that is gone is gone where the page is built.
foreach(folder src tests)
  file(WRITE ${SCRATCH}/viewer/${folder}/kept.ts "")
  file(WRITE ${SCRATCH}/viewer/${folder}/gone.ts "")
endforeach()
expect(second 3 22.1.0 "")
file(REMOVE ${SCRATCH}/viewer/src/gone.ts ${SCRATCH}/viewer/tests/gone.ts)
expect(second 3 22.1.0 "")
file(GLOB_RECURSE copied RELATIVE ${SCRATCH}/build/page_build ${SCRATCH}/build/page_build/*.ts)
if(NOT copied STREQUAL "src/kept.ts;tests/kept.ts")
  message(FATAL_ERROR "the page is built from the sources ${copied}")
endif()

# Neither is a page left for which Node has become too old.
expect("" 3 17.9.1 "older than 18")
expect(second 3 18.0.0 "")
