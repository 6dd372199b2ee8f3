# SPDX-License-Identifier: Apache-2.0
# REUSE-IgnoreStart: what follows speaks of licences.
# scripts/check_sources finds each kind of fault in a repository that has just that one, and none in a good one.
include(${CMAKE_CURRENT_LIST_DIR}/scratch_repository.cmake)
if(NOT PYTHON)
  return()
endif()
set(licence "// SPDX-License-Identifier: Apache-2.0\n")

expect(0 "^$" base/error.h "${licence}" envs/wind/wind.h "${licence}#include \"base/error.h\"")
expect(1 "base/error.h includes envs/wind.h: includes run down only" base/error.h
       "${licence}#include \"envs/wind.h\"" envs/wind.h "${licence}")
expect(1 "folders in a circle, envs > envs/wind > envs: envs/wind/wind.h includes envs/env.h" envs/env.h
       "${licence}#include \"envs/wind/wind.h\"" envs/wind/wind.h "${licence}#include \"envs/env.h\"")
expect(1 "train/adam.cpp includes torch/types.h, which only train/libtorch/ may" train/adam.cpp
       "${licence}#include <torch/types.h>")
expect(1 "docs/page.md: no line SPDX-License-Identifier" docs/page.md "words")
expect(0 "^$" docs/page.md "words" REUSE.toml
       "# SPDX-License-Identifier: Apache-2.0\n[[annotations]]\npath = \"docs/**\"\nSPDX-License-Identifier = \"MIT\"")

# A body of so many lines, with braces in text, in an initialiser and in a lambda on the way.
function(body_of lines result)
  math(EXPR more "${lines} - 4")
  string(REPEAT "  ++x\n" ${more} statements)
  set(${result} "${licence}namespace skein {\nA::A(int x) : x_{x} {\n  '}', \"}}\" // }\n  int y[] = {1, 2}\n  f([] {\n})\n\
${statements}}\n}" PARENT_SCOPE)
endfunction()
body_of(80 long)
body_of(81 too_long)
body_of(21 short)
expect(1 "nine in ten functions have up to 80 lines" src/a.cpp "${long}")
expect(1 "src/a.cpp:3: A::A.int x. : x_{x}: 81 lines, and functions have 80 at most" src/a.cpp "${too_long}")
expect(0 "1 functions: half have 21 lines at most" src/a.cpp "${short}")
string(REPEAT "\n" 600 lines)
expect(1 "src/a.cpp: 602 lines, and files have 600 at most" src/a.cpp "${licence}${lines}")

expect(1 "tests/a_test.cpp:3: a tolerance of 1e-3f without a name" tests/a_test.cpp
       "${licence}\nEXPECT_NEAR(f(a, {1, 2}),\n            b[1], 1e-3f) << c")
expect(1 "tests/a_test.cpp:2: a tolerance of 5 without a name" tests/a_test.cpp "${licence}ASSERT_NEAR(a, b, 5)")
expect(0 "^$" tests/a_test.cpp
       "${licence}EXPECT_NEAR(f(a, 1), g(2), kRounding) // EXPECT_NEAR(a, b, 1)\nEXPECT_NEAR(a, 1, 2 * kRounding)")
# REUSE-IgnoreEnd
