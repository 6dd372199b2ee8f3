# SPDX-License-Identifier: Apache-2.0
# docs/reference/cpp-api.md shows every example whole, and as it is compiled by the package's test.
file(READ ${ROOT}/docs/reference/cpp-api.md page)
file(GLOB examples ${ROOT}/examples/*.cpp)
foreach(example IN LISTS examples)
  file(READ ${example} text)
  string(FIND "${text}" "#include" begin)
  string(SUBSTRING "${text}" ${begin} -1 code)
  string(FIND "${page}" "```cpp\n${code}```" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "docs/reference/cpp-api.md does not show ${example} from its first #include on")
  endif()
endforeach()
