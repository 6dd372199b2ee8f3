// SPDX-License-Identifier: Apache-2.0
// A fixed number of steps of one part of the simulator, on one thread and without timing, for
// scripts/count_instructions and instruction_mix: two runs with different numbers of steps differ
// by those steps alone.

#include <dlfcn.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "base/denormals.h"
#include "base/error.h"
#include "bench/instruction_trace.h"
#include "bench/positive.h"
#include "envs/aircraft/f16.h"
#include "envs/kernels/flight_control_kernel.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/step_memory.h"
#include "envs/vec_env.h"
#include "simd/random.h"
#include "simd/target.h"

namespace skein {

/// A function of its own, and known by this name outside, so that callgrind can count nothing but
/// what runs in it.
__attribute__((noinline)) void CountedSteps(int steps, const std::function<void(int)>& step) {
  for (int i = 0; i < steps; ++i) step(i);
}

namespace {

constexpr char kUsage[] =
    "usage: count_steps PART AIRCRAFT STEPS         steps one tile; PART is one of rk4,\n"
    "                                               controlled, environment,\n"
    "                                               environment_with_noise\n"
    "       count_steps PART AIRCRAFT STEPS trace   instruction by instruction: prints how often\n"
    "                                               each ran: its file, its offset there, times\n"
    "       count_steps targets                     prints the SIMD targets that run here\n";
constexpr float kDt = 0.02f;
constexpr float kThrottle = 0.2f;
constexpr int kStepsFromTrim = 50;

/// Does the steps [0, steps) by calling `step`.
using Stepper = std::function<void(int steps, const std::function<void(int)>& step)>;

void TraceSteps(int steps, const std::function<void(int)>& step) {
  for (const auto& [address, count] :
       bench::TraceInstructions([&] { CountedSteps(steps, step); })) {
    Dl_info place;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the tracer knows numbers, and dladdr pointers
    if (dladdr(reinterpret_cast<const void*>(address), &place) == 0) continue;  // the kernel's page
    const auto base = reinterpret_cast<std::uintptr_t>(place.dli_fbase);
    std::cout << place.dli_fname << ' ' << address - base << ' ' << count << '\n';
  }
}

/// Trimmed F-16s, each step one RK4 step, with flight control and actuators before it if
/// `controlled`. The sticks stay centred; flights begin anew every second, as those without control
/// would leave the tables.
void StepPlant(bool controlled, int aircraft, int steps, const Stepper& stepper) {
  const EnvConfig config;
  const VecEnv start(config, aircraft, 1, aircraft);
  const std::size_t stride = TileStride(aircraft);
  std::vector<float> columns(stride * kNumColumns);
  const Tile tile{columns.data(), stride, aircraft};
  for (std::size_t i = 0; i < stride; ++i) {
    const int drawn = static_cast<int>(i) % aircraft;  // padding flies, too
    for (int column = 0; column < kNumColumns; ++column) {
      tile[column][i] = start.StateOf(drawn, column);
    }
  }
  const auto kernel = MakeKernelAircraft(F16(), config.atmosphere);
  const FlightControlConstants constants(F16(), FlightControlMode::kFull, kDt);
  const std::vector<float> centred(stride), throttle(stride, kThrottle);
  const PilotColumns pilot{throttle.data(), centred.data(), centred.data(), centred.data()};
  const std::vector<float> trimmed = columns;
  const DenormalsFlushed flushed;
  stepper(steps, [&](int step) {
    if (step % kStepsFromTrim == 0) std::copy(trimmed.begin(), trimmed.end(), columns.begin());
    if (controlled) ControlTile(*kernel, constants, tile, pilot);
    StepTile(*kernel, tile, kDt, 1);
  });
}

/// The Heading environment under constant random actions: observe, step, reward, terminate, reset.
void StepEnvironment(double observation_noise, int aircraft, int steps, const Stepper& stepper) {
  EnvConfig config;
  config.observation_noise = observation_noise;
  VecEnv env(config, aircraft, 1, aircraft);
  const auto count = static_cast<std::size_t>(aircraft);
  std::vector<float> action(count * static_cast<std::size_t>(env.action_size()));
  simd::RandomStream random({1, 0, 0, 0, simd::RandomPurpose::kActionNoise});
  for (float& value : action) value = static_cast<float>(random.Uniform(-1, 1));
  std::vector<float> observation(count * static_cast<std::size_t>(env.observation_size()));
  StepMemory memory(aircraft, {env.observation_size()});
  stepper(steps, [&](int) {
    env.Observe(0, observation.data());
    env.Step(0, action.data(), memory.output());
  });
}

int Run(const std::vector<std::string>& arguments) {
  if (arguments.size() == 1 && arguments[0] == "targets") {
    for (const simd::Target target : simd::SupportedTargets()) std::cout << Name(target) << '\n';
    return 0;
  }
  const bool traces = arguments.size() == 4 && arguments[3] == "trace";
  if (traces || arguments.size() == 3) {
    const Stepper stepper = traces ? TraceSteps : CountedSteps;
    const std::string& part = arguments[0];
    const int aircraft = bench::Positive("AIRCRAFT", arguments[1]);
    const int steps = bench::Positive("STEPS", arguments[2]);
    if (part == "rk4" || part == "controlled") {
      StepPlant(part == "controlled", aircraft, steps, stepper);
      return 0;
    }
    if (part == "environment" || part == "environment_with_noise") {
      StepEnvironment(part == "environment" ? 0 : EnvConfig{}.observation_noise, aircraft, steps,
                      stepper);
      return 0;
    }
  }
  std::cerr << kUsage;
  return 2;
}

}  // namespace
}  // namespace skein

int main(int argc, char** argv) {
  try {
    return skein::Run({argv + 1, argv + argc});
  } catch (const skein::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
