// SPDX-License-Identifier: Apache-2.0
#include "train/ranks/rank_module.h"

#include <cstdlib>

#include "base/error.h"
#include "base/shared_module.h"

namespace skein {
namespace {

/// OpenMPI's mpirun, and launchers that speak PMI; PMIx says the size only if asked, Slurm does.
constexpr const char* kSizes[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"};
constexpr const char* kSlurmSize = "SLURM_STEP_NUM_TASKS";

int NumberIn(const char* variable) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? 0 : std::atoi(text);
}

}  // namespace

int LaunchedProcesses() {
  for (const char* const size : kSizes) {
    if (NumberIn(size) > 0) return NumberIn(size);
  }
  const bool is_slurm_step = std::getenv("PMIX_RANK") != nullptr;
  return is_slurm_step && NumberIn(kSlurmSize) > 0 ? NumberIn(kSlurmSize) : 1;
}

std::string WarningOfLoneProcesses() {
  const int started = NumberIn(kSlurmSize);
  if (started <= 1 || LaunchedProcesses() > 1 || NumberIn("SLURM_PROCID") != 0) return "";
  return "srun has started " + std::to_string(started) +
         " processes that do not know of each other, so each does all of the work alone: to share "
         "it, start them with srun --mpi=pmix";
}

const RankModule& LoadRankModule(const std::string& file) {
  try {
    return LoadModule<RankModuleEntry>(file, kRankModuleEntry, SKEIN_BUILD_ID);
  } catch (const Error& error) {
    throw Error("started as one of " + std::to_string(LaunchedProcesses()) +
                " processes, but trainings on several are not available" +
                WhyNotLoaded(error,
                             "install MPI (with Debian's package of Skein: openmpi-bin and what "
                             "apt suggests for it; to build: libopenmpi-dev, SKEIN_BUILD_MPI=ON), "
                             "or start one process"));
  }
}

std::unique_ptr<Ranks> JoinLaunchedProcesses(double timeout_s) {
  const int launched = LaunchedProcesses();
  if (launched == 1) return nullptr;
  std::unique_ptr<Ranks> ranks = LoadRankModule().Join(timeout_s);
  if (ranks->count() == launched) return ranks;
  throw Error("started as one of " + std::to_string(launched) + " processes, but MPI sees " +
              std::to_string(ranks->count()) +
              ": start with the mpirun of the MPI that Skein was built with, or srun --mpi=pmix");
}

}  // namespace skein
