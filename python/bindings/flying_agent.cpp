// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/flying_agent.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "python/bindings/bindings.h"
#include "python/bindings/interpreter_lock.h"

namespace nb = nanobind;

namespace skein {
namespace {

nb::object CopyToNumpy(const float* rows, int count, int size) {
  const std::size_t height = static_cast<std::size_t>(count),
                    width = static_cast<std::size_t>(size);
  return nb::cast(ToNumpy(std::vector<float>(rows, rows + height * width), {height, width}));
}

/// What the callable returned as rows; throws Error, calling it `what`, on another shape.
void CopyFromPython(const nb::object& returned, const char* what, int count, int size,
                    float* rows) {
  Rows<const float> array;
  if (returned.is_none() || !nb::try_cast(returned, array) ||
      array.shape(0) != static_cast<std::size_t>(count) ||
      array.shape(1) != static_cast<std::size_t>(size)) {
    std::string kind;
    if (nb::hasattr(returned, "dtype") && nb::hasattr(returned, "shape")) {
      kind = std::string(" of ") + nb::str(nb::object(returned.attr("dtype"))).c_str() +
             " and shape " + nb::repr(nb::object(returned.attr("shape"))).c_str();
    }
    throw Error(std::string("the agent must return its ") + what + " as an array of shape (" +
                std::to_string(count) + ", " + std::to_string(size) + "), but it returned " +
                nb::str(returned.type().attr("__name__")).c_str() + kind);
  }
  std::copy_n(array.data(), array.size(), rows);
}

class PythonPolicy final : public Policy {
 public:
  PythonPolicy(nb::object callable, const PythonAgentOptions& options)
      : callable_(std::move(callable)), options_(options) {}
  PythonPolicy(const PythonPolicy&) = delete;
  PythonPolicy& operator=(const PythonPolicy&) = delete;
  ~PythonPolicy() override {
    const InterpreterLocked locked;
    callable_.reset();
  }

  int observation_size() const override { return options_.observation_size; }
  int action_size() const override { return options_.action_size; }
  int state_size() const override { return options_.state_size; }
  int action_repeat() const override { return options_.action_repeat; }

  void Act(int count, const float* observation, float* state, float* action) const override {
    const InterpreterLocked locked;
    const nb::object seen = CopyToNumpy(observation, count, options_.observation_size);
    if (options_.state_size == 0) {
      CopyFromPython(callable_(seen), "actions", count, options_.action_size, action);
      return;
    }
    const nb::object returned = callable_(seen, CopyToNumpy(state, count, options_.state_size));
    if (!nb::isinstance<nb::tuple>(returned) || nb::len(returned) != 2) {
      throw Error("an agent with memory must return a pair: actions and memory");
    }
    CopyFromPython(returned[0], "actions", count, options_.action_size, action);
    CopyFromPython(returned[1], "memory", count, options_.state_size, state);
  }

 private:
  nb::object callable_;
  PythonAgentOptions options_;
};

}  // namespace

std::shared_ptr<const Policy> MakePythonPolicy(nb::object callable,
                                               const PythonAgentOptions& options) {
  return std::make_shared<PythonPolicy>(std::move(callable), options);
}

}  // namespace skein
