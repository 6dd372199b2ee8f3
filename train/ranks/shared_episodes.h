// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/worker_pool.h"
#include "envs/env_config.h"
#include "train/policy/agent.h"
#include "train/policy/evaluate.h"
#include "train/ranks/ranks.h"

namespace skein {

/// On all ranks together: what FlyEpisodes gives on one, on every rank, each of which flies its
/// share. What fails on one rank is thrown on all; if some rank's pool is stopping, all are.
FlownEpisodes FlyEpisodesOnRanks(const Agent& agent, const EnvConfig& env,
                                 const EvaluationOptions& options, WorkerPool& pool, Ranks& ranks);

}  // namespace skein
