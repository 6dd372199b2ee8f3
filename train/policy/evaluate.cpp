// SPDX-License-Identifier: Apache-2.0
#include "train/policy/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "base/fnv_hash.h"
#include "envs/state/state.h"
#include "envs/step_memory.h"
#include "envs/task_registry.h"
#include "train/measures/flight_measurer.h"

namespace skein {
namespace {

/// Aircraft per tile: few enough that many threads share the episodes.
constexpr int kTileSize = 128;
/// Keeps the episodes of an evaluation apart from those of training with the same seed.
constexpr std::uint64_t kEvaluationStream = 0xA5B35705E7C0FFEE;

/// Control steps within tolerances after which a target counts, at least the one of first touch.
std::int32_t DwellSteps(const EnvConfig& env) {
  const double steps = MakeTask(env)->dwell_s() / env.control_interval_s;
  return std::max(1, static_cast<std::int32_t>(std::lround(steps)));
}

/// Puts what there is of `target` in the place of what was drawn.
void SetTargets(const std::vector<std::optional<float>>& target, VecEnv& env) {
  if (target.empty()) return;
  for (int aircraft = 0; aircraft < env.num_aircraft(); ++aircraft) {
    std::vector<float> flown = env.TargetOf(aircraft);
    if (target.size() > flown.size()) throw Error("the task has fewer targets than were given");
    for (std::size_t k = 0; k < target.size(); ++k) flown[k] = target[k].value_or(flown[k]);
    env.SetTarget(aircraft, flown);
  }
}

/// Flies a tile's first episodes.
class TileEvaluation {
 public:
  /// `measurer` is null if nothing is measured.
  TileEvaluation(const Agent& agent, VecEnv& env, int tile, const EvaluationOptions& options,
                 std::int32_t dwell_steps, FlightMeasurer* measurer)
      : env_(env),
        tile_(tile),
        dwell_steps_(dwell_steps),
        agent_(MakeEvaluationAgent(agent, env, tile, options)),
        memory_(env.tile_count(tile), {0, 0, options.flight_metrics ? kNumFlightMetrics : 0}),
        measurer_(measurer) {
    if (measurer != nullptr) measurer->Begin(env.tile_begin(tile), env.tile_count(tile));
  }

  /// `episodes` are those of the tile's aircraft, kNone until they have ended.
  void Fly(const WorkerPool& pool, Episode* episodes) {
    const int count = env_.tile_count(tile_);
    StepOutput output = memory_.output();
    output.observer = measurer_;
    for (int flying = count; flying > 0 && !pool.stopping();) {
      env_.Step(tile_, agent_.Act().data(), output);
      for (int i = 0; i < count; ++i) {
        if (memory_.termination[i] == static_cast<std::uint8_t>(Termination::kNone)) continue;
        agent_.Forget(i);
        if (episodes[i].termination != Termination::kNone) continue;
        Report(i, &episodes[i]);
        --flying;
      }
    }
  }

 private:
  /// The episode that has ended.
  void Report(int i, Episode* episode) {
    episode->termination = static_cast<Termination>(memory_.termination[i]);
    episode->episode_return = memory_.episode_return[i];
    episode->steps = memory_.episode_steps[i];
    if (!memory_.flight_metrics.empty()) {
      std::copy_n(
          memory_.flight_metrics.begin() + static_cast<std::ptrdiff_t>(i) * kNumFlightMetrics,
          kNumFlightMetrics, episode->metrics.begin());
    }
    if (measurer_ != nullptr) {
      episode->measures = measurer_->Report(i);
      episode->reached_step = episode->measures.reached_step;
    } else if (episode->termination == Termination::kTargetReached) {
      episode->reached_step = episode->steps;
    }
    if (episode->reached_step > 0) {
      episode->entered_step = episode->reached_step - dwell_steps_ + 1;
    }
    episode->succeeded = env_.config().mission.enabled()
                             ? episode->termination == Termination::kTimeLimit
                             : episode->reached_step > 0;
  }

