// SPDX-License-Identifier: Apache-2.0
#include "envs/task_registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "envs/air/atmosphere.h"
#include "tests/envs/test_tile.h"

namespace skein {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

EnvConfig ConfigOf(const std::string& task) {
  EnvConfig config;
  config.task = task;
  return config;
}

TEST(TaskRegistryTest, EveryNameMakesATaskWhoseColumnsHoldItsTargets) {
  const std::vector<std::string> names = TaskNames();
  ASSERT_FALSE(names.empty());
  for (const std::string& name : names) {
    const std::unique_ptr<Task> task = MakeTask(ConfigOf(name));
    ASSERT_NE(task, nullptr) << name;
    EXPECT_GE(task->num_targets(), 1) << name;
    EXPECT_LE(task->num_targets(), task->num_columns()) << name;
    EXPECT_EQ(task->target_quantities().size(), static_cast<std::size_t>(task->num_targets()))
        << name;
  }
}

TEST(TaskRegistryTest, TasksTakeTheirSettingsFromTheConfiguration) {
  // Targets drawn from a range of no width are where the flight starts.
  EnvConfig config = ConfigOf("heading");
  config.heading.altitude_change_ft = config.heading.yaw_change_rad =
      config.heading.speed_change_fps = 0;
  simd::RandomStream random({1, 2, 3, 4, simd::RandomPurpose::kTarget});
  const std::unique_ptr<Task> task = MakeTask(config);
  TestTile columns(2, task->num_columns());
  task->Reset({12000, 800, 0.1, -1.5}, &random, columns.tile(), 1);
  EXPECT_FLOAT_EQ(columns.at(0, 1), 12000);
  EXPECT_FLOAT_EQ(columns.at(1, 1), -1.5);
  EXPECT_FLOAT_EQ(columns.at(2, 1), 800);
  for (int column = 0; column < task->num_columns(); ++column) EXPECT_EQ(columns.at(column, 0), 0);
}

TEST(TaskRegistryTest, ControlTakesItsSettingsFromTheConfiguration) {
  EnvConfig config = ConfigOf("control");
  config.control.pitch_change_rad = config.control.yaw_change_rad =
      config.control.speed_change_fps = 0;
  simd::RandomStream random({1, 2, 3, 4, simd::RandomPurpose::kTarget});
  const std::unique_ptr<Task> task = MakeTask(config);
  TestTile columns(2, task->num_columns());
  task->Reset({12000, 800, 0.1, -1.5}, &random, columns.tile(), 1);
  EXPECT_FLOAT_EQ(columns.at(0, 1), 0.1f);
  EXPECT_FLOAT_EQ(columns.at(1, 1), -1.5);
  EXPECT_FLOAT_EQ(columns.at(2, 1), 800);
  for (int column = 0; column < task->num_columns(); ++column) EXPECT_EQ(columns.at(column, 0), 0);
}

TEST(TaskRegistryTest, NamesAreDistinctAndHoldTheDefault) {
  const std::vector<std::string> names = TaskNames();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_THAT(names, Contains(EnvConfig{}.task));
}

TEST(TaskRegistryTest, AnUnknownNameIsAnErrorThatListsTheKnownOnes) {
  for (const std::string unknown : {"landing", "", "headin", "Heading", "heading "}) {
    try {
      MakeTask(ConfigOf(unknown));
      FAIL() << '"' << unknown << "\" was made";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr('"' + unknown + '"'));
      for (const std::string& name : TaskNames()) EXPECT_THAT(error.what(), HasSubstr(name));
    }
  }
}

TEST(TaskRegistryTest, TargetsKeepTheRegimeThatTheyAreHeldIn) {
  constexpr double kMach = 1.1, kAltitude = 31000;
  constexpr int kCount = 64;
  for (const std::string& name : TaskNames()) {
    EnvConfig config = ConfigOf(name);
    config.target_mach_min = kMach;
    config.target_altitude_min_ft = kAltitude;
    const std::unique_ptr<Task> task = MakeTask(config);
    TestTile targets(kCount, task->num_columns());
    int at_the_limit = 0;
    for (int i = 0; i < kCount; ++i) {
      simd::RandomStream random(
          {7, static_cast<std::uint32_t>(i), 0, 0, simd::RandomPurpose::kTarget});
      task->Reset({32000, 1100, 0, 0}, &random, targets.tile(), i);
      double altitude = 32000;
      for (int k = 0; k < task->num_targets(); ++k) {
        const std::string column = task->target_quantities()[static_cast<std::size_t>(k)].column;
        const double value = static_cast<double>(targets.at(k, i));
        if (column == "altitude_ft") {
          altitude = value;
          EXPECT_GE(value, kAltitude) << name;
          at_the_limit += value == kAltitude ? 1 : 0;
        } else if (column == "true_airspeed_fps") {
          const double sound = AirAt(config.atmosphere, altitude).sound_speed_ft_s;
          EXPECT_GE(value / sound, kMach * (1 - 1e-6)) << name;
          at_the_limit += value / sound < kMach * (1 + 1e-6) ? 1 : 0;
        }
      }
    }
    EXPECT_GT(at_the_limit, 0) << name;
  }
}

}  // namespace
}  // namespace skein
