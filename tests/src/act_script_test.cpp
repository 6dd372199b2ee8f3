// SPDX-License-Identifier: Apache-2.0
// scripts/act, the reference of how a policy file is to be read elsewhere, against the program's
// own networks.
#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/tolerance.h"
#include "train/policy/recurrent_policy.h"

namespace skein {
namespace {

constexpr int kPolicySteps = 5;

/// What `command` prints; it must succeed.
std::string OutputOf(const std::string& command) {
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  EXPECT_EQ(pclose(pipe), 0) << command;
  return output;
}

/// Observations of a flight of kPolicySteps policy steps.
std::vector<std::vector<float>> Observations(int size) {
  std::vector<std::vector<float>> observations(kPolicySteps);
  for (int t = 0; t < kPolicySteps; ++t) {
    for (int i = 0; i < size; ++i) {
      observations[static_cast<std::size_t>(t)].push_back(
          0.25f * static_cast<float>((i * 7 + t * 3) % 11 - 5));
    }
  }
  return observations;
}

void ExpectTheSameActions(const std::string& path) {
  const RecurrentPolicy policy = RecurrentPolicy::Load(path);
  const auto observations = Observations(policy.observation_size());
  std::ostringstream rows;
  for (const auto& observation : observations) {
    for (std::size_t i = 0; i < observation.size(); ++i) {
      rows << (i == 0 ? "" : ",") << observation[i];
    }
    rows << "\n";
  }
  const ScratchDirectory scratch;
  WriteFile(scratch / "observations.csv", rows.str());
  std::istringstream printed(OutputOf("python3 -I -S " SKEIN_SOURCE "/scripts/act '" + path +
                                      "' < '" + (scratch / "observations.csv") + "'"));
  std::vector<float> state(static_cast<std::size_t>(policy.state_size()));
  std::vector<float> action(static_cast<std::size_t>(policy.action_size()));
  for (const auto& observation : observations) {
    policy.Act(1, observation.data(), state.data(), action.data());
    for (const float expected : action) {
      float value = 0;
      char comma = 0;
      ASSERT_TRUE(printed >> value) << path;
      constexpr Tolerance kFloat32{1e-5, "float32 against the script's float64"};
      EXPECT_NEAR(value, expected, kFloat32) << path;
      printed >> std::noskipws >> comma >> std::skipws;
    }
  }
  EXPECT_FALSE(printed >> std::ws >> action[0]) << "as many policy steps as observations";
}

class ActScript : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("python3 -c '' 2>/dev/null") != 0) GTEST_SKIP() << "needs python3";
  }
};

TEST_F(ActScript, ActsAsTheShippedPoliciesDo) {
  for (const char* task : {"heading", "control", "tracking", "tracking-planner"}) {
    ExpectTheSameActions(std::string(SKEIN_SOURCE "/policies/") + task + ".skein");
  }
}

TEST_F(ActScript, EndsQuietlyWhereNobodyReadsOn) {
  const ScratchDirectory scratch;
  const std::string rows = scratch / "observations.csv", errors = scratch / "errors.txt";
  std::string row = "0.1";
  for (int i = 1; i < 22; ++i) row += ",0.1";
  WriteFile(rows, row + "\n" + row + "\n");
  // The reader is gone before the first row is written, which Python buffers until the end.
  OutputOf("(sleep 1; python3 -I -S " SKEIN_SOURCE "/scripts/act " SKEIN_SOURCE
           "/policies/heading.skein < '" +
           rows + "' 2> '" + errors + "') | true");
  EXPECT_EQ(ReadFile(errors), "");
}

TEST_F(ActScript, KnowsNetworksOfOtherSizes) {
  NetworkConfig config;
  config.hidden_layers = 1;
  config.hidden_size = 24;
  config.gru_size = 17;
  config.tanh_mean = false;
  config.actor_head_scale = 1;
  const ScratchDirectory scratch;
  RecurrentPolicy::Untrained(config, 9, 2, 3).Save(scratch / "policy.skein");
  ExpectTheSameActions(scratch / "policy.skein");
}

}  // namespace
}  // namespace skein
