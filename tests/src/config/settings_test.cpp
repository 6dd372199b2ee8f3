// SPDX-License-Identifier: Apache-2.0
#include "src/config/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "envs/task_registry.h"
#include "src/config/configuration.h"
#include "src/config/key_reference.h"
#include "src/files/output_file.h"
#include "tests/error_message.h"
#include "train/ppo/training_state.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

/// Of what is not a choice among names.
struct AddressOf {
  const void* operator()(const void* place) const { return place; }
  const void* operator()(const NamedChoice&) const { return nullptr; }
};

TEST(Settings, KeysAndPlacesAreUnique) {
  ProgramConfig config;
  std::set<std::string> keys;
  std::set<const void*> places;
  for (const Field& field : FieldsOf(config)) {
    EXPECT_TRUE(keys.insert(field.key).second) << field.key;
    EXPECT_TRUE(field.former_key.empty() || keys.insert(field.former_key).second) << field.key;
    const void* const place = std::visit(AddressOf{}, field.place);
    EXPECT_TRUE(place == nullptr || places.insert(place).second) << field.key;
  }
}

TEST(Settings, BuiltInDefaultsLieWithinTheirBounds) {
  ProgramConfig config;
  config.train.total_steps = 1;  // the only field without a usable default
  FieldList list;
  ListFields(config, list);
  EXPECT_NO_THROW(list.Check());
}

/// Another value than the field has, within its bounds.
SettingValue OtherValue(const Field& field) {
  if (const bool* const* flag = std::get_if<bool*>(&field.place)) return !**flag;
  if (const auto* choice = std::get_if<NamedChoice>(&field.place)) {
    return choice->names()[choice->names().front() == choice->name() ? 1 : 0];
  }
  if (const int* const* number = std::get_if<int*>(&field.place)) return **number + 1.0;
  if (!field.IsNumber()) return std::string("another");
  if (std::holds_alternative<std::uint64_t*>(field.place)) return 9007199254740991.0;
  const Bounds& bounds = field.bounds;
  if (std::isinf(bounds.min)) return -17.25;
  return std::isinf(bounds.max) ? bounds.min + 0.1875
                                : bounds.min + (bounds.max - bounds.min) * 0.71;
}

TEST(Settings, EveryKeyIsWrittenAndReadBack) {
  ProgramConfig config;
  for (const Field& field : FieldsOf(config)) {
    if (field.key == "env.task") continue;  // decides which of the others there are
    ProgramConfig changed;
    changed.train.env.task = field.tasks.empty() ? "heading" : field.tasks.front();
    changed.train.total_steps = 1;  // the only field without a usable default
    ProgramConfig read = changed;
    const std::vector<Field> fields = FieldsOf(changed);
    Assign(field.key, OtherValue(FindField(fields, field.key, "")), "test", &changed);
    ASSERT_EQ(Differences(changed, read).size(), 1u) << field.key;
    ApplyToml(DumpToml(changed), "dump", &read);
    EXPECT_THAT(Differences(changed, read), testing::IsEmpty()) << field.key;
  }
}

TEST(Settings, TheUnitOfEveryPhysicalQuantityIsInItsName) {
  ProgramConfig config;
  for (const Field& setting : FieldsOf(config)) {
    if (setting.key.rfind("env.reward.", 0) == 0) continue;  // weights, of quantities in their help
    if (setting.key.rfind("env.plant.", 0) == 0) continue;   // factors
    if (std::holds_alternative<bool*>(setting.place)) continue;
    for (const char* quantity : {"altitude", "airspeed", "alpha_m", "beta_m", "yaw", "speed_"}) {
      if (setting.key.find(quantity) == std::string::npos) continue;
      const std::string unit = setting.key.substr(setting.key.rfind('_'));
      if (unit == "_weight") continue;  // has no dimension
      EXPECT_TRUE(unit == "_ft" || unit == "_fps" || unit == "_deg" || unit == "_rad")
          << setting.key;
    }
  }
}

void Find(const std::string& key) {
  ProgramConfig config;
  FindField(FieldsOf(config), key, "--set");
}

TEST(Settings, FormerKeysNameTheNew) {
  EXPECT_EQ(MessageOf([] { Find("env.planner.yaw_change_rad"); }),
            "--set: env.planner.yaw_change_rad is called env.high_level.yaw_change_rad now");
}

TEST(Settings, BoundsCanBeTyped) {
  ProgramConfig config;
  for (const Field& field : FieldsOf(config)) {
    const std::string text = field.BoundsText();
    if (text.empty() || text.find("2^53") != std::string::npos) continue;
    const double max = std::stod(text.substr(text.find(", ") + 2));
    EXPECT_TRUE(std::isinf(max) || field.bounds.Contains(max)) << field.key << " in " << text;
  }
}

TEST(Settings, UnknownKeysSuggestTheNearest) {
  EXPECT_EQ(MessageOf([] { Find("ppo.learnig_rate"); }),
            "--set: unknown key ppo.learnig_rate; did you mean ppo.learning_rate?");
  EXPECT_EQ(MessageOf([] { Find("gamma"); }), "--set: unknown key gamma; did you mean ppo.gamma?");
  EXPECT_EQ(MessageOf([] { Find("zzzzzzzz"); }),
            "--set: unknown key zzzzzzzz; `skein train --help-keys` lists all keys");
  // Most keys were never called otherwise.
  EXPECT_THAT(MessageOf([] { Find(""); }), HasSubstr("--set: unknown key"));
}

