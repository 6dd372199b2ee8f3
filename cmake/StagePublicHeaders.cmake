# SPDX-License-Identifier: Apache-2.0
# Copies HEADERS, paths below SOURCE, to OUTPUT/skein/ as users see them: an include of "envs/vec_env.h" becomes one of
# "skein/envs/vec_env.h". Fails if a header includes what users do not have: a private header, or another library than
# the standard one and Eigen.
cmake_policy(VERSION 3.25)
file(REMOVE_RECURSE ${OUTPUT}/skein)
foreach(header IN LISTS HEADERS)
  file(READ ${SOURCE}/${header} text)
  string(REGEX MATCHALL "#include [\"<][^\">]+" includes "${text}")
  foreach(include IN LISTS includes)
    string(REGEX REPLACE "#include [\"<]" "" included "${include}")
    if(include MATCHES "#include \"" AND NOT included IN_LIST HEADERS)
      message(FATAL_ERROR "${header} is public and includes ${included}, which is not: do without it, or list it in "
                          "cmake/PublicHeaders.cmake")
    elseif(include MATCHES "#include <" AND included MATCHES "[/.]" AND NOT included MATCHES "^Eigen/")
      message(FATAL_ERROR "${header} is public and shows <${included}> to users: public headers use the standard "
                          "library and Eigen alone")
    endif()
  endforeach()
  string(REGEX REPLACE "#include \"" "#include \"skein/" text "${text}")
  file(WRITE ${OUTPUT}/skein/${header} "${text}")
endforeach()
