# SPDX-License-Identifier: Apache-2.0
# find_git_commit(SOURCE FORMAT): sets `commit` to the commit of the git work tree SOURCE, "-dirty" behind it if files have
# changed, and a hash of the changes behind that where builds read such files: "0123456789-dirty-abcdef0123"; or to
# "unknown". And sets `formatted_commit` to what git says of it in FORMAT, such as %cs for its date, 2026-11-22, or to
# nothing.
function(find_git_commit source format)
  set(commit unknown)
  set(formatted_commit "")
  find_program(git git)
  if(git)
    # SOURCE may lie unpacked inside another work tree, whose commit says nothing about it.
    execute_process(COMMAND ${git} -C ${source} rev-parse --show-toplevel OUTPUT_VARIABLE top ERROR_QUIET
                    OUTPUT_STRIP_TRAILING_WHITESPACE)
    get_filename_component(top "${top}" REALPATH)
    get_filename_component(source "${source}" REALPATH)
    if(top STREQUAL source)
      execute_process(COMMAND ${git} -C ${source} describe --always --dirty --abbrev=10 --match=
                      OUTPUT_VARIABLE description ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failure)
      if(NOT failure)
        set(commit ${description})
        if(commit MATCHES "-dirty$")
          # What no build reads is left out: to edit a page would link every program again.
          execute_process(
            COMMAND ${git} -C ${source} diff --no-color --no-ext-diff --no-textconv --binary --full-index HEAD -- .
                    :!*.md :!docs :!policies :!scripts :!tests
            OUTPUT_VARIABLE changes ERROR_QUIET)
          if(NOT changes STREQUAL "")
            string(SHA1 hash "${changes}")
            string(SUBSTRING ${hash} 0 10 hash)
            string(APPEND commit -${hash})
          endif()
        endif()
        execute_process(COMMAND ${git} -C ${source} show --no-patch --format=${format} OUTPUT_VARIABLE formatted_commit
                        OUTPUT_STRIP_TRAILING_WHITESPACE)
      endif()
    endif()
  endif()
  set(commit ${commit} PARENT_SCOPE)
  set(formatted_commit "${formatted_commit}" PARENT_SCOPE)
endfunction()
