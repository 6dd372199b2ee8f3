// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mpi.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "train/ranks/ranks.h"

namespace skein {

/// The processes of an MPI job. Made on the thread that computes.
class MpiRanks final : public Ranks {
 public:
  /// MPI counts in ints: what is longer than this goes in several messages.
  static constexpr std::size_t kMostBytes = std::size_t{1} << 30;

  /// `most_bytes`: of a message; the same on all ranks.
  explicit MpiRanks(double timeout_s, std::size_t most_bytes = kMostBytes);
  ~MpiRanks() override;

  int rank() const override { return rank_; }
  int count() const override { return count_; }
  std::string Describe(int rank) const override;
  void ExchangeAll(int partner, const std::vector<Transfer>& transfers) override;
  void Notify(int rank, std::int64_t word) override;
  std::optional<Notice> TakeNotice() override;
  bool EndsWithin(double seconds) override;
  [[noreturn]] void Abort(const char* reason) override;

 private:
  using Clock = std::chrono::steady_clock;

  /// A notice on its way: it stays where it is until MPI has it.
  struct Sent {
    std::int64_t word;
    MPI_Request request;
  };

  void Wait(std::vector<MPI_Request>& requests);
  /// Tells all others that this rank waits, so that they know that it does not hang.
  void TellOthers();
  /// Takes note of who has told so since it was asked last.
  void HearOthers();
  /// Whether the rank has told so lately.
  bool Waits(int rank) const;
  /// Ends all if this is the first rank of those that wait, or none of them has for a while.
  void GiveUp(std::chrono::duration<double> waited);

  std::chrono::duration<double> timeout_, telling_interval_;
  std::size_t most_bytes_;
  std::thread::id computing_ = std::this_thread::get_id();
  int rank_ = 0, count_ = 1;
  std::vector<std::string> hosts_;
  std::string name_;  ///< of this rank, for people
  std::list<Sent> sent_;
  std::vector<Clock::time_point> heard_;  ///< by rank: when it last told that it waits
  std::optional<MPI_Request> all_end_;    ///< once this rank has come to its end
};

}  // namespace skein