TEST(Settings, NamesOfOtherLibrariesAreAnsweredWithTheKey) {
  EXPECT_EQ(MessageOf([] { Find("ppo.num_envs"); }),
            "--set: unknown key ppo.num_envs; did you mean ppo.num_aircraft?");
  EXPECT_EQ(
      MessageOf([] { Find("batch-size"); }),
      "--set: unknown key batch-size; did you mean ppo.minibatches (the number of minibatches, "
      "not their size)?");
}

TEST(Settings, TextsOfSeveralLinesAreRefusedInOne) {
  ProgramConfig config;
  EXPECT_EQ(MessageOf([&] {
              Assign("env.aircraft", SettingValue(std::string("a\nb")), "--set", &config);
            }),
            "--set: env.aircraft must be of one line, not \"a\\u000ab\"");
  EXPECT_THAT(MessageOf([] { Find("a\nb"); }), HasSubstr("unknown key a b"));
}

TEST(Settings, WrongTypesAndValuesOutOfRangeAreNamed) {
  EXPECT_EQ(MessageOf([] {
              ProgramConfig config;
              Assign("ppo.gamma", 1.5, "file:3", &config);
            }),
            "file:3: ppo.gamma = 1.5 is out of range; it must be in [0, 1]");
  EXPECT_EQ(MessageOf([] {
              ProgramConfig config;
              Assign("ppo.epochs", 2.5, "file:3", &config);
            }),
            "file:3: ppo.epochs must be an integer, not 2.5");
  EXPECT_EQ(MessageOf([] {
              ProgramConfig config;
              Assign("run.seed", std::int64_t{9007199254740993}, "--set", &config);
            }),
            "--set: run.seed = 9007199254740993 is out of range; it must be in [0, 2^53 - 1]");
  EXPECT_EQ(MessageOf([] {
              ProgramConfig config;
              Assign("env.flight_control", std::string("off"), "--set", &config);
            }),
            "--set: env.flight_control must be \"full\" or \"direct\", not \"off\"");
  EXPECT_EQ(MessageOf([] {
              ProgramConfig config;
              Assign("ppo.popart", std::int64_t{1}, "--set", &config);
            }),
            "--set: ppo.popart must be true or false, not 1");
}

TEST(Settings, WholeNumbersServeAsIntegersAndIntegersAsNumbers) {
  ProgramConfig config;
  Assign("run.total_steps", 1.35e9, "", &config);
  EXPECT_EQ(config.train.total_steps, 1350000000u);
  Assign("ppo.clip", std::int64_t{1}, "", &config);
  EXPECT_EQ(config.train.ppo.clip, 1.0);
}

TEST(Settings, TheReferenceOfKeysIsUpToDate) {
  EXPECT_TRUE(ReadFile(SKEIN_TEST_DATA "/../../docs/reference/configuration.md") ==
              DescribeKeysMarkdown())
      << "skein train --help-keys=markdown > docs/reference/configuration.md";
}

TEST(Settings, EvaluationsTakeTolerancesWhole) {
  std::size_t found = 0;
  for (const std::string& task : TaskNames()) {
    ProgramConfig config = ResolveConfig({task, "default", "", {}});
    config.train.env = EvaluationConfig(config.train.env);
    for (const Field& field : FieldsOf(config)) {
      if (!field.IsOf(task) || field.key.find(".training_tolerance_") == std::string::npos)
        continue;
      EXPECT_EQ(TomlText(field), "1.0") << field.key;
      ++found;
    }
  }
  EXPECT_EQ(found, TaskNames().size());
}

void TurnOnWhatIsOff(TrainConfig* config) {
  for (const Field& field : FieldsOf(*config)) {
    if (!field.is_off) continue;
    if (const auto* flag = std::get_if<bool*>(&field.place))
      field.SetText(**flag ? "false" : "true");
    if (field.IsNumber()) field.SetText(field.bounds.Contains(2) ? "2" : "1");
    if (std::holds_alternative<std::string*>(field.place)) field.SetText("some");
    if (const auto* choice = std::get_if<NamedChoice>(&field.place)) {
      field.SetText(choice->names().back());
    }
  }
}

TEST(Settings, ACheckpointHoldsEveryKeyThatTrainingDependsOn) {
  std::set<std::string> keys, described;
  ProgramConfig any;
  for (const Field& field : FieldsOf(any)) {
    // How a run is kept may change while it goes on.
    if (field.key.rfind("checkpoint.", 0) == 0 || field.key == "evaluation.final_episodes") {
      continue;
    }
    keys.insert(field.key);
  }
  for (const std::string& task : TaskNames()) {
    TrainConfig config;
    config.env.task = task;
    TurnOnWhatIsOff(&config);
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

TEST(Settings, WhatIsOffSetsNoCheckpointApart) {
  const std::map<std::string, std::string> described = DescribeConfig(TrainConfig{});
  for (const char* key :
       {"env.wind.speed_max_fps", "env.wind.step_at_reset", "env.drag_rise",
        "env.thrust_growth_above_mach_1", "env.observation_noise_max", "env.training_noise_max",
        "env.initial.training_altitude_min_ft", "env.initial.training_true_airspeed_min_fps",
        "env.initial.training_bank_max_deg", "env.initial.training_load_factor_max",
        "env.wind.training_speed_max_fps", "env.termination.training_min_mach",
        "env.termination.training_min_altitude_ft"}) {
    EXPECT_EQ(described.count(key), 0u) << key;
  }
}

}  // namespace
}  // namespace skein
