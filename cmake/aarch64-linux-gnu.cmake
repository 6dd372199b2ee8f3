# SPDX-License-Identifier: Apache-2.0
# Toolchain: builds for AArch64 on another Debian machine, against Debian's libraries for arm64 beside its own
# (scripts/setup --arch arm64); what a build or ctest runs of it, qemu runs.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static)
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig)
