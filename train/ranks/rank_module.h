// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "train/ranks/ranks.h"

namespace skein {

/// MPI in a shared object of its own (train/mpi/), so that nothing else links it and a plain start
/// does not load it. The module needs no function of the program that loads it; both must come from
/// one build.
class RankModule {
 public:
  virtual ~RankModule() = default;
  /// Joins the other processes of the launcher, for the rest of the process's life or until the
  /// result is destroyed, which waits for the others to do the same. Throws Error if the launcher
  /// is not one of this MPI. Ranks exchange in pairs: there must be a power of two of them, as the
  /// caller sees to. A partner that does not answer for `timeout_s` ends all.
  virtual std::unique_ptr<Ranks> Join(double timeout_s) const = 0;
};

/// The function that the module exports under kRankModuleEntry; `build` as for LoadModule.
using RankModuleEntry = const RankModule*(const char* build);
inline constexpr const char* kRankModuleEntry = "skein_rank_module";
inline constexpr const char* kMpiModule = "libskein_mpi.so";

/// How many processes the launcher of this one has started together (mpirun, or srun with PMIx or
/// PMI), as its environment says; 1 without a launcher.
int LaunchedProcesses();

/// One line for people if srun has started several processes of which none can find the others, as
/// it was not told how (--mpi=pmix): of the first of them; of others, and otherwise, empty.
std::string WarningOfLoneProcesses();

/// The module in `file`. Throws Error that says how to get it if it is not there, or not of this
/// build.
const RankModule& LoadRankModule(const std::string& file = kMpiModule);

/// Joins the other processes by MPI if there are several; else null: the process trains alone.
/// Throws Error as LoadRankModule, or if MPI sees another number of processes.
std::unique_ptr<Ranks> JoinLaunchedProcesses(double timeout_s);

}  // namespace skein
