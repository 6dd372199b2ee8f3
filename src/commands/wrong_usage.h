// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace skein {

/// What is wrong with the command line that `program` could not parse, in one line which ends with
/// the help that tells more: "unknown option --stpes; did you mean --steps? (see skein train
/// --help)".
std::string WrongUsage(const CLI::App& program, const CLI::ParseError& error);

}  // namespace skein
