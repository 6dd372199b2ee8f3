// SPDX-License-Identifier: Apache-2.0
// What the program answers to command lines that it does not understand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/src/run_program.h"

namespace skein {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string Complaint(const std::vector<std::string>& arguments) {
  return CallSkein(arguments).error;
}

TEST(WrongUsage, UnknownCommandsSuggestTheNearest) {
  EXPECT_EQ(
      CallSkein({"trian", "heading"}).error,
      "skein: error: unknown command trian; did you mean train?; known commands: train, eval, "
      "compare, replay, study, plot, report, fdm, aircraft, export, bench, list, info, help, "
      "completion, man (see skein --help)\n");
  EXPECT_THAT(CallSkein({"fdm", "float"}).error,
              HasSubstr("unknown command float; known commands: trim, linearise, sweep, fly, eval, "
                        "simulate (see skein fdm"));
}

TEST(WrongUsage, OptionsOfAnUnknownCommandAreNotBlamed) {
  EXPECT_THAT(CallSkein({"trian", "heading", "--steps", "1"}).error,
              HasSubstr("unknown command trian; did you mean train?"));
  EXPECT_THAT(CallSkein({"fdm", "trimm", "--altitude-ft", "1"}).error,
              HasSubstr("unknown command trimm; did you mean trim?"));
  EXPECT_THAT(CallSkein({"plot", "spaces", "--policy", "x"}).error,
              HasSubstr("unknown command spaces; did you mean space?"));
  EXPECT_THAT(CallSkein({"fdm", "--altitude-ft", "1"}).error,
              HasSubstr("unknown option --altitude-ft"));
}

TEST(WrongUsage, UnknownOptionsSuggestTheNearest) {
  EXPECT_EQ(
      CallSkein({"train", "heading", "--stpes", "5"}).error,
      "skein: error: unknown option --stpes; did you mean --steps? (see skein train --help)\n");
  // Though the misspelt one is required.
  EXPECT_THAT(CallSkein({"fdm", "trim", "--altitude", "5", "--speed-fps", "500"}).error,
              HasSubstr("unknown option --altitude; did you mean --altitude-ft (in ft)?"));
}

TEST(WrongUsage, UnknownOptionsThatAreKeysNameTheSetting) {
  EXPECT_THAT(Complaint({"train", "heading", "--learning-rate", "5"}),
              HasSubstr("did you mean --set ppo.learning_rate=VALUE?"));
  EXPECT_THAT(Complaint({"train", "heading", "--ppo.gamma=0.9"}),
              HasSubstr("did you mean --set ppo.gamma=0.9?"));
  EXPECT_THAT(Complaint({"train", "heading", "--num-envs", "5"}),
              HasSubstr("did you mean --set ppo.num_aircraft=VALUE?"));
  EXPECT_THAT(Complaint({"bench", "iteration", "--num_envs", "5"}),
              HasSubstr("did you mean --set ppo.num_aircraft=VALUE?"));
  for (const char* steps : {"--total-timesteps", "--total_steps"}) {
    EXPECT_THAT(Complaint({"train", "heading", steps, "5"}), HasSubstr("did you mean --steps"));
  }
  EXPECT_THAT(Complaint({"train", "--task", "heading"}),
              HasSubstr("unknown option --task; its value is written alone, without --task"));
  EXPECT_THAT(Complaint({"train", "--env-id", "heading"}),
              HasSubstr("the task is written alone, without --env-id"));
  EXPECT_THAT(Complaint({"train", "heading", "--device", "cuda"}),
              HasSubstr("unknown option --device; Skein computes on the CPU"));
  EXPECT_THAT(Complaint({"--threads", "2", "train", "heading"}),
              HasSubstr("--threads is written behind the command"));
  EXPECT_THAT(Complaint({"--device", "cuda", "train", "heading"}),
              HasSubstr("unknown option --device; Skein computes on the CPU"));
}

TEST(WrongUsage, UnknownOptionsNameNoSettingThatWouldBeRefused) {
  EXPECT_THAT(Complaint({"train", "control", "--dwell-s", "5"}),
              HasSubstr("did you mean --set env.control.dwell_s=VALUE?"));
  for (const char* training : {"--gamma", "--lr", "--training-noise-max", "--task-file-hash"}) {
    EXPECT_THAT(Complaint({"eval", "--policy", "untrained", training, "5"}),
                Not(HasSubstr("--set")))
        << training;
  }
  EXPECT_THAT(Complaint({"eval", "--policy", "untrained", "--max-episode-steps", "5"}),
              HasSubstr("did you mean --set env.time_limit_steps=VALUE (control steps; "));
  for (const char* repeat : {"--action_repeat", "--frame-skip"}) {
    EXPECT_THAT(Complaint({"bench", "sim", repeat, "5"}),
                HasSubstr("did you mean --action-repeat?"));
  }
}

TEST(WrongUsage, WordsOfOtherProgramsNameWhatStandsForThem) {
  const auto train = [](const char* option) { return Complaint({"train", "heading", option}); };
  EXPECT_THAT(train("--exp-name"), HasSubstr("unknown option --exp-name; did you mean --out?"));
  EXPECT_THAT(train("-o"), HasSubstr("unknown option -o; did you mean --out?"));
  EXPECT_THAT(train("--checkpoint"),
              HasSubstr("--from starts from a policy, and --resume goes on"));
  EXPECT_THAT(train("--wandb"), HasSubstr("every run writes TensorBoard's events and metrics.csv"));
  EXPECT_THAT(train("--num-workers"), HasSubstr("did you mean --threads?"));
  EXPECT_THAT(Complaint({"eval", "--model", "x"}), HasSubstr("did you mean --policy?"));
  EXPECT_THAT(Complaint({"eval", "--env", "x"}), HasSubstr("did you mean --task?"));
  EXPECT_THAT(Complaint({"eval", "--eval-episodes", "9"}), HasSubstr("did you mean --episodes?"));
  EXPECT_THAT(Complaint({"play"}), HasSubstr("unknown command play; did you mean eval?"));
  EXPECT_THAT(Complaint({"heading"}), HasSubstr("did you mean train heading?"));
}

TEST(WrongUsage, WhatACommandDoesNotHaveIsNotSuggested) {
  EXPECT_THAT(Complaint({"list", "--device", "cpu"}), Not(HasSubstr("--threads")));
  EXPECT_THAT(Complaint({"compare", "--controller", "x"}), Not(HasSubstr("--low-level")));
  EXPECT_THAT(Complaint({"train", "heading", "task=control"}), Not(HasSubstr("--task,")));
  EXPECT_THAT(Complaint({"eval", "--set", "ppo.gamma", "0.9"}), Not(HasSubstr("mean")));
}

TEST(WrongUsage, OptionsInAnotherUnitAreSuggestedWithTheirs) {
  EXPECT_THAT(Complaint({"fdm", "trim", "--speed", "500"}), HasSubstr("--speed-fps (in ft/s)?"));
  EXPECT_THAT(Complaint({"fdm", "trim", "--altitude-m", "9"}), HasSubstr("--altitude-ft (in ft)?"));
  EXPECT_THAT(Complaint({"fdm", "fly", "--flight", "9"}), Not(HasSubstr("mean")));
}

TEST(WrongUsage, TheDashesOfOptionsAreNoLettersThatAgree) {
  for (const char* option : {"--out", "--test", "--role"}) {
    EXPECT_THAT(Complaint({"eval", option}), Not(HasSubstr("mean"))) << option;
  }
  EXPECT_THAT(Complaint({"train", "heading", "-seed", "1"}), HasSubstr("did you mean --seed?"));
}

TEST(WrongUsage, SettingsAndConditionsThatAreWrittenOtherwiseAreNamed) {
  EXPECT_THAT(Complaint({"train", "heading", "--set", "lr", "0.9"}),
              HasSubstr("unexpected argument 0.9; did you mean --set ppo.learning_rate=VALUE?"));
  EXPECT_THAT(Complaint({"train", "heading", "ppo.lr=3e-4"}),
              HasSubstr("unexpected argument ppo.lr=3e-4; did you mean --set "
                        "ppo.learning_rate=3e-4?"));
  EXPECT_THAT(Complaint({"train", "heading", "--batch-size=64"}),
              HasSubstr("did you mean --set ppo.minibatches=VALUE (the number of minibatches"));
  EXPECT_THAT(Complaint({"train", "heading", "x=1"}), HasSubstr("unexpected argument x=1 (see"));
  EXPECT_THAT(Complaint({"eval", "windy=hard"}), HasSubstr("mean --condition windy=hard?"));
  EXPECT_THAT(Complaint({"eval", "--windy", "hard"}), HasSubstr("mean --condition windy=LEVEL?"));
  EXPECT_THAT(Complaint({"eval", "--condition", "windy", "hard"}),
              HasSubstr("mean --condition windy=LEVEL?"));
}

TEST(WrongUsage, AnOptionIsNoValueOfAnother) {
  for (const char* option : {"--preset", "--out", "--config"}) {
    const std::string message = std::string(option) + ": a value is missing before --threads (see";
    EXPECT_THAT(Complaint({"train", "heading", option, "--threads", "1"}), HasSubstr(message));
  }
}

TEST(WrongUsage, UnknownTasksAndPresetsListTheKnownOnes) {
  EXPECT_THAT(CallSkein({"train", "heding"}).error,
              HasSubstr("unknown task heding; did you mean heading?"));
  const auto preset = [](const char* name) {
    return Complaint({"train", "heading", "--preset", name});
  };
  EXPECT_THAT(preset("fast"), HasSubstr("unknown preset fast of task heading; known presets: "
                                        "aerosonde, cessna172, default, easy"));
  EXPECT_THAT(preset("planner"), HasSubstr("; it is one of tracking; known presets: "));
  EXPECT_THAT(preset("./my.toml"), HasSubstr("; a file of settings is given by --config; "));
}

}  // namespace
}  // namespace skein
