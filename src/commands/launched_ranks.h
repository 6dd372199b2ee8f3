// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "train/ppo/train_config.h"
#include "train/ranks/ranks.h"

namespace skein {

/// After how many seconds a process that does not answer ends all, unless told otherwise.
inline constexpr double kRankTimeoutS = 600;

/// Adds --rank-timeout SECONDS.
void AddRankTimeoutOption(CLI::App* command, double* timeout_s);

/// Does `work` on one of several ranks. What all have been told of (JointError) is thrown on rank 0
/// alone; so is what else rank 0 throws if the others end, too. What is thrown on a rank for which
/// the others wait ends all, and is said with that rank's name. Throws UsageError, on rank 0, if
/// there is no power of two of them.
void WorkAsRank(Ranks& ranks, const std::function<void(Ranks& ranks)>& work);

/// Does `work` alone, or, if a launcher (mpirun, srun) has started several processes, on each of
/// them as a rank (WorkAsRank), of which rank 0 alone has a standard output. Returns on each of
/// them when all have done it; after that none waits for another, and rank 0 may work on. Warns of
/// processes that should be ranks and cannot.
void OnLaunchedRanks(double timeout_s, const std::function<void(Ranks& ranks)>& work);

/// Gives a new training by several ranks, whose one shard cannot be dealt out, DefaultShards,
/// unless the assignments of the command line say how many. Throws UsageError if it cannot be done
/// by so many.
void ChooseShards(const std::vector<std::string>& assignments, const Ranks& ranks,
                  TrainConfig* config);

}  // namespace skein
