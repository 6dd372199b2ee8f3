// SPDX-License-Identifier: Apache-2.0
// Flies the policies of policies/ as a user does who has just cloned the repository.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"

namespace skein {
namespace {

constexpr const char* kEpisodes = "256";
constexpr const char* kSeed = "5";

/// How a policy must hold its targets, as docs/reference/metrics.md measures it.
struct HoldLimits {
  double least_within;
  double most_rms_p_deg_s, most_load_factor_deviation_g, most_net_rolls_per_min;
};

/// How smoothly it must move each stick, in the whole flight.
struct SmoothnessLimits {
  double most_variation_per_s, most_reversals_per_s, most_saturated;
};

/// What a policy must reach, with a margin to what it does (policies/README.md): other instruction
/// sets round otherwise.
struct ShippedPolicy {
  const char* name;  ///< of its file
  const char* task;
  std::vector<std::string> settings;  ///< of skein compare
  double least_success;
  std::optional<HoldLimits> hold;
  std::optional<SmoothnessLimits> smoothness;
  /// Of a mission, whose end an aircraft may reach that hits nothing.
  std::optional<double> least_targets_per_minute = std::nullopt;
};

void PrintTo(const ShippedPolicy& policy, std::ostream* out) { *out << policy.name; }

/// To be flown to its end, from target to target.
const std::vector<std::string> kMission = {"--mission",    "3",           "--condition",
                                           "windy=middle", "--condition", "noisy=middle"};

const ShippedPolicy kPolicies[] = {
    {"heading",
     "heading",
     {"--set", "env.heading.dwell_s=3", "--hold", "30"},
     0.99,
     HoldLimits{0.99, 4, 0.15, 0.3},
     SmoothnessLimits{0.2, 1.5, 0.01}},
    {"heading", "heading", kMission, 0.98, std::nullopt, SmoothnessLimits{0.8, 4, 0.01}, 2.0},
    {"heading-robust",
     "heading",
     {"--set", "env.heading.dwell_s=3", "--hold", "30", "--condition", "plant=middle",
      "--condition", "noisy=middle"},
     0.94,
     HoldLimits{0.75, 6, 0.5, 0.3},
     SmoothnessLimits{0.9, 5, 0.01}},
    {"control-robust",
     "control",
     {"--set", "env.control.dwell_s=3", "--hold", "30", "--condition", "plant=middle",
      "--condition", "noisy=middle"},
     0.93,
     HoldLimits{0.7, 7.5, 0.4, 0.3},
     SmoothnessLimits{0.6, 4.5, 0.01}},
    {"control-robust", "control", kMission, 0.9, std::nullopt, SmoothnessLimits{0.8, 5, 0.01}, 1.8},
    // Steep dives and climbs cannot be held: thrust.
    {"control",
     "control",
     {"--set", "env.control.dwell_s=3", "--hold", "30"},
     0.98,
     HoldLimits{0.87, 6, 0.35, 0.3},
     SmoothnessLimits{0.3, 3, 0.01}},
    {"tracking", "tracking", {}, 0.98, std::nullopt, SmoothnessLimits{0.4, 2, 0.01}},
    {"tracking", "tracking", kMission, 0.98, std::nullopt, SmoothnessLimits{0.7, 4, 0.01}, 1.9},
    {"tracking-robust",
     "tracking",
     {"--condition", "plant=middle", "--condition", "noisy=middle"},
     0.9,
     std::nullopt,
     SmoothnessLimits{0.8, 4, 0.01}},
    {"tracking-robust", "tracking", kMission, 0.98, std::nullopt, SmoothnessLimits{0.7, 4, 0.01},
     1.9},
    {"tracking-planner", "tracking", {}, 0.92, std::nullopt, std::nullopt},
};

class ShippedPolicies : public ::testing::TestWithParam<ShippedPolicy> {
 protected:
  std::string task() const { return GetParam().task; }
  std::string policy() const {
    return std::string(SKEIN_SOURCE) + "/policies/" + GetParam().name + ".skein";
  }

  /// What `skein compare` says of the agents.
  nlohmann::json Compare(const std::string& agents) const {
    std::vector<std::string> command = {"compare",
                                        "--task",
                                        task(),
                                        "--agents",
                                        agents,
                                        "--seed",
                                        kSeed,
                                        "--episodes",
                                        kEpisodes,
                                        "--json",
                                        scratch_ / "table.json"};
    const std::vector<std::string>& settings = GetParam().settings;
    command.insert(command.end(), settings.begin(), settings.end());
    const ProgramResult result = CallSkein(command);
    EXPECT_EQ(result.exit_code, 0) << result.error;
    return nlohmann::json::parse(ReadFile(scratch_ / "table.json"))["agents"];
  }

 private:
  const ScratchDirectory scratch_;
};

TEST_P(ShippedPolicies, ReachAndHoldTheirTargetsSmoothly) {
  const nlohmann::json agents = Compare("policy:" + policy() + ",random");
  const nlohmann::json& estimates = agents[0]["estimates"];
  const auto value = [&estimates](const std::string& key) {
    return estimates.at(key)["value"].get<double>();
  };
  EXPECT_GE(value("success_rate"), GetParam().least_success);
  EXPECT_LE(agents[1]["success_rate"].get<double>(), 0.05) << "random actions";
  if (const auto& hold = GetParam().hold) {
    EXPECT_GE(value("hold_within"), hold->least_within);
    EXPECT_LE(value("hold_rms_p_deg_s"), hold->most_rms_p_deg_s);
    EXPECT_LE(value("hold_load_factor_deviation_g"), hold->most_load_factor_deviation_g);
    EXPECT_LE(value("hold_net_rolls_per_min"), hold->most_net_rolls_per_min);
  }
  if (const auto& targets = GetParam().least_targets_per_minute) {
    EXPECT_GE(value("targets_per_minute"), *targets);
  }
  if (const auto& smoothness = GetParam().smoothness) {
    for (const std::string stick : {"throttle", "pitch", "roll", "yaw"}) {
      SCOPED_TRACE(stick);
      EXPECT_LE(value(stick + "_variation_per_s"), smoothness->most_variation_per_s);
      EXPECT_LE(value(stick + "_reversals_per_s"), smoothness->most_reversals_per_s);
      EXPECT_LE(value(stick + "_saturated"), smoothness->most_saturated);
    }
  }
}

TEST_P(ShippedPolicies, SayWhatTheyWereMadeFor) {
  const ProgramResult flown = CallSkein({"eval", "--policy", policy(), "--episodes", "4"});
  EXPECT_EQ(flown.exit_code, 0) << flown.error;
  EXPECT_NE(flown.output.find(" on " + task() + ", 4 episodes"), std::string::npos) << flown.output;
  const ProgramResult other =
      CallSkein({"eval", "--policy", policy(), "--set", "env.flight_control=direct"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.error.find("env.flight_control = full"), std::string::npos) << other.error;
}

INSTANTIATE_TEST_SUITE_P(Tasks, ShippedPolicies, ::testing::ValuesIn(kPolicies),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           const bool is_mission = test.param.least_targets_per_minute.has_value();
                           return name + (is_mission ? "_mission" : "");
                         });

}  // namespace
}  // namespace skein
