// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

inline constexpr int kExitSuccess = 0;
inline constexpr int kExitFailure = 1;  ///< an Error, printed as one line on the error stream
/// The command line, or a configuration that it names, asks for what cannot be.
inline constexpr int kExitUsage = 2;

/// The program `skein`: parses the command line, runs the command, returns the exit code.
int RunProgram(int argc, char** argv);

}  // namespace skein
