// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "envs/state/state.h"

namespace skein {

/// A tile that owns its columns, zero at first. With kNumWindyColumns it is windy, with
/// kNumRotationalGustColumns it has rotational gusts, too.
class TestTile {
 public:
  explicit TestTile(int count, int num_columns = kNumColumns)
      : stride_(TileStride(count)),
        count_(count),
        num_columns_(num_columns),
        values_(stride_ * static_cast<std::size_t>(num_columns)) {}

  Tile tile() {
    return {values_.data(), stride_, count_, num_columns_ >= kNumWindyColumns,
            num_columns_ == kNumRotationalGustColumns};
  }
  float& at(int column, int i) { return tile()[column][i]; }
  /// The same value for all aircraft, padding included.
  void Fill(int column, float value) {
    for (std::size_t i = 0; i < stride_; ++i) tile()[column][i] = value;
  }
  std::size_t stride() const { return stride_; }
  int count() const { return count_; }
  bool operator==(const TestTile& other) const { return values_ == other.values_; }

 private:
  std::size_t stride_;
  int count_;
  int num_columns_;
  std::vector<float> values_;
};

}  // namespace skein
