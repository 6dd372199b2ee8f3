// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "train/ranks/ranks.h"

namespace skein {

/// Other ranks, and how long they took to exchange, waiting for each other included.
class TimedRanks final : public Ranks {
 public:
  /// `ranks` must outlive it.
  explicit TimedRanks(Ranks& ranks) : ranks_(ranks) {}

  double exchange_seconds() const { return seconds_; }      ///< so far
  std::uint64_t sent_bytes() const { return sent_bytes_; }  ///< so far

  int rank() const override { return ranks_.rank(); }
  int count() const override { return ranks_.count(); }
  std::string Describe(int rank) const override { return ranks_.Describe(rank); }
  void Exchange(int partner, const void* send, std::size_t send_bytes, void* receive,
                std::size_t receive_bytes) override {
    const auto start = std::chrono::steady_clock::now();
    ranks_.Exchange(partner, send, send_bytes, receive, receive_bytes);
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    sent_bytes_ += send_bytes;
  }
  void Notify(int rank, std::int64_t word) override { ranks_.Notify(rank, word); }
  std::optional<Notice> TakeNotice() override { return ranks_.TakeNotice(); }
  [[noreturn]] void Abort(const std::string& reason) override {
    ranks_.Abort(reason);
    std::abort();  // not reached: the compiler does not see it through the virtual call
  }

 private:
  Ranks& ranks_;
  double seconds_ = 0;
  std::uint64_t sent_bytes_ = 0;
};

}  // namespace skein
