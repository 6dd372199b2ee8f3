#include "train/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "envs/vec_env.h"
#include "simd/error.h"
#include "simd/random.h"

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
             Episodes& episodes) {
  const int begin = env.tile_begin(tile), count = env.tile_count(tile);
  const int actions = env.action_size();
  std::vector<float> observation(static_cast<std::size_t>(count) * env.observation_size());
  std::vector<float> state(static_cast<std::size_t>(count) * policy.state_size(), 0.0f);
  std::vector<float> action(static_cast<std::size_t>(count) * actions), noise(action.size());
  std::vector<float> log_std(actions), reward(count), episode_return(count);
  std::vector<float> final_observation(observation.size());
  std::vector<std::uint8_t> termination(count);
  std::vector<std::int32_t> steps(count);
  std::vector<std::uint32_t> decision_low(count), decision_high(count, 0);
  StepOutput output;
  output.reward = reward.data();
  output.termination = termination.data();
  output.episode_return = episode_return.data();
  output.episode_steps = steps.data();
  output.final_observation = final_observation.data();

  int flying = count;
  for (std::uint32_t decision = 0; flying > 0; ++decision) {
    env.Observe(tile, observation.data());
    policy.Act(count, observation.data(), state.data(), action.data(), log_std.data());
    if (!options.deterministic) {
      std::fill(decision_low.begin(), decision_low.end(), decision);
      simd::FillNormals(options.seed ^ kEvaluationStream, static_cast<std::uint32_t>(begin),
                        decision_low.data(), decision_high.data(),
                        simd::RandomPurpose::kActionNoise, count, actions, noise.data());
      for (int i = 0; i < count * actions; ++i) {
        action[i] += std::exp(log_std[i % actions]) * noise[i];
      }
    }
    env.Step(tile, action.data(), output);
    for (int i = 0; i < count; ++i) {
      if (termination[i] == static_cast<std::uint8_t>(Termination::kNone)) continue;
      std::fill_n(state.begin() + static_cast<std::int64_t>(i) * policy.state_size(),
                  policy.state_size(), 0.0f);
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

EvaluationResult Evaluate(const Policy& policy, const EnvConfig& config,
                          const EvaluationOptions& options, WorkerPool& pool) {
  if (options.episodes <= 0) throw Error("an evaluation needs at least one episode");
  EnvConfig whole_episodes = config;
  whole_episodes.stagger_clocks = false;
  VecEnv env(whole_episodes, options.episodes, options.seed ^ kEvaluationStream, kTileSize);
  if (policy.observation_size() != env.observation_size() ||
      policy.action_size() != env.action_size()) {
    throw Error("the policy takes " + std::to_string(policy.observation_size()) +
                " observations and gives " + std::to_string(policy.action_size()) +
                " actions; task \"" + config.task + "\" has " +
                std::to_string(env.observation_size()) + " and " +
                std::to_string(env.action_size()));
  }
  Episodes episodes;
  episodes.termination.resize(options.episodes);
  episodes.episode_return.resize(options.episodes);
  episodes.steps.resize(options.episodes);
  pool.ForEach(env.num_tiles(),
               [&](int tile, int) { FlyTile(policy, env, tile, options, episodes); });

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
