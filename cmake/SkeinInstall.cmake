# SPDX-License-Identifier: Apache-2.0
# Install rules and the exported package: find_package(skein) gives skein::simd, skein::envs and, where the learner was
# built, skein::policy and skein::train.
include(CMakePackageConfigHelpers)
include(PublicHeaders)

set(SKEIN_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/skein)
set(skein_targets skein_settings skein_base skein_simd skein_envs)
if(SKEIN_BUILD_TRAIN)
  list(APPEND skein_targets skein_policy skein_train)
  install(TARGETS skein RUNTIME)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/policies DESTINATION ${CMAKE_INSTALL_DATADIR}/skein)
endif()

install(TARGETS ${skein_targets} EXPORT skein)
add_custom_target(
  public_headers
  COMMAND ${CMAKE_COMMAND} "-DHEADERS=${SKEIN_PUBLIC_HEADERS}" -DSOURCE=${PROJECT_SOURCE_DIR}
          -DOUTPUT=${PROJECT_BINARY_DIR}/include -P ${CMAKE_CURRENT_LIST_DIR}/StagePublicHeaders.cmake
  VERBATIM)
install(
  CODE "
    set(HEADERS \"${SKEIN_PUBLIC_HEADERS}\")
    set(SOURCE \"${PROJECT_SOURCE_DIR}\")
    set(OUTPUT \"${PROJECT_BINARY_DIR}/include\")
    include(\"${CMAKE_CURRENT_LIST_DIR}/StagePublicHeaders.cmake\")")
install(DIRECTORY ${PROJECT_BINARY_DIR}/include/skein DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT skein NAMESPACE skein:: FILE skein-targets.cmake DESTINATION ${SKEIN_PACKAGE_DIR})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/skein-config.cmake.in
                              ${PROJECT_BINARY_DIR}/skein-config.cmake
                              INSTALL_DESTINATION ${SKEIN_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/skein-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/skein-config.cmake
              ${PROJECT_BINARY_DIR}/skein-config-version.cmake DESTINATION ${SKEIN_PACKAGE_DIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})
