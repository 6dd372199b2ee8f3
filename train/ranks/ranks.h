// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace skein {

/// The processes of one training, numbered [0, count()). All of them call what exchanges anything
/// (train/ranks/collectives.h) in the same order, each on one thread at a time.
class Ranks {
 public:
  virtual ~Ranks() = default;

  virtual int rank() const = 0;   ///< this process
  virtual int count() const = 0;  ///< a power of two
  /// For people: "rank 3 (node7)".
  virtual std::string Describe(int rank) const = 0;

  /// Sends `send_bytes` to `partner` and receives `receive_bytes` from it, both at once; either may
  /// be 0. Does not return unless it has: a partner that does not answer ends all processes.
  virtual void Exchange(int partner, const void* send, std::size_t send_bytes, void* receive,
                        std::size_t receive_bytes) = 0;

  /// Ends all processes with an exit code that is not 0, after saying `reason`, one line, on the
  /// standard error: for what has gone wrong in this process alone.
  [[noreturn]] virtual void Abort(const std::string& reason) = 0;
};

/// A process that trains alone.
Ranks& OneRank();

}  // namespace skein
