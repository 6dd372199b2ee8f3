# SPDX-License-Identifier: Apache-2.0
# PROGRAM links fewer than 12 shared libraries, the sanitizers' aside; LibTorch would bring hundreds.
execute_process(COMMAND ldd ${PROGRAM} OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" libraries "${output}")
list(FILTER libraries EXCLUDE REGEX "lib(a|t|ub|l)san")
list(LENGTH libraries count)
if(count GREATER_EQUAL 12)
  message(FATAL_ERROR "${PROGRAM} links ${count} libraries:\n${output}")
endif()
