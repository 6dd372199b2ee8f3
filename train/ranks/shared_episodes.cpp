// SPDX-License-Identifier: Apache-2.0
#include "train/ranks/shared_episodes.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "base/fnv_hash.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

/// What this rank flies of the episodes.
EvaluationOptions ShareOf(const EvaluationOptions& all, const Ranks& ranks) {
  const auto begin = static_cast<int>(ShareBegin(all.episodes, ranks.rank(), ranks));
  const auto end = static_cast<int>(ShareBegin(all.episodes, ranks.rank() + 1, ranks));
  EvaluationOptions share = all;
  share.first_episode += begin;
  share.episodes = end - begin;
  return share;
}

/// The hash of all ranks' episodes, in their order: each continues that of the rank before it.
std::uint64_t HashOfAllStarts(const std::optional<VecEnv>& own, Ranks& ranks) {
  const int last = ranks.count() - 1;
  std::uint64_t hash = FnvHash().value();
  if (ranks.rank() > 0) ranks.Exchange(ranks.rank() - 1, nullptr, 0, &hash, sizeof hash);
  if (own) hash = HashOfStarts(*own, hash);
  if (ranks.rank() < last) ranks.Exchange(ranks.rank() + 1, &hash, sizeof hash, nullptr, 0);
  return UnionOverRanks(ranks, ranks.rank() == last ? hash : 0);
}

}  // namespace

FlownEpisodes FlyEpisodesOnRanks(const Agent& agent, const EnvConfig& env,
                                 const EvaluationOptions& options, WorkerPool& pool, Ranks& ranks) {
  if (ranks.count() == 1) return FlyEpisodes(agent, env, options, pool);
  const EvaluationOptions share = ShareOf(options, ranks);
  std::optional<VecEnv> own;
  FlownEpisodes flown;
  DoTogether(ranks, [&] {
    if (share.episodes > 0) own.emplace(MakeEvaluationEnv(agent, env, share));
    flown.episodes.resize(static_cast<std::size_t>(options.episodes));
  });
  flown.starts = DoForOthers(ranks, [&] { return HashOfAllStarts(own, ranks); });
  DoTogether(ranks, [&] {
    if (!own) return;
    const std::vector<Episode> episodes = FlyEpisodes(agent, *own, share, pool);
    std::copy(episodes.begin(), episodes.end(),
              flown.episodes.begin() + (share.first_episode - options.first_episode));
  });
  flown.stopped = DoForOthers(ranks, [&] {
    ShareWithAllRanks(ranks, flown.episodes);
    return AgreeOnStop(ranks, pool);
  });
  return flown;
}

}  // namespace skein
