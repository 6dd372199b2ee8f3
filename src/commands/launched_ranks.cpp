// SPDX-License-Identifier: Apache-2.0
#include "src/commands/launched_ranks.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>

#include "base/error.h"
#include "src/config/usage_error.h"
#include "src/config/whole_number.h"
#include "train/files/file_descriptor.h"
#include "train/ranks/rank_module.h"

namespace skein {
namespace {

/// What is written to the standard output from now on is lost.
void CloseStandardOutput() {
  std::fflush(stdout);
  const FileDescriptor nothing("/dev/null", OpenMode::kWrite);
  if (dup2(nothing.value(), STDOUT_FILENO) < 0) {
    throw Error("the standard output cannot be closed: " + SystemReason());
  }
}

void RequirePowerOfTwo(int ranks) {
  if ((ranks & (ranks - 1)) == 0) return;
  throw UsageError(fmt::format("{} processes cannot work together: a power of two can, such as {}",
                               ranks, 1 << static_cast<int>(std::log2(ranks))));
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

void OnLaunchedRanks(double timeout_s, const std::function<void(Ranks& ranks)>& work) {
  const std::unique_ptr<Ranks> joined = JoinLaunchedProcesses(timeout_s);
  if (joined == nullptr) {
    work(OneRank());
    return;
  }
  try {
    RequirePowerOfTwo(joined->count());
    if (joined->rank() != 0) CloseStandardOutput();
    work(*joined);
  } catch (const Error&) {
    // Every rank has been told: rank 0 says it.
    if (joined->rank() == 0) throw;
  } catch (const std::exception& failure) {
    // No memory, no thread: it befell this rank alone, and the others wait for it.
    if (joined->rank() == 0) throw;
    joined->Abort(failure.what());
  }
}

}  // namespace skein
