// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/last_states.h"

#include <algorithm>

namespace skein {

LastStates::LastStates(int num_aircraft, int num_targets, int control_steps)
    : num_aircraft_(static_cast<std::size_t>(num_aircraft)),
      num_targets_(static_cast<std::size_t>(num_targets)),
      control_steps_(control_steps),
      stride_(TileStride(num_aircraft)),
      over_(num_aircraft_),
      seen_(num_aircraft_),
      columns_(num_columns() * stride_) {}

std::vector<float> LastStates::Columns() const {
  std::vector<float> rows;
  rows.reserve(num_columns() * num_aircraft_);
  for (std::size_t column = 0; column < num_columns(); ++column) {
    const float* const begin = columns_.data() + column * stride_;
    rows.insert(rows.end(), begin, begin + num_aircraft_);
  }
  return rows;
}

void LastStates::Begin() {
  std::fill(over_.begin(), over_.end(), std::uint8_t{0});
  std::fill(seen_.begin(), seen_.end(), 0);
}

void LastStates::See(const ControlStep& step) {
  const int seen = ++seen_[static_cast<std::size_t>(step.first_aircraft)];
  if (seen == 1) KeepTargets(step);
  if (seen == control_steps_) {
    KeepStates(step);
  } else {
    KeepEnds(step);
  }
}

/// Calls `write` with the number of each column and its values, null for zeros.
template <typename Write>
void LastStates::ForEachState(const ControlStep& step, const Write& write) {
  std::size_t column = 0;
  for (const NamedColumn& shown : kShownColumns) {
    const bool is_stored = shown.column < kNumColumns || step.state.windy;
    write(column++, is_stored ? step.state[shown.column] : nullptr);
  }
  for (std::size_t k = 0; k < kNumTaskErrors; ++k) {
    write(column++, step.errors + k * step.error_stride);
  }
}

void LastStates::KeepTargets(const ControlStep& step) {
  for (std::size_t k = 0; k < num_targets_; ++k) {
    std::copy_n(step.task[static_cast<int>(k)], step.state.count,
                ColumnAt(kNumStateColumns + k, step.first_aircraft));
  }
}

/// Of aircraft that still fly.
void LastStates::KeepStates(const ControlStep& step) {
  const std::uint8_t* const over = over_.data() + step.first_aircraft;
  ForEachState(step, [&](std::size_t column, const float* values) {
    float* const kept = ColumnAt(column, step.first_aircraft);
    for (int i = 0; i < step.state.count; ++i) {
      const float value = values == nullptr ? 0 : values[i];
      kept[i] = over[i] != 0 ? kept[i] : value;
    }
  });
}

/// Of aircraft whose episodes end before the policy step does.
void LastStates::KeepEnds(const ControlStep& step) {
  std::uint8_t* const over = over_.data() + step.first_aircraft;
  for (int i = 0; i < step.state.count; ++i) {
    if (step.termination[i] == 0 || over[i] != 0) continue;
    over[i] = 1;
    ForEachState(step, [&](std::size_t column, const float* values) {
      *ColumnAt(column, step.first_aircraft + i) = values == nullptr ? 0 : values[i];
    });
  }
}

}  // namespace skein
