# SPDX-License-Identifier: Apache-2.0
# Installs the build tree into a scratch prefix, then builds a project that uses it and runs the examples.
file(REMOVE_RECURSE ${SCRATCH})
set(examples ${SCRATCH}/build/examples)

# run(PATTERN command ...): the command succeeds and its output matches PATTERN.
function(run pattern)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN} failed:\n${output}")
  elseif(NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "${ARGN} printed what does not match ${pattern}:\n${output}")
  endif()
endfunction()

run("" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)
file(GLOB on_include_path RELATIVE ${SCRATCH}/prefix/include ${SCRATCH}/prefix/include/*)
if(NOT on_include_path STREQUAL skein)
  message(FATAL_ERROR "besides skein/ these were installed under include/: ${on_include_path}")
endif()

# The program finds what was installed with it from wherever it is called.
if(EXISTS ${SCRATCH}/prefix/bin/skein)
  set(skein ${CMAKE_COMMAND} -E chdir ${SCRATCH} prefix/bin/skein)
  run("policies/heading.skein +heading" ${skein} list policies)
  run("deterministic success" ${skein} eval --policy policies/heading.skein --episodes 8)
endif()

run("" ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${SCRATCH}/build -G Ninja -DEXAMPLES=${EXAMPLES}
    -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_FLAGS=${CXX_FLAGS})
run("" ${CMAKE_COMMAND} --build ${SCRATCH}/build)
run("[1-9][0-9]+ of [1-9][0-9]+ episodes" ${examples}/step_environment)
run("[0-9]+ numbers, [0-9]+ rates" ${SCRATCH}/build/matrices_fsanitize_address)
file(READ /proc/cpuinfo processor)
if(processor MATCHES " avx2 ")
  run("[0-9]+ numbers, [0-9]+ rates" ${SCRATCH}/build/matrices_mavx2)
else()
  message("not run: matrices_mavx2, as there is no AVX2")
endif()
run("alpha 4.531 deg.*-0.781  [+]0.728i" ${examples}/trim_and_linearise)
if(EXISTS ${examples}/fly_policy)
  # Where its modules are.
  run("PATH[^\n]*[[:]${SCRATCH}/prefix/lib[^:\n]*/skein[]:]" readelf -d ${examples}/fly_policy)
  run("256 episodes of heading, (9[0-9]|100)[.]. %" ${examples}/fly_policy
      ${SCRATCH}/prefix/share/skein/policies/heading.skein)
  run("iteration 3: 245760 control steps" ${examples}/train_policy ${SCRATCH}/small.skein)
  run("256 episodes of heading" ${examples}/fly_policy ${SCRATCH}/small.skein)
  run("" ${CMAKE_COMMAND} -DPROGRAM=${examples}/fly_policy -P ${CMAKE_CURRENT_LIST_DIR}/shared_libraries_test.cmake)
endif()
