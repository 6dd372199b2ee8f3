// SPDX-License-Identifier: Apache-2.0
#include "train/policy/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "envs/state/state.h"
#include "envs/task_registry.h"
#include "train/files/fnv_hash.h"

namespace skein {
namespace {

/// Aircraft per tile: few enough that many threads share the episodes.
constexpr int kTileSize = 128;
/// Keeps the episodes of an evaluation apart from those of training with the same seed.
constexpr std::uint64_t kEvaluationStream = 0xA5B35705E7C0FFEE;

std::uint64_t HashOfStarts(const VecEnv& env) {
  FnvHash hash;
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

/// Control steps within tolerances after which a target counts, at least the one of first touch.
std::int32_t DwellSteps(const EnvConfig& env) {
  const double steps = MakeTask(env)->dwell_s() / env.control_interval_s;
  return std::max(1, static_cast<std::int32_t>(std::lround(steps)));
}

/// Says what came of the target of an episode that has ended.
void NoteTarget(const EnvConfig& env, std::int32_t dwell_steps, bool is_measured,
                Episode* episode) {
  const bool ends_reached = episode->termination == Termination::kTargetReached;
  episode->reached_step = is_measured    ? episode->measures.reached_step
                          : ends_reached ? episode->steps
                                         : 0;
  if (episode->reached_step > 0) {
    episode->entered_step = episode->reached_step - dwell_steps + 1;
  }
  episode->succeeded = env.mission.enabled() ? episode->termination == Termination::kTimeLimit
                                             : episode->reached_step > 0;
}

/// `episodes` are those of the tile's aircraft, kNone until they have ended.
void FlyTile(const Agent& agent, VecEnv& env, int tile, const EvaluationOptions& options,
             const WorkerPool& pool, Episode* episodes) {
  const int count = env.tile_count(tile);
  std::vector<float> reward(count), episode_return(count);
  std::vector<float> final_observation(static_cast<std::size_t>(count) * env.observation_size());
  std::vector<std::uint8_t> termination(count);
  std::vector<std::int32_t> steps(count);
  std::vector<float> metrics(options.flight_metrics ? count * kNumFlightMetrics : 0);
  StepOutput output;
  output.reward = reward.data();
  output.termination = termination.data();
  output.episode_return = episode_return.data();
  output.episode_steps = steps.data();
  output.final_observation = final_observation.data();
  if (options.flight_metrics) output.flight_metrics = metrics.data();
  std::optional<FlightMeasurer> measurer;
  if (options.flight_metrics || env.config().hold_s > 0) {
    output.observer = &measurer.emplace(env.config(), env.tile_begin(tile), count);
  }
  const std::int32_t dwell_steps = DwellSteps(env.config());

  TileAgent flying_agent = MakeEvaluationAgent(agent, env, tile, options);
  for (int flying = count; flying > 0 && !pool.stopping();) {
    env.Step(tile, flying_agent.Act().data(), output);
    for (int i = 0; i < count; ++i) {
      if (termination[i] == static_cast<std::uint8_t>(Termination::kNone)) continue;
      flying_agent.Forget(i);
      Episode& episode = episodes[i];
      if (episode.termination != Termination::kNone) continue;
      episode.termination = static_cast<Termination>(termination[i]);
      episode.episode_return = episode_return[i];
      episode.steps = steps[i];
      if (options.flight_metrics) {
        std::copy_n(metrics.begin() + static_cast<std::ptrdiff_t>(i) * kNumFlightMetrics,
                    kNumFlightMetrics, episode.metrics.begin());
      }
      if (measurer) episode.measures = measurer->Report(i);
      NoteTarget(env.config(), dwell_steps, measurer.has_value(), &episode);
      --flying;
    }
  }
}

}  // namespace

VecEnv MakeEvaluationEnv(const Agent& agent, const EnvConfig& config,
                         const EvaluationOptions& options) {
  if (options.episodes <= 0) throw Error("an evaluation needs at least one episode");
  VecEnv env(EvaluationConfig(config), options.episodes, options.seed ^ kEvaluationStream,
             kTileSize, agent.low_level());
  agent.CheckFits(env);
  return env;
}

TileAgent MakeEvaluationAgent(const Agent& agent, const VecEnv& env, int tile,
                              const EvaluationOptions& options) {
  return {agent, env, tile, options.seed ^ kEvaluationStream};
}

FlownEpisodes FlyEpisodes(const Agent& agent, const EnvConfig& config,
                          const EvaluationOptions& options, WorkerPool& pool) {
  VecEnv env = MakeEvaluationEnv(agent, config, options);
  FlownEpisodes flown;
  flown.starts = HashOfStarts(env);
  Episode unflown;
  unflown.metrics.fill(std::numeric_limits<float>::quiet_NaN());
  flown.episodes.assign(options.episodes, unflown);
  pool.ForEach(env.num_tiles(), [&](int tile, int) {
    FlyTile(agent, env, tile, options, pool, flown.episodes.data() + env.tile_begin(tile));
  });
  return flown;
}

EvaluationResult Summarise(const std::vector<Episode>& episodes, double control_interval_s) {
  EvaluationResult result;
  result.episodes = static_cast<int>(episodes.size());
  int successes = 0, reached = 0;
  double steps_to_target = 0;
  for (const Episode& episode : episodes) {
    ++result.terminations[static_cast<std::size_t>(episode.termination)];
    result.return_mean += episode.episode_return;
    successes += episode.succeeded;
    if (episode.reached_step == 0) continue;
    ++reached;
    steps_to_target += episode.entered_step;
  }
  result.return_mean /= result.episodes;
  result.success_rate = static_cast<double>(successes) / result.episodes;
  result.time_to_target_mean_s = reached > 0 ? control_interval_s * steps_to_target / reached
                                             : std::numeric_limits<double>::quiet_NaN();
  return result;
}

EvaluationResult Evaluate(const Agent& agent, const EnvConfig& config,
                          const EvaluationOptions& options, WorkerPool& pool) {
  return Summarise(FlyEpisodes(agent, config, options, pool).episodes, config.control_interval_s);
}

}  // namespace skein
