// SPDX-License-Identifier: Apache-2.0
#include "src/config/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <regex>
#include <set>

#include "envs/tasks/task.h"
#include "src/config/configuration.h"
#include "src/files/output_file.h"
#include "tests/error_message.h"
#include "train/ppo/training_state.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

TEST(Settings, KeysAreUnique) {
  std::set<std::string> keys;
  for (const Setting& setting : Settings()) EXPECT_TRUE(keys.insert(setting.key).second);
}

TEST(Settings, FieldsAreDistinct) {
  ProgramConfig config;
  std::set<const void*> places;
  for (const Setting& setting : Settings()) {
    const void* place =
        std::visit([](auto* field) -> const void* { return field; }, setting.field(config));
    EXPECT_TRUE(places.insert(place).second) << setting.key;
  }
}

TEST(Settings, BuiltInDefaultsLieWithinTheirBounds) {
  ProgramConfig config;
  config.train.total_steps = 1;  // the only field without a usable default
  for (const Setting& setting : Settings()) {
    const SettingField field = setting.field(config);
    if (const auto* const* number = std::get_if<double*>(&field)) {
      EXPECT_NO_THROW(Assign(setting, **number, "default", &config)) << setting.key;
    } else if (const auto* const* integer = std::get_if<int*>(&field)) {
      EXPECT_NO_THROW(Assign(setting, std::int64_t{**integer}, "default", &config)) << setting.key;
    }
  }
}

TEST(Settings, TheUnitOfEveryPhysicalQuantityIsInItsName) {
  for (const Setting& setting : Settings()) {
    for (const char* quantity : {"altitude", "airspeed", "alpha_m", "beta_m", "yaw", "speed_"}) {
      if (setting.key.find(quantity) == std::string::npos) continue;
      const std::string unit = setting.key.substr(setting.key.rfind('_'));
      if (unit == "_weight") continue;  // has no dimension
      EXPECT_TRUE(unit == "_ft" || unit == "_fps" || unit == "_deg" || unit == "_rad")
          << setting.key;
    }
  }
}

TEST(Settings, UnknownKeysSuggestTheNearest) {
  EXPECT_EQ(MessageOf([] { FindSetting("ppo.learnig_rate", "--set"); }),
            "--set: unknown key ppo.learnig_rate; did you mean ppo.learning_rate?");
  EXPECT_EQ(MessageOf([] { FindSetting("gamma", "--set"); }),
            "--set: unknown key gamma; did you mean ppo.gamma?");
  EXPECT_EQ(MessageOf([] { FindSetting("zzzzzzzz", "--set"); }),
            "--set: unknown key zzzzzzzz; `skein train --help-keys` lists all keys");
}

TEST(Settings, WrongTypesAndValuesOutOfRangeAreNamed) {
  EXPECT_EQ(MessageOf([] {
              ProgramConfig config;
              Assign(FindSetting("ppo.gamma", ""), 1.5, "file:3", &config);
            }),
            "file:3: ppo.gamma = 1.5 is out of range; it must be in [0, 1]");
  EXPECT_EQ(MessageOf([] {
              ProgramConfig config;
              Assign(FindSetting("ppo.epochs", ""), 2.5, "file:3", &config);
            }),
            "file:3: ppo.epochs must be an integer, not 2.5");
  EXPECT_EQ(MessageOf([] {
              ProgramConfig config;
              Assign(FindSetting("env.flight_control", ""), std::string("off"), "--set", &config);
            }),
            "--set: env.flight_control must be \"full\" or \"direct\", not \"off\"");
  EXPECT_EQ(MessageOf([] {
              ProgramConfig config;
              Assign(FindSetting("ppo.popart", ""), std::int64_t{1}, "--set", &config);
            }),
            "--set: ppo.popart must be true or false, not 1");
}

TEST(Settings, WholeNumbersServeAsIntegersAndIntegersAsNumbers) {
  ProgramConfig config;
  Assign(FindSetting("run.total_steps", ""), 1.35e9, "", &config);
  EXPECT_EQ(config.train.total_steps, 1350000000u);
  Assign(FindSetting("ppo.clip", ""), std::int64_t{1}, "", &config);
  EXPECT_EQ(config.train.ppo.clip, 1.0);
}

/// The task whose presets show the key: its own, or Heading, which comes first.
std::string OwnerOf(const Setting& setting) {
  if (setting.key.rfind("env.high_level.", 0) == 0) return "tracking";
  for (const std::string& task : TaskNames()) {
    if (setting.key.rfind("env." + task + ".", 0) == 0) return task;
  }
  return "heading";
}

std::size_t CountLines(const std::string& text, const std::string& beginning) {
  const std::regex pattern("\n" + beginning);
  return static_cast<std::size_t>(
      std::distance(std::sregex_iterator(text.begin(), text.end(), pattern), {}));
}

