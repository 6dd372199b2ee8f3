// SPDX-License-Identifier: Apache-2.0
#include "train/ranks/rank_module.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>
#include <utility>

#include "tests/error_message.h"

namespace skein {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

using Environment = std::map<std::string, std::string>;

/// Without a launcher's variables but those that a test sets; puts the environment back.
class RankModuleTest : public ::testing::Test {
 protected:
  RankModuleTest() {
    for (const char* const name : kVariables) {
      const char* const value = std::getenv(name);
      if (value != nullptr) before_[name] = value;
    }
    Set({});
  }
  ~RankModuleTest() override { Set(before_); }

  static void Set(const Environment& environment) {
    for (const char* const name : kVariables) unsetenv(name);
    for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
  }

 private:
  static constexpr const char* kVariables[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK",
                                               "SLURM_STEP_NUM_TASKS", "SLURM_PROCID"};
  Environment before_;
};

TEST_F(RankModuleTest, TheEnvironmentSaysHowManyProcessesALauncherHasStarted) {
  EXPECT_EQ(LaunchedProcesses(), 1);
  for (const auto& [environment, processes] :
       {std::pair{Environment{{"OMPI_COMM_WORLD_SIZE", "4"}}, 4},
        {Environment{{"OMPI_COMM_WORLD_SIZE", "1"}}, 1},
        {Environment{{"PMI_SIZE", "8"}}, 8},
        {Environment{{"PMIX_RANK", "1"}, {"SLURM_STEP_NUM_TASKS", "2"}}, 2},
        {Environment{{"PMIX_RANK", "0"}}, 1},
        {Environment{{"SLURM_STEP_NUM_TASKS", "2"}}, 1},
        {Environment{{"OMPI_COMM_WORLD_SIZE", "none"}}, 1}}) {
    Set(environment);
    EXPECT_EQ(LaunchedProcesses(), processes) << environment.begin()->first;
  }
}

TEST_F(RankModuleTest, AProcessThatWasStartedAloneJoinsNone) {
  EXPECT_EQ(JoinLaunchedProcesses(1), nullptr);
  Set({{"OMPI_COMM_WORLD_SIZE", "1"}});
  EXPECT_EQ(JoinLaunchedProcesses(1), nullptr);
}

TEST_F(RankModuleTest, ProcessesOfSrunThatCannotJoinAreWarnedOnce) {
  EXPECT_EQ(WarningOfLoneProcesses(), "");
  Set({{"SLURM_STEP_NUM_TASKS", "4"}, {"SLURM_PROCID", "0"}});
  EXPECT_THAT(WarningOfLoneProcesses(),
              AllOf(HasSubstr("4 processes"), HasSubstr("srun --mpi=pmix"), Not(HasSubstr("\n"))));
  for (const Environment& quiet :
       {Environment{{"SLURM_STEP_NUM_TASKS", "4"}, {"SLURM_PROCID", "3"}},
        {{"SLURM_STEP_NUM_TASKS", "4"}, {"PMIX_RANK", "0"}},
        {{"SLURM_STEP_NUM_TASKS", "4"}, {"PMI_SIZE", "4"}},
        {{"SLURM_STEP_NUM_TASKS", "1"}}}) {
    Set(quiet);
    EXPECT_EQ(WarningOfLoneProcesses(), "");
  }
}

TEST_F(RankModuleTest, ABuildWithoutMpiIsRefusedInOneLineThatSaysHowToGetIt) {
  Set({{"OMPI_COMM_WORLD_SIZE", "2"}});
  EXPECT_THAT(MessageOf([] { LoadRankModule("libskein_nowhere.so"); }),
              AllOf(HasSubstr("started as one of 2 processes"), HasSubstr("libskein_nowhere.so"),
                    HasSubstr("libopenmpi-dev"), HasSubstr("SKEIN_BUILD_MPI=ON"),
                    HasSubstr("or start one process"), Not(HasSubstr("\n"))));
  EXPECT_THAT(MessageOf([] { LoadRankModule("libm.so.6"); }),
              HasSubstr("libm.so.6 is no module of Skein"));
}

}  // namespace
}  // namespace skein
