// SPDX-License-Identifier: Apache-2.0
// Flies 256 F-16s to random headings, altitudes and speeds with an autopilot for two simulated
// minutes, as a learner or a controller of your own would.
#include <skein/base/error.h>
#include <skein/envs/autopilot/autopilot.h>
#include <skein/envs/step_memory.h>
#include <skein/envs/vec_env.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <vector>

namespace {

constexpr int kAircraft = 256;
constexpr int kControlSteps = 6000;  // of 0.02 s

void FlyAutopilot() {
  skein::EnvConfig config;
  config.task = "heading";
  const std::unique_ptr<skein::Policy> autopilot =
      skein::MakeAutopilot(config, skein::AutopilotVariant::kTraditional);
  config = autopilot->EnvironmentFor(config);  // holds actions for as long as the autopilot does

  constexpr std::uint64_t kSeed = 1;
  skein::VecEnv env(config, kAircraft, kSeed, kAircraft);  // one tile: each may have its own thread

  std::vector<float> observation(kAircraft * env.observation_size());
  std::vector<float> action(kAircraft * env.action_size());
  std::vector<float> memory(kAircraft * autopilot->state_size());  // zeros: an episode begins
  skein::StepMemory step(kAircraft);  // what a step writes: rewards, ends of episodes

  int episodes = 0, reached = 0;
  for (int flown = 0; flown < kControlSteps; flown += config.action_repeat) {
    env.Observe(0, observation.data());
    autopilot->Act(kAircraft, observation.data(), memory.data(), action.data());
    env.Step(0, action.data(), step.output());
    for (int i = 0; i < kAircraft; ++i) {
      const auto end = static_cast<skein::Termination>(step.termination[i]);
      if (end == skein::Termination::kNone) continue;
      ++episodes;
      reached += end == skein::Termination::kTargetReached;
      std::fill_n(memory.begin() + i * autopilot->state_size(), autopilot->state_size(), 0.0f);
    }
  }
  std::printf("%d of %d episodes reached their target\n", reached, episodes);
  std::printf("aircraft 0 is at %.0f ft\n", -env.StateOf(0, skein::kDown));
}

}  // namespace

int main() {
  try {
    FlyAutopilot();
  } catch (const std::exception& error) {  // skein::Error says what is wrong in one line
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
