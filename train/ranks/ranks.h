// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace skein {

/// A word that another rank has sent.
struct Notice {
  int sender = 0;
  std::int64_t word = 0;
};

/// What goes to another rank and what comes from it; either may be 0 bytes.
struct Transfer {
  const void* send = nullptr;
  std::size_t send_bytes = 0;
  void* receive = nullptr;
  std::size_t receive_bytes = 0;
};

/// The processes of one job, numbered [0, count()). All of them call what exchanges anything
/// (train/ranks/collectives.h) in the same order, each on one thread at a time, whichever it is.
class Ranks {
 public:
  virtual ~Ranks() = default;

  virtual int rank() const = 0;   ///< this process
  virtual int count() const = 0;  ///< a power of two
  /// For people: "rank 3 (node7)".
  virtual std::string Describe(int rank) const = 0;

  /// Sends and receives all of `transfers` at once; `partner` has as many, in the same order. Does
  /// not return unless it has: a partner that does not answer ends all processes.
  virtual void ExchangeAll(int partner, const std::vector<Transfer>& transfers) = 0;
  /// One of them.
  void Exchange(int partner, const void* send, std::size_t send_bytes, void* receive,
                std::size_t receive_bytes) {
    ExchangeAll(partner, {{send, send_bytes, receive, receive_bytes}});
  }

  /// Sends a word to another rank and does not wait for it to be taken.
  virtual void Notify(int rank, std::int64_t word) = 0;
  /// The next word that has come from another rank, of one rank in the order in which it sent them;
  /// nothing if there is none yet.
  virtual std::optional<Notice> TakeNotice() = 0;

  /// Waits for all ranks to come to their end, which each does by calling this or by being
  /// destroyed: false if they have not after `seconds`.
  virtual bool EndsWithin(double seconds) = 0;
  /// Ends all processes with an exit code that is not 0, after saying `reason`, one line, on the
  /// standard error: for what has gone wrong in this process alone, be it a lack of memory.
  [[noreturn]] virtual void Abort(const char* reason) = 0;
};

/// A process that works alone.
Ranks& OneRank();

}  // namespace skein