TEST(Settings, DocumentationSaysWhatEveryKeyIs) {
  const std::string text = ReadFile(SKEIN_TEST_DATA "/../../docs/reference/configuration.md");
  for (const Setting& setting : Settings()) {
    // A task's own keys as its presets set them, all others as Heading's do.
    const std::string task = OwnerOf(setting);
    const ProgramConfig usual = ResolveConfig({task, "default", "", {}});
    const ProgramConfig paper = ResolveConfig({task, "paper", "", {}});
    const std::string bounds = setting.BoundsText();
    const std::string type = setting.TypeName() + (bounds.empty() ? "" : " in " + bounds);
    const std::string here = FormatValue(setting, usual), there = FormatValue(setting, paper);
    EXPECT_THAT(text,
                HasSubstr("\n| `" + setting.key + "` | " + type + " | " + here + " | " +
                          (here == there ? "" : there) + " | " + setting.description + " |\n"));
  }
  EXPECT_EQ(CountLines(text, "\\| `[a-z_0-9]+\\.[a-z_0-9.]+` \\| (a n|an i|true or|\")"),
            Settings().size());
}

TEST(Settings, DocumentationSaysWhereThePresetsOfOtherTasksDiffer) {
  const std::string text = ReadFile(SKEIN_TEST_DATA "/../../docs/reference/configuration.md");
  std::size_t rows = 0;
  for (const std::string& task : TaskNames()) {
    for (const std::string preset : {"default", "paper"}) {
      const ProgramConfig heading = ResolveConfig({"heading", preset, "", {}});
      const ProgramConfig other = ResolveConfig({task, preset, "", {}});
      for (const Setting& setting : Settings()) {
        const std::string value = FormatValue(setting, other);
        if (setting.key == "env.task" || OwnerOf(setting) == task) continue;
        if (setting.key.rfind("env.heading.", 0) == 0) continue;  // means nothing to `task`
        if (value == FormatValue(setting, heading)) continue;
        EXPECT_THAT(text, HasSubstr("\n| `" + task + "` | `" + setting.key + "` | `" + preset +
                                    "` | " + value + " |\n"));
        ++rows;
      }
    }
  }
  EXPECT_EQ(CountLines(text, "\\| `[a-z]+` \\| `[a-z_.]+` \\| `(default|paper)` \\| "), rows);
}

TEST(Settings, EvaluationsTakeTolerancesWhole) {
  int found = 0;
  for (const Setting& setting : Settings()) {
    if (setting.key.find(".training_tolerance_") == std::string::npos) continue;
    ProgramConfig config = ResolveConfig({OwnerOf(setting), "default", "", {}});
    config.train.env = EvaluationConfig(config.train.env);
    EXPECT_EQ(FormatValue(setting, config), "1.0") << setting.key;
    ++found;
  }
  EXPECT_EQ(found, static_cast<int>(TaskNames().size()));
}

TEST(Settings, TheEnvironmentAllowsWhatTheKeysAllow) {
  // The ends of every range, where they are whole values of their own and go with all others.
  for (const Setting& setting : Settings()) {
    if (setting.key.rfind("env.", 0) != 0 || setting.key.rfind("env.initial.", 0) == 0) continue;
    const Bounds& bounds = setting.bounds;
    if (!(bounds.max < 1e7) || !(bounds.max > bounds.min)) continue;
    if (setting.key.find("_min") != std::string::npos) continue;  // no more than its _max
    ProgramConfig config = ResolveConfig({OwnerOf(setting), "default", "", {}});
    config.train.env.termination.alpha_deg.min = 0;  // an arc of 180 deg at most
    Assign(setting, bounds.max, "test", &config);
    EXPECT_NO_THROW(Validate(config.train.env)) << setting.key;
    EXPECT_THROW(Assign(setting, std::nextafter(bounds.max, HUGE_VAL), "test", &config), Error);
  }
}

TEST(Settings, ACheckpointHoldsEveryKeyThatTrainingDependsOn) {
  std::set<std::string> keys;
  for (const Setting& setting : Settings()) {
    // How a run is kept may change while it goes on.
    if (setting.key.rfind("checkpoint.", 0) == 0 || setting.key == "evaluation.final_episodes") {
      continue;
    }
    keys.insert(setting.key);
  }
  std::set<std::string> described;
  for (const std::string& task : TaskNames()) {
    TrainConfig config;
    config.env.task = task;
    config.env.wind.speed_fps.max = 60;
    config.env.observation_noise_max = 0.05;
    config.env.thrust_grows = config.env.drag_rises = true;
    for (const auto& [key, value] : DescribeConfig(config)) described.insert(key);
  }
  EXPECT_EQ(described, keys);
}

TEST(Settings, ACheckpointHoldsNoKeysOfOtherTasks) {
  for (const std::string& task : TaskNames()) {
    TrainConfig config;
    config.env.task = task;
    for (const auto& [key, value] : DescribeConfig(config)) {
      for (const std::string& other : TaskNames()) {
        if (other == task) continue;
        EXPECT_NE(key.rfind("env." + other + ".", 0), 0u) << task << ": " << key;
      }
    }
  }
}

}  // namespace
}  // namespace skein
