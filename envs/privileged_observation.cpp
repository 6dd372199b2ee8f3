// SPDX-License-Identifier: Apache-2.0
#include "envs/privileged_observation.h"

#include "envs/state/state.h"
#include "envs/tasks/task.h"

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
  std::vector<std::string> names = {"task_error_0", "task_error_1", "task_error_2"};
  if (windy_) names.insert(names.end(), {"wind_x", "wind_y", "wind_z"});
  return names;
}

int PrivilegedObservation::size() const { return kNumTaskErrors + (windy_ ? 3 : 0); }

void PrivilegedObservation::Observe(const EnvBlock& block, const float* errors,
                                    std::size_t error_stride, float* rows) const {
  RowWriter writer(block.count, size(), rows);
  for (std::size_t k = 0; k < kNumTaskErrors; ++k) {
    writer.Put([&](int i) { return errors[k * error_stride + static_cast<std::size_t>(i)]; });
  }
  if (!windy_) return;
  for (int k = 0; k < 3; ++k) {
    const float *const ground = block.flight[kU + k], *const air = block.flight[kAirU + k];
    writer.Put([=](int i) { return (ground[i] - air[i]) * kPerWindFps; });
  }
}

}  // namespace skein
