// SPDX-License-Identifier: Apache-2.0
// Loads a trained policy, flies 256 episodes of its task and prints the path of the first.
//   fly_policy policies/heading.skein
#include <skein/base/worker_pool.h>
#include <skein/envs/state/state.h>
#include <skein/train/policy/evaluate.h>
#include <skein/train/policy/record_flights.h>
#include <skein/train/policy/recurrent_policy.h>

#include <cstddef>
#include <cstdio>
#include <exception>
#include <vector>

namespace {

void FlyPolicy(const char* path) {
  const skein::RecurrentPolicy policy = skein::RecurrentPolicy::Load(path);
  const skein::Agent agent = skein::Agent::MeanOf(policy);

  skein::EnvConfig config;
  config.task = policy.task();
  config.drag_rises = config.thrust_grows = true;  // what Heading's default preset flies
  config = policy.EnvironmentFor(config);          // observes and holds actions as it was trained

  skein::EvaluationOptions options;
  options.episodes = 256;
  options.seed = 7;
  skein::WorkerPool pool;  // a thread per core
  const skein::EvaluationResult result = skein::Evaluate(agent, config, options, pool);
  std::printf("%s: %d episodes of %s, %.1f %% reached their target, after %.1f s on average\n",
              path, result.episodes, config.task.c_str(), 100 * result.success_rate,
              result.time_to_target_mean_s);

  const std::vector<skein::RecordedFlight> flights =
      skein::RecordFlights(agent, config, options, 1, pool);
  constexpr std::size_t kSecond = 50;  // control steps
  std::printf("first flight: time_s north_ft east_ft altitude_ft\n");
  for (std::size_t step = 0; step < flights[0].steps.size(); step += kSecond) {
    const auto& state = flights[0].steps[step].state;
    std::printf("%6.0f %10.0f %10.0f %10.0f\n", static_cast<double>(step) / kSecond,
                state[skein::kNorth], state[skein::kEast], -state[skein::kDown]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fly_policy POLICY.skein\n");
    return 2;
  }
  try {
    FlyPolicy(argv[1]);
  } catch (const std::exception& error) {  // skein::Error says what is wrong in one line
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
