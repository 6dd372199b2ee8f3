// SPDX-License-Identifier: Apache-2.0
#include "src/commands/launched_ranks.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/reason_of.h"
#include "src/config/configuration.h"
#include "src/config/usage_error.h"
#include "src/config/whole_number.h"
#include "train/files/file_descriptor.h"
#include "train/ppo/rank_shards.h"
#include "train/ranks/collectives.h"
#include "train/ranks/rank_module.h"

namespace skein {
namespace {

/// How long ranks that have been told of an error take to end, at most.
constexpr double kEndS = 5;

/// What is written to the standard output from now on is lost.
void CloseStandardOutput() {
  std::fflush(stdout);
  const FileDescriptor nothing("/dev/null", OpenMode::kWrite);
  if (dup2(nothing.value(), STDOUT_FILENO) < 0) {
    throw Error("the standard output cannot be closed: " + SystemReason());
  }
}

}  // namespace

void AddRankTimeoutOption(CLI::App* command, double* timeout_s) {
  command
      ->add_option("--rank-timeout", *timeout_s,
                   "of several processes (mpirun, srun): seconds after which one that does not "
                   "answer ends all")
      ->type_name("SECONDS")
      ->transform(NumberAboveZero())
      ->capture_default_str();
}

void WorkAsRank(Ranks& ranks, const std::function<void(Ranks& ranks)>& work) {
  const bool leads = ranks.rank() == 0;
  if ((ranks.count() & (ranks.count() - 1)) != 0) {
    if (!leads) return;
    throw UsageError(
        fmt::format("{} processes cannot work together: a power of two can, such as {}",
                    ranks.count(), 1 << static_cast<int>(std::log2(ranks.count()))));
  }
  try {
    work(ranks);
  } catch (const JointError&) {
    if (leads) throw;
  } catch (const std::exception& failure) {
    // Of what rank 0 throws the others mostly know, and end. Else they wait for this rank.
    if (!leads || !ranks.EndsWithin(kEndS)) ranks.Abort(ReasonOf(failure));
    throw;
  }
}

void OnLaunchedRanks(double timeout_s, const std::function<void(Ranks& ranks)>& work) {
  const std::unique_ptr<Ranks> joined = JoinLaunchedProcesses(timeout_s);
  if (joined == nullptr) {
    const std::string warning = WarningOfLoneProcesses();
    if (!warning.empty()) fmt::print(stderr, "warning: {}\n", warning);
    work(OneRank());
    return;
  }
  WorkAsRank(*joined, [&](Ranks& ranks) {
    if (ranks.rank() != 0) CloseStandardOutput();
    work(ranks);
  });
}

void ChooseShards(const std::vector<std::string>& assignments, const Ranks& ranks,
                  TrainConfig* config) {
  const bool is_chosen =
      config->learner.shards > 1 ||
      std::any_of(assignments.begin(), assignments.end(), [](const std::string& assignment) {
        return KeyOf(assignment) == "learner.shards";
      });
  if (!is_chosen && ranks.count() > 1) {
    config->learner.shards = DefaultShards(*config, ranks.count());
  }
  AsUsage([&] { return ShardsOfRank(*config, ranks); });
}

}  // namespace skein
