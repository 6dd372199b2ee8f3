#include "train/evaluate.h"

#include <limits>
#include <vector>

#include "envs/vec_env.h"
#include "simd/error.h"

namespace skein {
namespace {

/// Aircraft per tile: few enough that many threads share the episodes.
constexpr int kTileSize = 128;
/// Keeps the episodes of an evaluation apart from those of training with the same seed.
constexpr std::uint64_t kEvaluationStream = 0xA5B35705E7C0FFEE;

/// The first episode of each aircraft.
struct Episodes {
  std::vector<std::uint8_t> termination;
  std::vector<float> episode_return;
  std::vector<std::int32_t> steps;
};

void FlyTile(const Policy& policy, VecEnv& env, int tile, const EvaluationOptions& options,
             const WorkerPool& pool, Episodes& episodes) {
  const int begin = env.tile_begin(tile), count = env.tile_count(tile);
  std::vector<float> reward(count), episode_return(count);
  std::vector<float> final_observation(static_cast<std::size_t>(count) * env.observation_size());
  std::vector<std::uint8_t> termination(count);
  std::vector<std::int32_t> steps(count);
  StepOutput output;
  output.reward = reward.data();
  output.termination = termination.data();
  output.episode_return = episode_return.data();
  output.episode_steps = steps.data();
  output.final_observation = final_observation.data();

  TilePilot pilot = MakeEvaluationPilot(policy, env, tile, options);
  for (int flying = count; flying > 0 && !pool.stopping();) {
    env.Step(tile, pilot.Decide().data(), output);
    for (int i = 0; i < count; ++i) {
      if (termination[i] == static_cast<std::uint8_t>(Termination::kNone)) continue;
      pilot.Forget(i);
      if (episodes.termination[begin + i] != static_cast<std::uint8_t>(Termination::kNone)) {
        continue;
      }
      episodes.termination[begin + i] = termination[i];
      episodes.episode_return[begin + i] = episode_return[i];
      episodes.steps[begin + i] = steps[i];
      --flying;
    }
  }
}

}  // namespace

VecEnv MakeEvaluationEnv(const Policy& policy, const EnvConfig& config,
                         const EvaluationOptions& options) {
  if (options.episodes <= 0) throw Error("an evaluation needs at least one episode");
  VecEnv env(EvaluationConfig(config), options.episodes, options.seed ^ kEvaluationStream,
             kTileSize, policy.controller());
  if (policy.observation_size() != env.observation_size() ||
      policy.action_size() != env.action_size()) {
    throw Error("the policy takes " + std::to_string(policy.observation_size()) +
                " observations and gives " + std::to_string(policy.action_size()) +
                " actions; task \"" + config.task + "\" has " +
                std::to_string(env.observation_size()) + " and " +
                std::to_string(env.action_size()));
  }
  return env;
}

TilePilot MakeEvaluationPilot(const Policy& policy, const VecEnv& env, int tile,
                              const EvaluationOptions& options) {
  return {policy, env, tile, options.seed ^ kEvaluationStream, options.deterministic};
}

EvaluationResult Evaluate(const Policy& policy, const EnvConfig& config,
                          const EvaluationOptions& options, WorkerPool& pool) {
  VecEnv env = MakeEvaluationEnv(policy, config, options);
  Episodes episodes;
  episodes.termination.resize(options.episodes);
  episodes.episode_return.resize(options.episodes);
  episodes.steps.resize(options.episodes);
  pool.ForEach(env.num_tiles(),
               [&](int tile, int) { FlyTile(policy, env, tile, options, pool, episodes); });

  EvaluationResult result;
  result.episodes = options.episodes;
  double successes = 0, success_steps = 0;
  for (int i = 0; i < options.episodes; ++i) {
    ++result.terminations[episodes.termination[i]];
    result.return_mean += episodes.episode_return[i];
    if (episodes.termination[i] != static_cast<std::uint8_t>(Termination::kResetTarget)) continue;
    ++successes;
    success_steps += episodes.steps[i];
  }
  result.return_mean /= options.episodes;
  result.success_rate = successes / options.episodes;
  result.time_to_target_mean_s = successes > 0
                                     ? config.control_interval_s * success_steps / successes
                                     : std::numeric_limits<double>::quiet_NaN();
  return result;
}

}  // namespace skein
