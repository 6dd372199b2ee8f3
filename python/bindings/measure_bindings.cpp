// SPDX-License-Identifier: Apache-2.0
#include <nanobind/stl/string.h>

#include <chrono>
#include <cstddef>
#include <vector>

#include "base/error.h"
#include "base/worker_pool.h"
#include "envs/step_memory.h"
#include "envs/vec_env.h"
#include "python/bindings/bindings.h"
#include "python/bindings/interpreter_lock.h"
#include "src/bench/machine.h"
#include "src/config/program_config.h"

namespace nb = nanobind;

namespace skein {
namespace {

/// Seconds that `steps` policy steps and observations of a VecEnv take in C++, always with the same
/// actions: what the environment is measured against.
double VecEnvSeconds(const ProgramConfig& config, const Rows<const float>& action, int threads,
                     int steps) {
  const InterpreterUnlocked unlocked;
  const std::size_t count = action.shape(0);
  WorkerPool pool(threads);
  VecEnv env(config.train.env, static_cast<int>(count), 0);
  const auto observed = static_cast<std::size_t>(env.observation_size());
  const auto acted = static_cast<std::size_t>(env.action_size());
  if (action.shape(1) != acted) throw Error("actions of another size than the environment takes");
  std::vector<float> observation(count * observed);
  StepMemory memory(env.num_aircraft(), {env.observation_size()});
  const auto start = std::chrono::steady_clock::now();
  for (int step = 0; step < steps; ++step) {
    pool.ForEach(env.num_tiles(), [&](int tile, int) {
      const auto first = static_cast<std::size_t>(env.tile_begin(tile));
      env.Step(tile, action.data() + first * acted, memory.output(env.tile_begin(tile)));
      env.Observe(tile, observation.data() + first * observed);
    });
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void BindMeasures(nb::module_& module) {
  module.def("vec_env_seconds", &VecEnvSeconds, nb::arg("config"), nb::arg("action"),
             nb::arg("threads"), nb::arg("steps"));
  module.def("describe_machine", [] { return DescribeMachine().dump(); });
}

}  // namespace skein
