# SPDX-License-Identifier: Apache-2.0
# scripts/check_links finds each kind of broken link in a repository that has just that one, and none in a good one.
include(${CMAKE_CURRENT_LIST_DIR}/scratch_repository.cmake)
if(NOT PYTHON)
  return()
endif()

expect(0 "^$" README.md "[a](docs/page.md#two-words) [b](https://nowhere.example) [c](#title)\n# Title" docs/page.md
       "## Two `words`")
expect(1 "README.md: docs/page.md: there is no docs/page.md" README.md "[a](docs/page.md)")
expect(1 "docs/page.md: ../README.md#nothing: no heading of README.md has the anchor #nothing" README.md "# Title"
       docs/page.md "[a](../README.md#nothing)")
expect(0 "^$" README.md "```\n[a](nowhere.md)\n```")
expect(1 "base/error.h: names docs/page.md, which is not there" base/error.h "// More in docs/page.md.")
