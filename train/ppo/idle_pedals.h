// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "train/network/network.h"

namespace skein {

/// What keeps an actor's feet on the floor: its yaw action, the last of kActionSize, is 0 whatever
/// it observes, and as good as never explored. The parameters that only this action has, a row of
/// the head, its bias and the standard deviation, are set to that and do not learn.
class IdlePedals {
 public:
  /// `layout` is of an actor of kActionSize outputs.
  explicit IdlePedals(const NetworkLayout& layout);

  /// Idles the pedals of `parameters`, layout.size() floats.
  void Apply(float* parameters) const;
  /// Leaves nothing of `gradient`, layout.size() floats, that would move them.
  void DropGradient(float* gradient) const;

 private:
  struct Parameters {
    std::int64_t begin = 0, end = 0;
    float value = 0;
  };
  std::array<Parameters, 3> idle_;
};

}  // namespace skein
