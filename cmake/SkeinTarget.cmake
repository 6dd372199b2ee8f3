# SPDX-License-Identifier: Apache-2.0
# Compile settings shared by every target of Skein.
add_library(skein_settings INTERFACE)
set_target_properties(skein_settings PROPERTIES EXPORT_NAME settings)
target_include_directories(skein_settings INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(skein_settings INTERFACE cxx_std_17)

# Of every target. Floating point stays strict: contraction is explicit in the kernels, NaN checks and reproducibility survive.
set(SKEIN_COMPILE_OPTIONS -ffp-contract=off -fno-math-errno -Wall -Wextra -Wshadow -Wno-psabi)
if(SKEIN_WERROR)
  list(APPEND SKEIN_COMPILE_OPTIONS -Werror)
endif()
add_compile_options(${SKEIN_COMPILE_OPTIONS})

# skein_lighten_kernels(SOURCE ...): those that Highway compiles once per SIMD target do without one check of the address
# sanitizer, of variables after their scope: it makes g++ 12 take eight times as long over functions
# of hundreds of vectors. For libFuzzer no library has its comparisons traced, which would be up to half of the time, and
# the other ones are optimised more than kernels, whose functions would take minutes each.
function(skein_lighten_kernels)
  if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize=[^ ]*address")
    return()
  endif()
  foreach(source IN LISTS ARGN)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE file)
    if(EXISTS ${file})
      file(STRINGS ${file} inclusion REGEX "^#include .hwy/foreach_target.h." LIMIT_COUNT 1)
      if(inclusion)
        set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -fno-sanitize-address-use-after-scope
                                                                     $<$<BOOL:${SKEIN_FUZZ}>:-fno-sanitize-coverage=trace-cmp>)
      elseif(SKEIN_FUZZ)
        set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -O2 -fno-sanitize-coverage=trace-cmp)
      endif()
    endif()
  endforeach()
endfunction()

# skein_library(NAME SOURCES ... [PUBLIC deps ...] [PRIVATE deps ...])
function(skein_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(skein_${name} STATIC ${ARG_SOURCES})
  skein_lighten_kernels(${ARG_SOURCES})
  add_library(skein::${name} ALIAS skein_${name})
  set_target_properties(skein_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(skein_${name} PUBLIC skein_settings ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
endfunction()

# skein_test(NAME source ... LIBRARIES lib ... [LABELS label ...] [TIMEOUT seconds]): one GoogleTest program, its cases known to ctest.
# What it tests is optimised in full; its own sources are not, which saves a quarter of the time to compile them.
function(skein_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  skein_lighten_kernels(${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_compile_definitions(${name} PRIVATE SKEIN_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data")
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  set(properties TIMEOUT ${ARG_TIMEOUT})
  if(ARG_LABELS)
    list(APPEND properties LABELS "${ARG_LABELS}")
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 120 NO_PRETTY_VALUES PROPERTIES ${properties})
endfunction()

# skein_embed(TARGET symbol file): makes the file's bytes available as `extern const std::string_view symbol`
# in namespace skein::data (declare it where it is used).
function(skein_embed target symbol file)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded_${symbol}.cpp)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DINPUT=${file} -DOUTPUT=${output} -DSYMBOL=${symbol}
            -P ${PROJECT_SOURCE_DIR}/cmake/EmbedFile.cmake
    DEPENDS ${file} ${PROJECT_SOURCE_DIR}/cmake/EmbedFile.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
