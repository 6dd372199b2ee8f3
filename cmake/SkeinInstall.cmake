# SPDX-License-Identifier: Apache-2.0
# Install rules and the exported package: find_package(skein) gives skein::simd, skein::envs and, where the learner was
# built, skein::policy and skein::train.
include(CMakePackageConfigHelpers)
include(PublicHeaders)

set(SKEIN_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/skein)
set(skein_targets skein_settings skein_base skein_simd skein_envs)
if(SKEIN_BUILD_TRAIN)
  list(APPEND skein_targets skein_policy skein_train)
  install(TARGETS skein RUNTIME COMPONENT program)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/policies DESTINATION ${CMAKE_INSTALL_DATADIR}/skein COMPONENT program
          FILES_MATCHING PATTERN *.skein)
  # Under the names that the program, its manual page and each other call them by.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}
          COMPONENT program)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/configs/studies DESTINATION ${CMAKE_INSTALL_DOCDIR}/configs COMPONENT program)
  install(FILES ${PROJECT_SOURCE_DIR}/policies/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/policies COMPONENT program)
endif()

install(TARGETS ${skein_targets} EXPORT skein COMPONENT development)
# Staged by the build: an installation by root would leave headers of root's, which the next build could not replace.
set(headers_staged ${PROJECT_BINARY_DIR}/include/staged)
add_custom_command(
  OUTPUT ${headers_staged}
  COMMAND ${CMAKE_COMMAND} "-DHEADERS=${SKEIN_PUBLIC_HEADERS}" -DSOURCE=${PROJECT_SOURCE_DIR}
          -DOUTPUT=${PROJECT_BINARY_DIR}/include -P ${CMAKE_CURRENT_LIST_DIR}/StagePublicHeaders.cmake
  COMMAND ${CMAKE_COMMAND} -E touch ${headers_staged}
  DEPENDS ${CMAKE_CURRENT_LIST_DIR}/PublicHeaders.cmake ${CMAKE_CURRENT_LIST_DIR}/StagePublicHeaders.cmake
          ${SKEIN_PUBLIC_HEADERS}
  VERBATIM)
add_custom_target(public_headers DEPENDS ${headers_staged})
add_dependencies(skein_base public_headers)
install(DIRECTORY ${PROJECT_BINARY_DIR}/include/skein DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(EXPORT skein NAMESPACE skein:: FILE skein-targets.cmake DESTINATION ${SKEIN_PACKAGE_DIR} COMPONENT development)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/skein-config.cmake.in
                              ${PROJECT_BINARY_DIR}/skein-config.cmake
                              INSTALL_DESTINATION ${SKEIN_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/skein-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/skein-config.cmake
              ${PROJECT_BINARY_DIR}/skein-config-version.cmake DESTINATION ${SKEIN_PACKAGE_DIR} COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)
