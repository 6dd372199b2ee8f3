// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "envs/policy.h"
#include "train/network/backend.h"

namespace skein {

struct TensorFile;

/// A policy that a file can hold, and that can be the low-level policy of a high-level one.
class StoredPolicy : public Policy {
 public:
  /// Adds what it takes to make it again.
  virtual void Store(TensorFile& file) const = 0;
  /// The same policy, its networks, if it has any, computed by `backend`.
  virtual std::shared_ptr<const StoredPolicy> OnBackend(Backend backend) const = 0;
  /// Floating-point operations of its networks' products for one action.
  virtual double FlopsPerAction() const = 0;
};

}  // namespace skein
