// SPDX-License-Identifier: Apache-2.0
#include "train/ranks/task_share.h"

#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include "train/ranks/collectives.h"

namespace skein {
namespace {

/// A rank without a task leaves its processor to others between two looks at what has come.
constexpr std::chrono::milliseconds kPause{1};

}  // namespace

TaskShare::TaskShare(Ranks& ranks, WorkerPool& pool, std::vector<int> tasks,
                     std::function<void(int task, int rank)> taken)
    : ranks_(ranks), pool_(pool), tasks_(std::move(tasks)), taken_(std::move(taken)) {}

bool TaskShare::Do(const std::function<void(int task)>& work) {
  std::exception_ptr failure;
  for (bool is_over = false; !is_over;) {
    try {
      const std::optional<int> task = Next();
      is_over = !task.has_value();
      if (!is_over && GoesOn()) work(*task);
    } catch (const std::exception&) {
      failure = std::current_exception();
      pool_.RequestStop();
    }
  }
  DoTogether(ranks_, [&] {
    if (failure != nullptr) std::rethrow_exception(failure);
  });
  return !AgreeOnStop(ranks_, pool_);
}

bool TaskShare::GoesOn() {
  while (const std::optional<Notice> notice = ranks_.TakeNotice()) Heed(*notice);
  if (pool_.stopping()) TellStop();
  while (!waiting_.empty() && has_next()) {
    const int rank = waiting_.back();
    const int task = Take(rank);  // which may throw: then the rank still waits for the end
    waiting_.pop_back();
    ranks_.Notify(rank, task);
  }
  return !pool_.stopping();
}

std::optional<int> TaskShare::Next() {
  if (ranks_.rank() != 0) ranks_.Notify(0, kAsk);
  for (;;) {
    GoesOn();
    if (ranks_.rank() == 0 && has_next()) return Take(0);
    if (given_) return std::exchange(given_, std::nullopt);
    if (static_cast<int>(waiting_.size()) == ranks_.count() - 1 && ranks_.rank() == 0) {
      for (const int rank : waiting_) ranks_.Notify(rank, kEnd);
      return std::nullopt;
    }
    if (ended_) return std::nullopt;
    std::this_thread::sleep_for(kPause);
  }
}

void TaskShare::Heed(const Notice& notice) {
  switch (notice.word) {
    case kAsk:
      waiting_.push_back(notice.sender);
      break;
    case kStop:
      pool_.RequestStop();
      told_stop_ = ranks_.rank() != 0;
      break;
    case kEnd:
      ended_ = true;
      break;
    default:
      given_ = static_cast<int>(notice.word);
  }
}

void TaskShare::TellStop() {
  if (told_stop_) return;
  told_stop_ = true;
  if (ranks_.rank() != 0) {
    ranks_.Notify(0, kStop);
    return;
  }
  for (int rank = 1; rank < ranks_.count(); ++rank) ranks_.Notify(rank, kStop);
}

int TaskShare::Take(int rank) {
  const int task = tasks_[next_++];
  taken_(task, rank);
  return task;
}

}  // namespace skein
