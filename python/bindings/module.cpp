// SPDX-License-Identifier: Apache-2.0
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <string>

#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "envs/interface_names.h"
#include "envs/state/state.h"
#include "envs/task_registry.h"
#include "envs/tasks/termination.h"
#include "python/bindings/bindings.h"
#include "simd/target.h"
#include "src/bench/version.h"
#include "src/config/usage_error.h"

namespace nb = nanobind;

namespace skein {
namespace {

template <typename Names>
nb::tuple NamesOf(const Names& names) {
  nb::list list;
  for (const auto& name : names) list.append(nb::str(std::string(name).c_str()));
  return nb::tuple(list);
}

void BindErrors(nb::module_& module) {
  const nb::exception<Error> error(module, "Error", PyExc_RuntimeError);
  error.doc() =
      "What is wrong with an argument, a configuration or a file, in one line. A RuntimeError.";
  // What was asked for cannot be: also a ValueError, as Python's users expect it.
  const nb::tuple bases = nb::make_tuple(error, nb::handle(PyExc_ValueError));
  const nb::exception<UsageError> usage(module, "ConfigurationError", bases);
  usage.doc() =
      "An Error about what was asked for. Also a ValueError, and a KeyError of a name that columns "
      "or figures do not have.";
}

void BindNames(nb::module_& module) {
  module.attr("ACTION_NAMES") = NamesOf(kActionNames);
  module.attr("HIGH_LEVEL_ACTION_NAMES") = NamesOf(kHighLevelActionNames);
  module.attr("OBSERVATION_NAMES") = NamesOf(kObservationNames);
  module.attr("TERMINATION_NAMES") = NamesOf(kTerminationNames);
  module.attr("TASKS") = NamesOf(TaskNames());
  module.attr("AIRCRAFT") = NamesOf(AircraftNames());
  module.attr("__version__") = Build().version;
  module.def(
      "simd_target", [] { return std::string(Name(simd::ActiveTarget())); },
      "The instruction set that kernels run on.");
}

}  // namespace
}  // namespace skein

NB_MODULE(_skein, module) {
  // What a daemon thread still has when the interpreter goes away is no leak.
  nanobind::set_leak_warnings(false);
  module.doc() = "Skein's extension module; its API is that of the package skein.";
  skein::BindErrors(module);
  skein::BindNames(module);
  skein::BindConfiguration(module);
  skein::BindEnvironment(module);
  skein::BindAgents(module);
  skein::BindEvaluation(module);
  skein::BindFlightDynamics(module);
  skein::BindTraining(module);
  skein::BindMeasures(module);
}
