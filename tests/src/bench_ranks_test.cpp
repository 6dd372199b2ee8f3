// SPDX-License-Identifier: Apache-2.0
// Measures trainings of several processes as a user does, with mpirun.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/src/ranks_fixture.h"
#include "tests/src/run_program.h"
#include "tests/src/tiny_training.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> kSmall = {"--iterations", "2",
                                         "--set",        "ppo.num_aircraft=64",
                                         "--set",        "ppo.rollout_steps=16",
                                         "--set",        "ppo.chunk_length=8",
                                         "--set",        "ppo.minibatches=2"};

class BenchRanks : public RanksFixture {
 protected:
  std::vector<std::string> Bench(const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"bench", name, "--json", json_};
    arguments.insert(arguments.end(), kSmall.begin(), kSmall.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  nlohmann::json Results() const { return nlohmann::json::parse(ReadFile(json_)); }

  const std::string json_ = scratch_ / "result.json";
};

TEST_F(BenchRanks, IterationsOfSeveralRanksSayHowLongTheyExchange) {
  const ProgramResult result = RunWords(Mpirun(2, Bench("iteration", {"--threads", "1"})));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("2 ranks x 1 thread, 32 shards; "));
  EXPECT_EQ(result.output.find("iteration: "), result.output.rfind("iteration: ")) << "said once";
  const auto json = Results();
  EXPECT_EQ(json["ranks"], 2);
  EXPECT_EQ(json["shards"], 32);
  EXPECT_GT(json["exchange_share"], 0);
  EXPECT_LT(json["exchange_share"], 1);
  EXPECT_GT(json["exchange_s"], 0);
  EXPECT_GT(json["sent_mb"], 0);
  EXPECT_EQ(json["figures"]["iteration_s"]["samples"].size(), 2u);
}

TEST_F(BenchRanks, ScalingMeasuresEveryWayToUseTheProcessors) {
  const std::string launcher = "mpirun --allow-run-as-root --oversubscribe -x " +
                               AsanOptionsOfRanks(std::getenv("ASAN_OPTIONS"));
  const ProgramResult result =
      RunSkein(Bench("scaling", {"--threads", "2", "--launcher", launcher}));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  const auto json = Results();
  ASSERT_EQ(json["points"].size(), 3u);
  const std::vector<std::pair<int, int>> grids = {{1, 1}, {1, 2}, {2, 1}};
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const auto& point = json["points"][i];
    EXPECT_EQ(point["ranks"], grids[i].first);
    EXPECT_EQ(point["threads"], grids[i].second);
    EXPECT_GT(point["control_steps_per_s"], 0);
    EXPECT_EQ(point["exchange_share"] > 0, grids[i].first > 1);
  }
  EXPECT_EQ(json["points"][0]["efficiency"], 1);
  const ProgramResult compared = RunSkein({"bench", "compare", json_, json_});
  EXPECT_EQ(compared.exit_code, 0) << compared.error;
  EXPECT_THAT(compared.output, HasSubstr("2x1_iteration_s"));
  EXPECT_THAT(compared.output, HasSubstr("within noise"));
}

TEST_F(BenchRanks, WhatTheLauncherSaysIsPassedOn) {
  const ProgramResult failed =
      RunSkein(Bench("scaling", {"--threads", "2", "--launcher", "mpirun --no-such-option"}));
  EXPECT_EQ(failed.exit_code, 1);
  ExpectOneLine(failed.error, "2 ranks x 1 thread: ");
  const ProgramResult none =
      RunSkein(Bench("scaling", {"--threads", "2", "--launcher", "no-such-launcher -x"}));
  EXPECT_EQ(none.exit_code, 0) << none.error;
  EXPECT_THAT(none.output, HasSubstr("no-such-launcher is not there"));
  EXPECT_EQ(Results()["points"].size(), 2u);
}

}  // namespace
}  // namespace skein
