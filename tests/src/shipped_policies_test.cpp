// SPDX-License-Identifier: Apache-2.0
// Flies the policies of policies/ as a user does who has just cloned the repository.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"

namespace skein {
namespace {

constexpr int kEpisodes = 300;

struct ShippedPolicy {
  const char* task;
  double least_success;  ///< below what policies/README.md says, by what 300 episodes may be off
};

class ShippedPolicies : public ::testing::TestWithParam<ShippedPolicy> {};

TEST_P(ShippedPolicies, ReachTheirTargets) {
  const ScratchDirectory scratch;
  const std::string task = GetParam().task, json = scratch / "table.json";
  const std::string policy = std::string(SKEIN_SOURCE) + "/policies/" + task + ".skein";
  const ProgramResult result =
      CallSkein({"compare", "--task", task, "--agents", "policy:" + policy + ",random",
                 "--episodes", std::to_string(kEpisodes), "--seed", "5", "--json", json});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  const auto agents = nlohmann::json::parse(ReadFile(json))["agents"];
  EXPECT_GE(agents[0]["success_rate"].get<double>(), GetParam().least_success);
  EXPECT_LE(agents[1]["success_rate"].get<double>(), 0.05) << "random actions";
}

TEST_P(ShippedPolicies, SayWhatTheyWereMadeFor) {
  const std::string task = GetParam().task;
  const std::string policy = std::string(SKEIN_SOURCE) + "/policies/" + task + ".skein";
  const ProgramResult flown = CallSkein({"eval", "--policy", policy, "--episodes", "4"});
  EXPECT_EQ(flown.exit_code, 0) << flown.error;
  EXPECT_NE(flown.output.find(" on " + task + ", 4 episodes"), std::string::npos) << flown.output;
  const ProgramResult other =
      CallSkein({"eval", "--policy", policy, "--set", "env.flight_control=direct"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.error.find("env.flight_control = full"), std::string::npos) << other.error;
}

INSTANTIATE_TEST_SUITE_P(Tasks, ShippedPolicies,
                         ::testing::Values(ShippedPolicy{"heading", 0.97},
                                           ShippedPolicy{"control", 0.97},
                                           ShippedPolicy{"tracking", 0.92}),
                         [](const auto& test) { return std::string(test.param.task); });

}  // namespace
}  // namespace skein
