// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>

namespace skein {

/// Commands below `skein fdm`, in files of their own.
void AddTrimCommand(CLI::App* fdm);
void AddLineariseCommand(CLI::App* fdm);
void AddSweepCommand(CLI::App* fdm);
void AddFlyCommand(CLI::App* fdm);

}  // namespace skein
