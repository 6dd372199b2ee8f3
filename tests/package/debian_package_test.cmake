# SPDX-License-Identifier: Apache-2.0
# The Debian packages that CPack makes of the build tree: what is in them, what they depend on, and that they fly.
find_program(shlibdeps dpkg-shlibdeps)
if(NOT shlibdeps)
  message("skipped: no dpkg-shlibdeps (Debian: dpkg-dev)")
  return()
endif()
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})

# run(PATTERN command ...): the command succeeds and its output matches PATTERN.
function(run pattern)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${SCRATCH} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0 OR NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "${ARGN} gave ${result} and, to match ${pattern}:\n${output}")
  endif()
endfunction()

# unpack(NAME FILE ...): the package lies in SCRATCH/NAME, its sums are right, and it has the files.
function(unpack name)
  file(GLOB package ${SCRATCH}/packages/${name}_*.deb)
  run("" dpkg-deb --raw-extract ${package} ${name})
  run("" ${CMAKE_COMMAND} -E chdir ${name} md5sum --check --quiet DEBIAN/md5sums)
  foreach(file usr/share/doc/${name}/copyright usr/share/doc/${name}/changelog.Debian.gz ${ARGN})
    if(NOT EXISTS ${SCRATCH}/${name}/${file})
      message(FATAL_ERROR "${name} has no ${file}")
    endif()
  endforeach()
endfunction()

run("" cpack --config ${BUILD}/CPackConfig.cmake -B ${SCRATCH}/packages)
unpack(skein usr/bin/skein usr/share/man/man1/skein.1.gz usr/share/bash-completion/completions/skein
       usr/share/zsh/vendor-completions/_skein usr/share/fish/vendor_completions.d/skein.fish
       usr/share/doc/skein/docs/reference/conditions.md usr/share/doc/skein/configs/studies/noise.toml
       usr/share/doc/skein/examples/step_environment.cpp)
unpack(skein-dev usr/include/skein/envs/vec_env.h)

# A plain start needs nothing that only modules link.
file(STRINGS ${SCRATCH}/skein/DEBIAN/control control)
set(modules "")
foreach(field IN LISTS control)
  if(field MATCHES "^Depends: " AND (NOT field MATCHES "libtbb" OR field MATCHES "libtorch|mpi|cairo"))
    message(FATAL_ERROR "the program has ${field}")
  elseif(field MATCHES "^(Recommends|Suggests): ")
    string(APPEND modules "${field}")
  endif()
endforeach()
foreach(library cairo torch mpi)
  file(GLOB_RECURSE module ${SCRATCH}/skein/usr/libskein_*${library}.so)
  if(module AND NOT modules MATCHES "lib[a-z]*${library}")
    message(FATAL_ERROR "${module} needs what neither field has: ${modules}")
  endif()
endforeach()

run("policies/heading.skein +heading" skein/usr/bin/skein list policies)
file(GLOB_RECURSE cairo ${SCRATCH}/skein/usr/libskein_cairo.so)
if(cairo)
  run("" skein/usr/bin/skein plot flights --policy policies/heading.skein --episodes 1 -o flight.pdf)
endif()
