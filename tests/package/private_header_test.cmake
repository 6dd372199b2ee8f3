# SPDX-License-Identifier: Apache-2.0
# A public header that shows users what they do not have is refused, whether a private header or a library.
function(expect_refusal text message)
  file(WRITE ${SCRATCH}/room/public.h "${text}")
  execute_process(COMMAND ${CMAKE_COMMAND} -DHEADERS=room/public.h -DSOURCE=${SCRATCH} -DOUTPUT=${SCRATCH}/include -P
                          ${STAGE} RESULT_VARIABLE result ERROR_VARIABLE error)
  string(REGEX REPLACE "[ \n]+" " " error "${error}")
  if(result EQUAL 0 OR NOT error MATCHES "${message}")
    message(FATAL_ERROR "'${text}' gave ${result}: ${error}")
  endif()
endfunction()
expect_refusal("#include \"room/private.h\"\n" "room/public.h is public and includes room/private.h")
expect_refusal("#include <hwy/highway.h>\n" "room/public.h is public and shows <hwy/highway.h>")

file(WRITE ${SCRATCH}/room/public.h "#include <vector>\n#include <Eigen/Core>\n#include \"room/public.h\"\n")
execute_process(COMMAND ${CMAKE_COMMAND} -DHEADERS=room/public.h -DSOURCE=${SCRATCH} -DOUTPUT=${SCRATCH}/include -P
                        ${STAGE} COMMAND_ERROR_IS_FATAL ANY)
file(READ ${SCRATCH}/include/skein/room/public.h text)
if(NOT text MATCHES "#include \"skein/room/public.h\"")
  message(FATAL_ERROR "includes were not rewritten:\n${text}")
endif()
