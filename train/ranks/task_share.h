// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/worker_pool.h"
#include "train/ranks/ranks.h"

namespace skein {

/// Long tasks that ranks share: each is done by one rank alone, and a rank that has nothing to do
/// takes the next. A rank whose pool is stopping, or whose task fails, stops all ranks' pools.
/// Nobody waits for a rank at work but in Do, however long that takes.
class TaskShare {
 public:
  /// `tasks`, numbers from 0, and `taken`, which is told which rank does one before it does, matter
  /// on rank 0 alone. Ranks and pool must outlive it.
  TaskShare(Ranks& ranks, WorkerPool& pool, std::vector<int> tasks,
            std::function<void(int task, int rank)> taken);

  /// On all ranks together: calls work(task) for each task on some rank. Returns false if it was
  /// stopped before all were done. Throws on all ranks what one of them threw (DoTogether).
  bool Do(const std::function<void(int task)>& work);

  /// To be called by `work` now and then: hands out tasks to ranks that wait, and says whether to
  /// go on; false is also for ever.
  bool GoesOn();

 private:
  enum Word : std::int64_t { kAsk = -1, kStop = -2, kEnd = -3 };  ///< else the number of a task

  /// What this rank does next; nothing when no rank has anything left to do.
  std::optional<int> Next();
  void Heed(const Notice& notice);
  void TellStop();
  /// On rank 0.
  bool has_next() const { return next_ < tasks_.size() && !pool_.stopping(); }
  int Take(int rank);

  Ranks& ranks_;
  WorkerPool& pool_;
  std::vector<int> tasks_;
  std::function<void(int, int)> taken_;
  std::size_t next_ = 0;      ///< of rank 0's tasks
  std::vector<int> waiting_;  ///< ranks that have asked rank 0 for a task
  std::optional<int> given_;  ///< by rank 0
  bool told_stop_ = false, ended_ = false;
};

}  // namespace skein
