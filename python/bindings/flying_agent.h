// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

#include <memory>
#include <optional>
#include <string>

#include "src/config/program_config.h"
#include "train/policy/agent.h"
#include "train/policy/recurrent_policy.h"

namespace skein {

/// An agent and the sizes of its rows, as Python holds it.
struct FlyingAgent {
  std::string name;
  Agent agent;
  int observation_size = 0, action_size = 0;
  int action_repeat = 1;  ///< control steps for which its actions are to be held
  std::optional<RecurrentPolicy> policy = {};    ///< if it is a trained one
  bool draws = false;                            ///< its actions at random
  std::optional<ProgramConfig> run_config = {};  ///< recorded by the run that it is of
  bool flies_any_aircraft = false;               ///< whatever it was trained on
};

/// A callable of Python as an agent: it is given float32 observations [count][observation_size],
/// and if it asks for memory (`state_size` > 0) float32 rows of it, zeros at an episode's
/// beginning; and returns actions [count][action_size], with memory a pair of actions and memory.
struct PythonAgentOptions {
  int observation_size = 0;
  int action_size = 0;
  int action_repeat = 1;
  int state_size = 0;
};
std::shared_ptr<const Policy> MakePythonPolicy(nanobind::object callable,
                                               const PythonAgentOptions& options);

}  // namespace skein
