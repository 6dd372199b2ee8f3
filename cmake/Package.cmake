# SPDX-License-Identifier: Apache-2.0
# Debian packages by CPack (scripts/package): skein, the program with its modules, policies and texts, and skein-dev, what
# find_package(skein) needs. The component "licence" is Debian's own /usr/share/common-licenses.
include(GitCommit)
find_git_commit(${PROJECT_SOURCE_DIR} %ct)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME skein)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
if(formatted_commit)
  # Later commits are later versions.
  set(ENV{SOURCE_DATE_EPOCH} ${formatted_commit})
  string(TIMESTAMP day %Y%m%d%H%M UTC)
  unset(ENV{SOURCE_DATE_EPOCH})
  string(REPLACE - . commit "${commit}")
  string(APPEND CPACK_PACKAGE_VERSION "+git${day}.${commit}")
endif()
set(CPACK_PACKAGE_VENDOR "The Skein authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "fixed-wing flight simulation and reinforcement learning on CPUs")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/debian)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)

set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
# As dch says who packages.
set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
if("$ENV{DEBFULLNAME}" STREQUAL "" OR "$ENV{DEBEMAIL}" STREQUAL "")
  set(maintainer "The Skein authors <skein@localhost>")
endif()
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${maintainer}")

set(about
    "Skein steps thousands of fixed-wing aircraft, a full nonlinear F-16 first,
with SIMD kernels on all cores, and trains recurrent PPO policies for their
control in the same process.
.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME skein)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "${about}
This package has the program, trained policies, a manual page, and completion
for shells. PDF, LibTorch networks and trainings on many machines are modules
that are loaded when asked for, with what is recommended or suggested.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME skein-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# The libraries are archives: programs that use them link these packages' libraries; the modules lie in skein.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "skein (= ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), libeigen3-dev, libhwy-dev, libtbb-dev, \
pkgconf | pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "${about}
This package has headers, libraries and the CMake package: find_package(skein)
gives skein::envs, skein::policy and skein::train.")

# What Debian asks for beyond the installation is made of it before it is packed.
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_BINARY_DIR}/complete_package.cmake)
configure_file(${PROJECT_SOURCE_DIR}/packaging/debian/complete_package.cmake.in ${CPACK_PRE_BUILD_SCRIPTS} @ONLY)
include(CPack)
