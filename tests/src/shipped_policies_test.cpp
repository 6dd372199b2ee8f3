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

using Settings = std::vector<std::string>;  // of skein compare

/// How a policy must hold its targets, as docs/reference/metrics.md measures it.
struct HoldLimits {
  double least_within;
  double most_rms_p_deg_s, most_load_factor_deviation_g, most_net_rolls_per_min;
};

/// Of the flights that hold their target: one of kEpisodes.
constexpr double kMostLost = 0.005;

/// How smoothly it must move each stick, in the whole flight.
struct SmoothnessLimits {
  double most_variation_per_s, most_reversals_per_s, most_power_above_1hz;
};

constexpr double kMostSaturated = 0.01;  // of the time

/// What a policy must reach. Limits of means lie a tenth beyond what these episodes give, those of
/// rates of success within the 95 % interval of as many: other instruction sets round otherwise.
struct ShippedPolicy {
  const char* name;  ///< of its file
  const char* task;
  const char* flight;  ///< what it is called
  Settings settings;   ///< how it is flown
  double least_success;
  std::optional<HoldLimits> hold;
  std::optional<SmoothnessLimits> smoothness;
  /// Of a mission, whose end an aircraft may reach that hits nothing.
  std::optional<double> least_targets_per_minute = std::nullopt;
};

std::string NameOf(const ShippedPolicy& policy) {
  std::string name = std::string(policy.name) + "_" + policy.flight;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

void PrintTo(const ShippedPolicy& policy, std::ostream* out) { *out << NameOf(policy); }

const Settings kCalm = {};
/// To be flown to its end, from target to target.
const Settings kMission = {"--mission",    "3",           "--condition",
                           "windy=middle", "--condition", "noisy=middle"};
const Settings kPlants = {"--condition", "plant=middle", "--condition", "noisy=middle"};

/// A target that counts when it was held for 3 s, and is held for 30 s more.
Settings Held(const std::string& task, const Settings& others = {}) {
  Settings settings = {"--set", "env." + task + ".dwell_s=3", "--hold", "30"};
  settings.insert(settings.end(), others.begin(), others.end());
  return settings;
}

const ShippedPolicy kPolicies[] = {
    {"heading", "heading", "calm", Held("heading"), 0.99, HoldLimits{0.99, 4.1, 0.145, 0.1},
     SmoothnessLimits{0.16, 1.35, 0.11}},
    {"heading", "heading", "mission", kMission, 0.99, std::nullopt,
     SmoothnessLimits{0.71, 3.3, 0.07}, 2.2},
    {"heading-robust", "heading", "calm", Held("heading"), 0.99,
     HoldLimits{0.99, 2.5, 0.135, 0.095}, SmoothnessLimits{0.28, 2.7, 0.155}},
    {"heading-robust", "heading", "plants", Held("heading", kPlants), 0.95,
     HoldLimits{0.7, 6.15, 0.45, 0.08}, SmoothnessLimits{0.78, 4.75, 0.25}},
    {"heading-robust", "heading", "mission", kMission, 0.99, std::nullopt,
     SmoothnessLimits{0.66, 4.5, 0.16}, 1.75},
    // Steep dives and climbs cannot be held: thrust.
    {"control", "control", "calm", Held("control"), 0.98, HoldLimits{0.88, 4.35, 0.282, 0.082},
     SmoothnessLimits{0.215, 1.7, 0.107}},
    {"control", "control", "mission", kMission, 0.985, std::nullopt,
     SmoothnessLimits{0.95, 3.6, 0.09}, 2.2},
    {"control-robust", "control", "calm", Held("control"), 0.965, HoldLimits{0.87, 2.3, 0.25, 0.04},
     SmoothnessLimits{0.185, 1.8, 0.165}},
    {"control-robust", "control", "plants", Held("control", kPlants), 0.945,
     HoldLimits{0.8, 7, 0.33, 0.05}, SmoothnessLimits{0.5, 4.1, 0.235}},
    {"control-robust", "control", "mission", kMission, 0.98, std::nullopt,
     SmoothnessLimits{0.41, 3.9, 0.125}, 2.0},
    {"tracking", "tracking", "calm", kCalm, 0.99, std::nullopt,
     SmoothnessLimits{0.215, 0.665, 0.069}},
    {"tracking", "tracking", "mission", kMission, 0.98, std::nullopt,
     SmoothnessLimits{0.455, 2.88, 0.056}, 2.5},
    {"tracking-robust", "tracking", "calm", kCalm, 0.98, std::nullopt,
     SmoothnessLimits{0.53, 1.57, 0.07}},
    {"tracking-robust", "tracking", "plants", kPlants, 0.93, std::nullopt,
     SmoothnessLimits{0.99, 3.21, 0.108}},
    {"tracking-robust", "tracking", "mission", kMission, 0.99, std::nullopt,
     SmoothnessLimits{0.65, 3.1, 0.068}, 2.1},
    {"tracking-planner", "tracking", "calm", kCalm, 0.975, std::nullopt,
     SmoothnessLimits{0.56, 1.5, 0.095}},
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
    const Settings& settings = GetParam().settings;
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
    EXPECT_LE(value("hold_lost"), kMostLost);
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
      EXPECT_LE(value(stick + "_power_above_1hz"), smoothness->most_power_above_1hz);
      EXPECT_LE(value(stick + "_saturated"), kMostSaturated);
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
                         [](const auto& test) { return NameOf(test.param); });

}  // namespace
}  // namespace skein
