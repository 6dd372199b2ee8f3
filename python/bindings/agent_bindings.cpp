// SPDX-License-Identifier: Apache-2.0
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "envs/actions.h"
#include "envs/aircraft/registry.h"
#include "envs/task_registry.h"
#include "python/bindings/bindings.h"
#include "python/bindings/flying_agent.h"
#include "python/bindings/interpreter_lock.h"
#include "src/agents/agent_names.h"
#include "src/agents/policy_file.h"
#include "src/config/aircraft_choice.h"
#include "src/config/configuration.h"
#include "src/config/program_config.h"
#include "src/run/run_directory.h"
#include "train/policy/policy_environment.h"
#include "train/policy/policy_parameters.h"

namespace nb = nanobind;

namespace skein {
namespace {

FlyingAgent FlyingPolicy(const std::string& name, Agent agent, const RecurrentPolicy& policy,
                         bool draws) {
  return {name,
          std::move(agent),
          policy.observation_size(),
          policy.action_size(),
          policy.action_repeat(),
          policy,
          draws};
}

/// What a run has recorded; none of no run (empty).
std::optional<ProgramConfig> ConfigOfRun(const std::string& run) {
  if (run.empty()) return std::nullopt;
  return ReadRecord(run + "/config.toml");
}

FlyingAgent LoadAgent(const std::string& path, bool sampled) {
  const RecurrentPolicy policy = RecurrentPolicy::Load(PolicyFileOf(path));
  FlyingAgent flying = FlyingPolicy(
      path, sampled ? Agent::SamplingFrom(policy) : Agent::MeanOf(policy), policy, sampled);
  flying.run_config = ConfigOfRun(IsRunDirectory(path) ? path : "");
  return flying;
}

/// Says of a policy what its name says of where it flies.
FlyingAgent Named(const std::string& name, FlyingAgent flying) {
  flying.run_config = ConfigOfRun(RunOfAgent(name));
  flying.flies_any_aircraft = FliesAnyAircraft(name);
  return flying;
}

/// An agent as the command line calls it, for the environment of `config`.
FlyingAgent NamedAgent(const std::string& name, const ProgramConfig& config, std::uint64_t seed) {
  Agent agent = FindAgent(name, config, seed);
  if (const std::string file = PolicyFileOfAgent(name); !file.empty()) {
    return Named(name, FlyingPolicy(name, std::move(agent), LoadPolicy(file, config, seed),
                                    DrawsActions(name)));
  }
  const int action_repeat = agent.EnvironmentFor(config.train.env).action_repeat;
  const int observations = MakeTask(config.train.env)->observation_layout().size();
  return {name, std::move(agent), observations, kActionSize, action_repeat, {}, DrawsActions(name)};
}

/// The trained policy that an agent's name means; none of other agents.
std::optional<FlyingAgent> PolicyCalled(const std::string& name) {
  const std::string file = PolicyFileOfAgent(name);
  if (file.empty() || file == kUntrained) return std::nullopt;
  return Named(name, LoadAgent(file, false));
}

FlyingAgent CallableAgent(nb::object callable, const std::string& name, const ProgramConfig& config,
                          int action_size, int action_repeat, int state_size) {
  if (action_size < 1 || action_repeat < 1 || state_size < 0) {
    throw Error("agent " + name +
                ": action_size and action_repeat must be positive, state_size not negative");
  }
  const int observations = MakeTask(config.train.env)->observation_layout().size();
  auto policy =
      MakePythonPolicy(std::move(callable), {observations, action_size, action_repeat, state_size});
  return {name, Agent::Of(std::move(policy)), observations, action_size, action_repeat};
}

/// One policy step: actions, and the memory after it.
nb::tuple Act(const FlyingAgent& flying, const Rows<const float>& observation,
              const Rows<const float>& state, std::uint64_t seed, std::uint32_t policy_step) {
  const std::size_t count = observation.shape(0);
  const auto memory = static_cast<std::size_t>(flying.agent.state_size());
  if (observation.shape(1) != static_cast<std::size_t>(flying.observation_size)) {
    throw Error("agent " + flying.name + ": observations of " +
                std::to_string(observation.shape(1)) + " numbers, but it takes " +
                std::to_string(flying.observation_size));
  }
  if (state.shape(0) != count || state.shape(1) != memory) {
    throw Error("agent " + flying.name + ": state must have the shape (" + std::to_string(count) +
                ", " + std::to_string(memory) + ")");
  }
  std::vector<float> after(state.data(), state.data() + state.size());
  std::vector<float> action(count * static_cast<std::size_t>(flying.action_size));
  {
    const InterpreterUnlocked unlocked;
    flying.agent.Act({seed, 0, policy_step}, static_cast<int>(count), observation.data(),
                     after.data(), action.data());
  }
  return nb::make_tuple(
      ToNumpy(std::move(action), {count, static_cast<std::size_t>(flying.action_size)}),
      ToNumpy(std::move(after), {count, memory}));
}

ProgramConfig EnvironmentFor(const FlyingAgent& flying, const ProgramConfig& config) {
  ProgramConfig own = config;
  own.train.env = flying.agent.EnvironmentFor(config.train.env);
  return own;
}

/// The preset that a policy of a built-in task flies by: default, or if that is of another aircraft
/// than its own, the first that is made for that.
std::string PresetOf(const FlyingAgent& flying) {
  const std::string& task = flying.policy->task();
  const AircraftIdentity own = AircraftMadeWith(flying.policy->parameters()->environment);
  const std::vector<std::string> known = AircraftNames();
  const bool is_known = std::find(known.begin(), known.end(), own.name) != known.end();
  if (flying.flies_any_aircraft || !is_known) return "default";
  const std::string flown = ResolveConfig({task, "default", "", {}}).train.env.aircraft;
  const std::string made_for_it = flown == own.name ? "" : PresetServing(task, own.name);
  return made_for_it.empty() ? "default" : made_for_it;
}

/// What a trained policy is to fly where nothing is asked for: of a run what that has recorded,
/// else its task file, else a preset of its task. None of an agent that does not say its task.
std::optional<ProgramConfig> OwnConfig(const FlyingAgent& flying) {
  if (flying.run_config) return flying.run_config;
  if (!flying.policy || flying.policy->task().empty()) return std::nullopt;
  const std::string& task = flying.policy->task();
  if (const auto terms = TermTaskOf(*flying.policy, flying.name); terms != nullptr) {
    return ResolveConfig({task, "default", "", {}, {}, "", terms->text});
  }
  return ResolveConfig({task, PresetOf(flying), "", {}});
}

}  // namespace

void BindAgents(nb::module_& module) {
  nb::class_<FlyingAgent>(module, "FlyingAgent")
      .def_ro("name", &FlyingAgent::name)
      .def_ro("observation_size", &FlyingAgent::observation_size)
      .def_ro("action_size", &FlyingAgent::action_size)
      .def_ro("action_repeat", &FlyingAgent::action_repeat)
      .def_ro("draws", &FlyingAgent::draws)
      .def_prop_ro("state_size",
                   [](const FlyingAgent& flying) { return flying.agent.state_size(); })
      .def_prop_ro("task",
                   [](const FlyingAgent& flying) {
                     return flying.policy ? flying.policy->task() : std::string();
                   })
      .def_prop_ro("is_high_level",
                   [](const FlyingAgent& flying) { return flying.agent.low_level() != nullptr; })
      .def_prop_ro("own_config", &OwnConfig)
      .def("environment_for", &EnvironmentFor, nb::arg("config"))
      .def("act", &Act, nb::arg("observation"), nb::arg("state"), nb::arg("seed"),
           nb::arg("policy_step"));
  module.def("load_agent", &LoadAgent, nb::arg("path"), nb::arg("sampled"));
  module.def("named_agent", &NamedAgent, nb::arg("name"), nb::arg("config"), nb::arg("seed"));
  module.def("policy_called", &PolicyCalled, nb::arg("name"));
  module.def("callable_agent", &CallableAgent, nb::arg("callable"), nb::arg("name"),
             nb::arg("config"), nb::arg("action_size"), nb::arg("action_repeat"),
             nb::arg("state_size"));
}

}  // namespace skein
