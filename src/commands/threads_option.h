// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace skein {

/// Adds --threads; 0, which is what `threads` is without it, is one for each CPU that the process
/// may use.
CLI::Option* AddThreadsOption(CLI::App* command, int* threads);

}  // namespace skein
