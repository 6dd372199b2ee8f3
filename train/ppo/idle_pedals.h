// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "train/network/network.h"

namespace skein {

/// The parameters that an actor's yaw action alone has, a row of the head, its bias and its
/// standard deviation, where ppo.pedals is false: the mean action is 0, and its exploration moves
/// no rudder. Offsets are into a flat vector of layout.size() floats.
class IdlePedals {
 public:
  /// `layout` is of an actor of kActionSize outputs.
  explicit IdlePedals(const NetworkLayout& layout);

  /// Sets `parameters` to that.
  void Idle(float* parameters) const;
  /// Whether `parameters`, or a mean of such, have been set to that.
  bool AreIdle(const float* parameters) const;
  /// Lets the yaw action of such `parameters` be explored, with a deviation of exp(`log_std`).
  void Free(float log_std, float* parameters) const;
  /// Leaves nothing of `gradient` that would move them.
  void DropGradient(float* gradient) const;
  /// What the idle action adds to the entropy of the others.
  static double Entropy();

 private:
  struct Parameters {
    std::int64_t begin = 0, end = 0;
    float value = 0;
  };
  std::array<Parameters, 3> idle_;
  std::int64_t log_std_ = 0;
};

}  // namespace skein
