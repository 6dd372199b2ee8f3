# SPDX-License-Identifier: Apache-2.0
# scripts/check_sources finds each kind of fault in a repository that has just that one, and none in a good one.
find_program(PYTHON python3)
if(NOT PYTHON)
  message("skipped: no python3")
  return()
endif()
set(licence "// SPDX-License-Identifier: Apache-2.0\n")

# expect(EXIT_CODE PATTERN path text [path text ...]): of a repository of these files.
function(expect exit_code pattern)
  file(REMOVE_RECURSE ${SCRATCH})
  while(ARGN)
    list(POP_FRONT ARGN path text)
    file(WRITE ${SCRATCH}/${path} "${text}\n")
  endwhile()
  execute_process(COMMAND git init -q ${SCRATCH} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${PYTHON} -I -S ${SCRIPT} ${SCRATCH} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL exit_code OR NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "${pattern} expected, but exit code ${result} and:\n${output}")
  endif()
endfunction()

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
