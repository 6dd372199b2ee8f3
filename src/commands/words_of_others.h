// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace skein {

/// What stands in `command` for `option`, which it does not have and other training programs and
/// simulators do: "; did you mean --out?" for --logdir. Empty if nothing is known of it.
std::string OptionMeantElsewhere(const CLI::App& command, const std::string& option);

/// The same for a command, "; did you mean eval?" for play, or for a task, which is no command.
std::string CommandMeantElsewhere(const std::string& command);

/// "; did you mean --altitude-ft (in ft)?" for `typed`; the unit is named if `typed` has another or
/// none.
std::string DidYouMeanOption(const std::string& typed, const std::string& option);

/// Whether `option` is `typed` and a unit: --altitude-ft and --altitude.
bool IsInUnitOf(const std::string& option, const std::string& typed);

}  // namespace skein
