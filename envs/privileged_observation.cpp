// SPDX-License-Identifier: Apache-2.0
#include "envs/privileged_observation.h"

#include <algorithm>

#include "envs/state/state.h"

namespace skein {
namespace {

constexpr float kPerWindFps = 1.0f / 100;

/// Fills rows column by column.
class RowWriter {
 public:
  RowWriter(int count, int size, float* rows) : count_(count), size_(size), rows_(rows) {}

  /// The next column: value(i) for every aircraft.
  template <typename Value>
  void Put(const Value& value) {
    for (int i = 0; i < count_; ++i) rows_[i * size_ + next_] = value(i);
    ++next_;
  }

 private:
  int count_, size_;
  float* rows_;
  int next_ = 0;
};

}  // namespace

std::vector<std::string> PrivilegedObservation::names() const {
  std::vector<std::string> names = {"task_error_0", "task_error_1", "task_error_2", "clock",
                                    "tolerance"};
  if (rules_.dwell_steps > 0) names.emplace_back("dwell");
  if (rules_.hold_steps > 0) names.emplace_back("reached");
  if (windy_) names.insert(names.end(), {"wind_x", "wind_y", "wind_z"});
  return names;
}

void PrivilegedObservation::Observe(const EnvBlock& block, float* rows) const {
  alignas(64) float errors[kNumTaskErrors * kAircraftPerBlock];
  task_.Errors(block.flight, block.task, errors, kAircraftPerBlock);
  RowWriter writer(block.count, size(), rows);
  for (int k = 0; k < kNumTaskErrors; ++k) {
    writer.Put([&](int i) { return errors[k * kAircraftPerBlock + i]; });
  }
  const float per_step = 1 / static_cast<float>(rules_.time_limit_steps);
  writer.Put([&](int i) { return per_step * static_cast<float>(block.step[i]); });
  writer.Put([&](int i) { return task_.ToleranceShare(block.task, i); });
  if (rules_.dwell_steps > 0) {
    const float per_dwell_step = 1 / static_cast<float>(rules_.dwell_steps);
    writer.Put([&](int i) {
      return std::min(1.0f, per_dwell_step * static_cast<float>(block.progress.steps_within[i]));
    });
  }
  if (rules_.hold_steps > 0) {
    writer.Put([&](int i) { return block.progress.reached_step[i] > 0 ? 1.0f : 0.0f; });
  }
  if (!windy_) return;
  for (int k = 0; k < 3; ++k) {
    const float *const ground = block.flight[kU + k], *const air = block.flight[kAirU + k];
    writer.Put([=](int i) { return (ground[i] - air[i]) * kPerWindFps; });
  }
}

}  // namespace skein
