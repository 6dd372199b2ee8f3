# SPDX-License-Identifier: Apache-2.0
# Install rules and the exported package: find_package(skein) gives skein::simd, skein::envs and, where the learner was
# built, skein::train.
include(CMakePackageConfigHelpers)

set(SKEIN_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/skein)
set(skein_targets skein_settings skein_base skein_simd skein_envs)
set(skein_rooms base simd envs)
if(SKEIN_BUILD_TRAIN)
  list(APPEND skein_targets skein_train)
  list(APPEND skein_rooms train)
  install(TARGETS skein RUNTIME)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/policies DESTINATION ${CMAKE_INSTALL_DATADIR}/skein)
endif()

install(TARGETS ${skein_targets} EXPORT skein)
foreach(room IN LISTS skein_rooms)
  install(
    DIRECTORY ${PROJECT_SOURCE_DIR}/${room}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/skein
    FILES_MATCHING
    PATTERN "*.h")
endforeach()
install(EXPORT skein NAMESPACE skein:: FILE skein-targets.cmake DESTINATION ${SKEIN_PACKAGE_DIR})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/skein-config.cmake.in
                              ${PROJECT_BINARY_DIR}/skein-config.cmake
                              INSTALL_DESTINATION ${SKEIN_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/skein-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/skein-config.cmake
              ${PROJECT_BINARY_DIR}/skein-config-version.cmake DESTINATION ${SKEIN_PACKAGE_DIR})
