// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/error.h"
#include "train/ranks/ranks.h"

namespace skein {

/// Messages between threads that stand for ranks.
class Mailboxes {
 public:
  void Put(int from, int to, const void* data, std::size_t bytes) {
    const auto* const begin = static_cast<const char*>(data);
    const std::lock_guard lock(mutex_);
    boxes_[{from, to}].emplace_back(begin, begin + bytes);
    arrived_.notify_all();
  }
  void Take(int from, int to, void* data, std::size_t bytes) {
    std::unique_lock lock(mutex_);
    std::deque<std::vector<char>>& box = boxes_[{from, to}];
    arrived_.wait(lock, [&] { return !box.empty(); });
    if (box.front().size() != bytes) throw Error("ranks are not at the same exchange");
    std::memcpy(data, box.front().data(), bytes);
    box.pop_front();
  }

  void PutNotice(int to, const Notice& notice) {
    const std::lock_guard lock(mutex_);
    notices_[to].push_back(notice);
  }
  std::optional<Notice> TakeNotice(int to) {
    const std::lock_guard lock(mutex_);
    std::deque<Notice>& box = notices_[to];
    if (box.empty()) return std::nullopt;
    const Notice notice = box.front();
    box.pop_front();
    return notice;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::map<int, std::deque<Notice>> notices_;
  std::map<std::pair<int, int>, std::deque<std::vector<char>>> boxes_;
};

/// A rank that is a thread of this process.
class ThreadRank final : public Ranks {
 public:
  ThreadRank(Mailboxes& mailboxes, int rank, int count)
      : mailboxes_(mailboxes), rank_(rank), count_(count) {}

  int rank() const override { return rank_; }
  int count() const override { return count_; }
  std::string Describe(int rank) const override { return "rank " + std::to_string(rank); }
  void ExchangeAll(int partner, const std::vector<Transfer>& transfers) override {
    for (const auto& [send, bytes, receive, receive_bytes] : transfers) {
      if (bytes > 0) mailboxes_.Put(rank_, partner, send, bytes);
    }
    for (const auto& [send, send_bytes, receive, bytes] : transfers) {
      if (bytes > 0) mailboxes_.Take(partner, rank_, receive, bytes);
    }
  }
  void Notify(int rank, std::int64_t word) override { mailboxes_.PutNotice(rank, {rank_, word}); }
  std::optional<Notice> TakeNotice() override { return mailboxes_.TakeNotice(rank_); }
  bool EndsWithin(double /*seconds*/) override { return true; }
  [[noreturn]] void Abort(const char* reason) override {
    throw Error(std::string("aborted: ") + reason);
  }

 private:
  Mailboxes& mailboxes_;
  int rank_, count_;
};

/// Runs `body` on every rank. Throws what the first of them threw.
inline void RunOnRanks(int count, const std::function<void(Ranks&)>& body) {
  Mailboxes mailboxes;
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(count));
  std::vector<std::thread> threads;
  for (int rank = 0; rank < count; ++rank) {
    threads.emplace_back([&, rank] {
      ThreadRank ranks(mailboxes, rank, count);
      try {
        body(ranks);
      } catch (...) {
        failures[static_cast<std::size_t>(rank)] = std::current_exception();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& failure : failures) {
    if (failure != nullptr) std::rethrow_exception(failure);
  }
}

}  // namespace skein
