// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "train/ranks/ranks.h"

namespace skein {

/// After how many seconds a process that does not answer ends all, unless told otherwise.
inline constexpr double kRankTimeoutS = 600;

/// Adds --rank-timeout SECONDS.
void AddRankTimeoutOption(CLI::App* command, double* timeout_s);

/// Does `work` alone, or, if a launcher (mpirun, srun) has started several processes, on each of
/// them as a rank. Of several rank 0 alone has a standard output, and throws what `work` throws: it
/// must throw on all of them together (DoTogether). Throws UsageError if they are no power of two.
void OnLaunchedRanks(double timeout_s, const std::function<void(Ranks& ranks)>& work);

}  // namespace skein