  VecEnv& env_;
  int tile_;
  std::int32_t dwell_steps_;
  TileAgent agent_;
  StepMemory memory_;
  FlightMeasurer* measurer_;
};

}  // namespace

VecEnv MakeEvaluationEnv(const Agent& agent, const EnvConfig& config,
                         const EvaluationOptions& options) {
  if (options.episodes <= 0) throw Error("an evaluation needs at least one episode");
  VecEnv env(EvaluationConfig(config), options.episodes, options.seed ^ kEvaluationStream,
             kTileSize, agent.low_level(), options.first_episode);
  agent.CheckFits(env);
  SetTargets(options.target, env);
  return env;
}

TileAgent MakeEvaluationAgent(const Agent& agent, const VecEnv& env, int tile,
                              const EvaluationOptions& options) {
  return {agent, env, tile, options.seed ^ kEvaluationStream};
}

std::uint64_t HashOfStarts(const VecEnv& env, std::optional<std::uint64_t> before) {
  FnvHash hash(before.value_or(FnvHash().value()));
  for (int aircraft = 0; aircraft < env.num_aircraft(); ++aircraft) {
    for (int column = 0; column < kNumRecordedColumns; ++column) {
      const float value = env.StateOf(aircraft, column);
      hash.Add(&value, sizeof value);
    }
    const std::vector<float> target = env.TargetOf(aircraft);
    hash.Add(target.data(), target.size() * sizeof target[0]);
  }
  return hash.value();
}

std::vector<Episode> FlyEpisodes(const Agent& agent, VecEnv& env, const EvaluationOptions& options,
                                 WorkerPool& pool) {
  Episode unflown;
  unflown.metrics.fill(std::numeric_limits<float>::quiet_NaN());
  std::vector<Episode> episodes(static_cast<std::size_t>(options.episodes), unflown);
  const std::int32_t dwell_steps = DwellSteps(env.config());
  const bool is_measured = options.flight_metrics || env.config().hold_s > 0;
  std::vector<FlightMeasurer> measurers(static_cast<std::size_t>(pool.threads()),
                                        FlightMeasurer(env.config()));
  pool.ForEach(env.num_tiles(), [&](int tile, int worker) {
    FlightMeasurer& measurer = measurers[static_cast<std::size_t>(worker)];
    TileEvaluation(agent, env, tile, options, dwell_steps, is_measured ? &measurer : nullptr)
        .Fly(pool, episodes.data() + env.tile_begin(tile));
  });
  return episodes;
}

FlownEpisodes FlyEpisodes(const Agent& agent, const EnvConfig& config,
                          const EvaluationOptions& options, WorkerPool& pool) {
  VecEnv env = MakeEvaluationEnv(agent, config, options);
  FlownEpisodes flown;
  flown.starts = HashOfStarts(env);
  flown.episodes = FlyEpisodes(agent, env, options, pool);
  flown.stopped = pool.stopping();
  return flown;
}

EvaluationResult Summarise(const std::vector<Episode>& episodes, double control_interval_s) {
  EvaluationResult result;
  result.episodes = static_cast<int>(episodes.size());
  int successes = 0, reached = 0, held = 0;
  double steps_to_target = 0, within = 0;
  for (const Episode& episode : episodes) {
    ++result.terminations[static_cast<std::size_t>(episode.termination)];
    result.return_mean += episode.episode_return;
    successes += episode.succeeded;
    if (!std::isnan(episode.measures.hold.within)) {
      ++held;
      within += episode.measures.hold.within;
    }
    if (episode.reached_step == 0) continue;
    ++reached;
    steps_to_target += episode.entered_step;
  }
  result.return_mean /= result.episodes;
  result.success_rate = static_cast<double>(successes) / result.episodes;
  result.time_to_target_mean_s = reached > 0 ? control_interval_s * steps_to_target / reached
                                             : std::numeric_limits<double>::quiet_NaN();
  result.hold_within_mean = held > 0 ? within / held : std::numeric_limits<double>::quiet_NaN();
  return result;
}

EvaluationResult Evaluate(const Agent& agent, const EnvConfig& config,
                          const EvaluationOptions& options, WorkerPool& pool) {
  return Summarise(FlyEpisodes(agent, config, options, pool).episodes, config.control_interval_s);
}

}  // namespace skein
