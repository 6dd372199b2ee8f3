// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "train/ranks/ranks.h"

namespace skein {

/// Other ranks, and how long they took to exchange, waiting for each other included. Made on the
/// thread that computes.
class TimedRanks final : public Ranks {
 public:
  /// `ranks` must outlive it.
  explicit TimedRanks(Ranks& ranks) : ranks_(ranks) {}

  double exchange_seconds() const { return seconds_; }  ///< so far, on whichever thread
  /// Those of them in which the thread that computes did nothing else.
  double idle_seconds() const { return idle_seconds_; }
  std::uint64_t exchanges() const { return exchanges_; }    ///< so far
  std::uint64_t sent_bytes() const { return sent_bytes_; }  ///< so far

  int rank() const override { return ranks_.rank(); }
  int count() const override { return ranks_.count(); }
  std::string Describe(int rank) const override { return ranks_.Describe(rank); }
  void ExchangeAll(int partner, const std::vector<Transfer>& transfers) override {
    const auto start = std::chrono::steady_clock::now();
    ranks_.ExchangeAll(partner, transfers);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    seconds_ += seconds;
    ++exchanges_;
    if (std::this_thread::get_id() == computing_) idle_seconds_ += seconds;
    for (const Transfer& transfer : transfers) sent_bytes_ += transfer.send_bytes;
  }
  void Notify(int rank, std::int64_t word) override { ranks_.Notify(rank, word); }
  std::optional<Notice> TakeNotice() override { return ranks_.TakeNotice(); }
  bool EndsWithin(double seconds) override { return ranks_.EndsWithin(seconds); }
  [[noreturn]] void Abort(const char* reason) override {
    ranks_.Abort(reason);
    std::abort();  // not reached: the compiler does not see it through the virtual call
  }

 private:
  Ranks& ranks_;
  std::thread::id computing_ = std::this_thread::get_id();
  double seconds_ = 0, idle_seconds_ = 0;
  std::uint64_t exchanges_ = 0, sent_bytes_ = 0;
};

}  // namespace skein
