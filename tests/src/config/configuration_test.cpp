// SPDX-License-Identifier: Apache-2.0
#include "src/config/configuration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "base/error.h"
#include "src/config/presets.h"
#include "src/config/settings.h"
#include "src/files/output_file.h"
#include "tests/error_message.h"
#include "tests/scratch_directory.h"

namespace skein {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string ErrorOf(const std::string& toml) {
  ProgramConfig config;
  try {
    ApplyToml(toml, "run.toml", &config);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Configuration, TomlErrorsNameFileLineAndReason) {
  EXPECT_THAT(ErrorOf("[ppo]\ngamma = = 3\n"), HasSubstr("run.toml:2: not valid TOML"));
  EXPECT_EQ(ErrorOf("[ppo]\n\ngama = 0.9\n"),
            "run.toml:3: unknown key ppo.gama; did you mean ppo.gamma?");
  EXPECT_THAT(ErrorOf("ppo = 3\n"), HasSubstr("run.toml:1: unknown key ppo"));
  EXPECT_EQ(ErrorOf("[ppo]\ngamma = [0.9]\n"),
            "run.toml:2: ppo.gamma must be a number, not a TOML array");
  EXPECT_EQ(ErrorOf("[ppo.gamma]\nx = 1\n"),
            "run.toml:1: ppo.gamma must be a number, not a TOML table");
  EXPECT_EQ(ErrorOf("[ppo]\ngamma = \"high\"\n"),
            "run.toml:2: ppo.gamma must be a number, not \"high\"");
  EXPECT_EQ(ErrorOf("[ppo]\ngamma = inf\n"),
            "run.toml:2: ppo.gamma = inf is out of range; it must be in [0, 1]");
  EXPECT_EQ(ErrorOf("\"ppo.gamma\" = 0.9\n[ppo]\ngamma = 0.8\n"),
            "run.toml:1: ppo.gamma is given in line 3, too");
}

TEST(Configuration, AnEmptyFileChangesNothingAndAMissingOneIsNamed) {
  const ScratchDirectory scratch;
  const std::string path = scratch / "empty.toml";
  WriteFile(path, "");
  ProgramConfig config;
  ApplyTomlFile(path, &config);
  EXPECT_THAT(Differences(config, {}), IsEmpty());
  std::filesystem::remove(path);
  try {
    ApplyTomlFile(path, &config);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(path + ": cannot be opened"));
  }
}

TEST(Configuration, DumpReadsBackExactly) {
  for (const Preset& preset : Presets()) {
    ProgramConfig config = ResolveConfig({preset.task, preset.name, "", {}});
    config.train.ppo.learning_rate = 0.1 + 0.2;  // needs all seventeen digits
    config.train.seed = 9007199254740991u;
    ProgramConfig read;
    read.train.env.task = preset.task;
    ApplyToml(DumpToml(config), "dump", &read);
    EXPECT_THAT(Differences(config, read), IsEmpty());
    EXPECT_EQ(read.train.ppo.learning_rate, config.train.ppo.learning_rate);
  }
}

TEST(Configuration, DumpHoldsTheKeysOfItsTask) {
  ProgramConfig config;
  const std::string text = DumpToml(config);
  EXPECT_THAT(text, HasSubstr("\n[env.heading]\naltitude_change_ft = 3000.0"));
  EXPECT_THAT(text, Not(HasSubstr("[env.control]")));
  EXPECT_THAT(text, Not(HasSubstr("[env.high_level]")));
}

TEST(Configuration, KeysOfAnotherTaskAreRefused) {
  const auto refused = [](const std::string& assignment) {
    return MessageOf([&] { ResolveConfig({"heading", "default", "", {assignment}}); });
  };
  EXPECT_EQ(
      refused("env.control.yaw_change_rad=1"),
      "--set: env.control.yaw_change_rad is of task control and means nothing to task heading");
  EXPECT_THAT(refused("env.high_level.yaw_change_rad=1"), HasSubstr("is of task tracking"));
  EXPECT_EQ(ErrorOf("[env]\n[env.tracking]\nazimuth_deg = 3\n"),
            "run.toml:3: env.tracking.azimuth_deg is of task tracking and means nothing to task "
            "heading");
}

TEST(Configuration, ARecordOfAnOlderVersionIsUnderstood) {
  const ScratchDirectory scratch;
  const std::string path = scratch / "config.toml";
  WriteFile(path,
            "[env]\ntask = \"tracking\"\n[env.control]\nyaw_change_rad = 1.5\n"
            "[env.planner]\nyaw_change_rad = 0.25\n");
  const ProgramConfig config = ReadRecord(path);
  EXPECT_EQ(config.train.env.high_level.yaw_change_rad, 0.25);
  ProgramConfig asked;
  asked.train.env.task = "tracking";
  EXPECT_EQ(MessageOf([&] { ApplyTomlFile(path, &asked); }),
            path +
                ":4: env.control.yaw_change_rad is of task control and means nothing to task "
                "tracking");
}

TEST(Configuration, AnotherAircraftNeedsItsOwnPresetOrSpeeds) {
  const auto refused = [](const std::string& task, const std::vector<std::string>& assignments) {
    return MessageOf([&] { ResolveConfig({task, "default", "", assignments}); });
  };
  const std::string why =
      "env.aircraft = aerosonde, but all else is made for f16, from 1000 ft/s on: ";
  EXPECT_THAT(refused("heading", {"env.aircraft=aerosonde"}),
              HasSubstr(why + "use --preset aerosonde, or set env.initial.true_airspeed_min_fps"));
  EXPECT_THAT(refused("tracking", {"env.aircraft=aerosonde"}), HasSubstr(why + "set env.initial."));
  EXPECT_EQ(refused("heading", {"env.aircraft=aerosonde", "env.initial.true_airspeed_min_fps=75",
                                "env.initial.true_airspeed_max_fps=88"}),
            "");
  EXPECT_EQ(MessageOf([] {
              ResolveConfig({"heading", "aerosonde", "", {"env.aircraft=aerosonde"}});
            }),
            "");
}

TEST(Configuration, NumbersMayHaveSuffixes) {
  const auto steps = [](const std::string& text) {
    return ResolveConfig({"heading", "default", "", {"run.total_steps=" + text}}).train.total_steps;
  };
  EXPECT_EQ(steps("10M"), 10000000u);
  EXPECT_EQ(steps("1.35G"), 1350000000u);
  EXPECT_EQ(steps("20k"), 20000u);
  EXPECT_THAT(MessageOf([&] { steps("10m"); }), HasSubstr("must be an integer, not \"10m\""));
}

TEST(Configuration, LaterSourcesWin) {
  const ProgramConfig config =
      ResolveConfig({"heading",
                     "default",
                     "",
                     {"ppo.gamma=0.5", "ppo.gamma = 0.6", "env.flight_control=direct"}});
  EXPECT_EQ(config.train.ppo.gamma, 0.6);
  EXPECT_EQ(config.train.env.flight_control, FlightControlMode::kDirect);
  EXPECT_EQ(config.train.env.action_repeat, 5) << "from the preset";
}

TEST(Configuration, ThePaperPresetHasThePapersFigures) {
  // NeuralPlane (NeurIPS 2024), Table 7 and PPO settings.
  const TrainConfig train = ResolveConfig({"heading", "paper", "", {}}).train;
  EXPECT_EQ(train.total_steps, 1350000000u);
  EXPECT_EQ(train.ppo.num_aircraft, 3000);
  EXPECT_EQ(train.ppo.rollout_steps, 3000);
  EXPECT_EQ(train.ppo.epochs, 16);
  EXPECT_EQ(train.ppo.minibatches, 5);
  EXPECT_EQ(train.ppo.chunk_length, 8);
  EXPECT_EQ(train.ppo.learning_rate, 3e-4);
  EXPECT_EQ(train.ppo.final_learning_rate_fraction, 1);
  EXPECT_EQ(train.ppo.gamma, 0.99);
  EXPECT_EQ(train.ppo.gae_lambda, 0.95);
  EXPECT_EQ(train.ppo.max_gradient_norm, 2);
  EXPECT_FALSE(train.ppo.popart);
  EXPECT_EQ(train.env.action_repeat, 1);
  EXPECT_EQ(train.env.control_interval_s, 0.02);
  EXPECT_FALSE(train.env.initial.trimmed);
}

TEST(Configuration, ThePaperPresetOfControlHasThePapersFigures) {
  // NeuralPlane (NeurIPS 2024), Table 7; all but the budget and the task as for Heading.
  const TrainConfig control = ResolveConfig({"control", "paper", "", {}}).train;
  EXPECT_EQ(control.total_steps, 2250000000u);
  EXPECT_EQ(control.env.task, "control");
  EXPECT_EQ(control.env.control.pitch_change_rad, 3);
  EXPECT_EQ(control.env.control.speed_error_weight, 0) << "the angle alone";
  EXPECT_TRUE(control.env.control.reward_includes_roll);
  EXPECT_EQ(control.env.control.training_tolerance_min, 1);
  const std::vector<std::string> differences = Differences(
      ResolveConfig({"control", "paper", "", {}}), ResolveConfig({"heading", "paper", "", {}}));
  for (const std::string& difference : differences) {
    const std::string key = difference.substr(0, difference.find(' '));
    EXPECT_TRUE(key == "run.total_steps" || key == "env.task" || key.rfind("env.control.", 0) == 0)
        << difference;
  }
}

TEST(Configuration, ThePaperPresetOfTrackingHasThePapersFigures) {
  // NeuralPlane (NeurIPS 2024), Table 7; what it leaves open, and PPO, as for Heading.
  const TrainConfig tracking = ResolveConfig({"tracking", "paper", "", {}}).train;
  EXPECT_EQ(tracking.total_steps, std::int64_t{300000000} * 50)
      << "the paper counts the high-level policy's";
  EXPECT_EQ(tracking.env.action_repeat, 50);
  EXPECT_EQ(tracking.env.observation_noise, 0) << "as its public configuration";
  EXPECT_EQ(tracking.env.tracking.training_tolerance_max, 1);
  EXPECT_EQ(tracking.env.tracking.distance_ft.min, 2000);
  EXPECT_EQ(tracking.env.tracking.distance_ft.max, 2000);
  EXPECT_EQ(tracking.env.tracking.error_axes, TrackingAxes::kEarth);
  EXPECT_EQ(tracking.ppo.num_aircraft, 10000);
  EXPECT_EQ(tracking.ppo.rollout_steps, 100);
  const std::set<std::string> own = {"run.total_steps",   "env.task",
                                     "env.action_repeat", "env.observation_noise",
                                     "ppo.num_aircraft",  "ppo.rollout_steps",
                                     "ppo.chunk_length",  "evaluation.interval_iterations"};
  for (const std::string& difference : Differences(ResolveConfig({"tracking", "paper", "", {}}),
                                                   ResolveConfig({"heading", "paper", "", {}}))) {
    const std::string key = difference.substr(0, difference.find(' '));
    EXPECT_TRUE(own.count(key) == 1 || key.rfind("env.tracking.", 0) == 0) << difference;
  }
}

TEST(Configuration, EveryPresetIsConsistent) {
  for (const Preset& preset : Presets()) {
    EXPECT_NO_THROW(CheckConsistent(ResolveConfig({preset.task, preset.name, "", {}})));
  }
}

TEST(Configuration, ValuesThatCannotGoTogetherAreRefused) {
  const auto refused = [](const std::vector<std::string>& assignments) {
    try {
      CheckConsistent(ResolveConfig({"heading", "default", "", assignments}));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refused({"ppo.chunk_length=7"}), HasSubstr("not a multiple of ppo.chunk_length"));
  EXPECT_THAT(refused({"ppo.num_aircraft=1", "ppo.minibatches=9"}), HasSubstr("minibatches"));
  EXPECT_NE(refused({"env.initial.altitude_min_ft=21000"}), "");
  EXPECT_NE(refused({"checkpoint.interval_s=0"}), "");
  EXPECT_THAT(refused({"env.mission.training_time_limit_s=40"}),
              HasSubstr("0 without env.mission.training_length_s"));
  EXPECT_THAT(
      refused({"ppo.learning_rate_decay=exponential", "ppo.final_learning_rate_fraction=0"}),
      HasSubstr("ppo.final_learning_rate_fraction = 0, which an exponential"));
  EXPECT_EQ(refused({"ppo.learning_rate_decay=linear", "ppo.final_learning_rate_fraction=0"}), "");
  EXPECT_THAT(refused({"ppo.time_limit_ramp=0.5"}),
              HasSubstr("needs env.mission.training_time_limit_s"));
}

TEST(Configuration, WhatOnlyServesTrainingRefusesNoEvaluation) {
  // Lower than that flights begin in training alone.
  const ProgramConfig higher =
      ResolveConfig({"tracking", "default", "", {"env.termination.min_altitude_ft=6000"}});
  EXPECT_THAT(MessageOf([&] { CheckConsistent(higher); }), HasSubstr("training_altitude_min_ft"));
  EXPECT_EQ(MessageOf([&] { CheckFlyable(higher.train.env); }), "");
  const ProgramConfig below =
      ResolveConfig({"tracking", "default", "", {"env.termination.min_altitude_ft=60000"}});
  EXPECT_THAT(MessageOf([&] { CheckFlyable(below.train.env); }),
              HasSubstr("env.initial.altitude_min_ft"));
}

TEST(Configuration, AnEnvironmentThatCannotBeFlownIsNamedByItsKey) {
  ProgramConfig any;
  const std::size_t count = FieldsOf(any).size();
  for (std::size_t i = 0; i < count; ++i) {
    ProgramConfig config;
    const Field field = FieldsOf(config)[i];
    if (field.key.rfind("env.", 0) != 0 || !field.IsNumber()) continue;
    if (double* const* const number = std::get_if<double*>(&field.place)) {
      **number = std::nan("");
    } else {
      *std::get<int*>(field.place) = -1;
    }
    EXPECT_THAT(MessageOf([&] { CheckConsistent(config); }),
                HasSubstr("configuration: " + field.key + " = "));
  }
}

TEST(Configuration, UnknownPresetsAndTasksListWhatThereIs) {
  EXPECT_THROW(
      {
        try {
          ResolveConfig({"heading", "hover", "", {}});
        } catch (const Error& error) {
          EXPECT_STREQ(
              error.what(),
              "unknown preset hover of task heading; known presets: aerosonde, cessna172, default, "
              "easy, paper, quick, robust");
          throw;
        }
      },
      Error);
  try {
    ResolveConfig({"heading", "defalt", "", {}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("; did you mean default?; known presets: "));
  }
  EXPECT_THROW(ResolveConfig({"heding", "default", "", {}}), Error);
}

TEST(Configuration, AnotherTaskInTheFileIsAConflict) {
  for (const char* other :
       {"env.task=control", "env.task_file_hash=0123", "env.task_interface=0123"}) {
    EXPECT_THROW(ResolveConfig({"heading", "default", "", {other}}), Error) << other;
  }
}

TEST(Configuration, DifferencesNameTheKeysAndBothValues) {
  ProgramConfig a, b;
  b.train.ppo.epochs = 3;
  EXPECT_THAT(Differences(a, b), ElementsAre("ppo.epochs (2 against 3)"));
}

}  // namespace
}  // namespace skein
