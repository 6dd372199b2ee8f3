// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>

namespace skein {

/// Adds skein plot to `app`, with a subcommand for each kind of picture; as those of commands.h.
void AddPlotCommand(CLI::App* app);

}  // namespace skein
