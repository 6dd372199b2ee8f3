// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "envs/env_storage.h"

namespace skein {

/// What an environment knows of its aircraft and no policy observes: free of noise, and for
/// training alone, as the further input of a critic.
class PrivilegedObservation {
 public:
  /// Of an environment whose tiles are windy or not.
  explicit PrivilegedObservation(bool windy) : windy_(windy) {}

  /// What the numbers of a row are, each of about unit size:
  ///   the task's three errors, without noise
  ///   in windy tiles the wind along the body axes, in units of 100 ft/s
  std::vector<std::string> names() const;
  int size() const;

  /// Writes rows, row-major [block.count][size()]. `errors` are the task's, as columns
  /// `error_stride` apart.
  void Observe(const EnvBlock& block, const float* errors, std::size_t error_stride,
               float* rows) const;

 private:
  bool windy_;
};

}  // namespace skein
