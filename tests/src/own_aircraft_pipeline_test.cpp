// SPDX-License-Identifier: Apache-2.0
// An aircraft from a user's file, through training, resuming, flying and exporting.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "envs/aircraft/registry.h"
#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"
#include "tests/src/tiny_training.h"

namespace skein {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

/// The aerosonde with another mass, where it flies in its own file.
json MyAircraft(double mass_kg) {
  json file = json::parse(AircraftText("aerosonde"));
  file.erase("presets_of");
  file["airframe"]["mass_kg"] = mass_kg;
  file["env"] = {
      {"atmosphere", "standard_1976"},
      {"initial",
       {{"altitude_min_ft", 1500},
        {"altitude_max_ft", 1600},
        {"true_airspeed_min_fps", 75},
        {"true_airspeed_max_fps", 88}}},
      {"heading", {{"altitude_change_ft", 300}, {"speed_change_fps", 13}}},
      {"control", {{"speed_change_fps", 13}}},
      {"termination", {{"min_altitude_ft", 500}, {"min_mach", 0.03}, {"max_mach", 0.14}}}};
  return file;
}

class OwnAircraft : public testing::Test {
 protected:
  void SetUp() override { WriteFile(mine_, MyAircraft(11.5).dump(1)); }

  void Refused(const std::vector<std::string>& arguments, int exit_code, const std::string& why) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, exit_code);
    ExpectOneLine(result.error, why);
  }

  const ScratchDirectory scratch_;
  const std::string mine_ = scratch_ / "mine.json", run_ = scratch_ / "run";
};

TEST_F(OwnAircraft, ARunGoesOnWithoutTheOriginalFile) {
  const std::string text = ReadFile(mine_);
  const ProgramResult trained = CallSkein(TinyTraining(run_, {"--aircraft", mine_}));
  ASSERT_EQ(trained.exit_code, 0) << trained.error;
  EXPECT_EQ(ReadFile(run_ + "/aircraft.json"), text);
  EXPECT_THAT(ReadFile(run_ + "/config.toml"), HasSubstr("aircraft = \"mine#"));
  EXPECT_THAT(ReadFile(run_ + "/config.toml"), HasSubstr("true_airspeed_min_fps = 75.0"));
  EXPECT_THAT(ReadFile(run_ + "/config.toml"), HasSubstr("drag_rise = false"));
  std::filesystem::remove(mine_);

  // Interrupted and resumed it becomes the same.
  std::filesystem::copy(run_, scratch_ / "resumed", std::filesystem::copy_options::recursive);
  const std::string policy = "/checkpoints/policy-final.skein";
  const auto checkpoints = CheckpointsIn(scratch_ / "resumed/checkpoints");
  std::filesystem::remove(checkpoints.back().path);
  std::filesystem::remove(scratch_ / "resumed" + policy);
  const ProgramResult resumed = CallSkein({"train", "--resume", scratch_ / "resumed"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.error;
  ExpectSameFile(run_ + policy, scratch_ / "resumed" + policy);

  const ProgramResult flown = CallSkein({"eval", "--policy", run_, "--episodes", "16"});
  EXPECT_EQ(flown.exit_code, 0) << flown.error;
  EXPECT_THAT(flown.output, HasSubstr("mine#"));
  const std::string header = scratch_ / "policy.h";
  const ProgramResult exported = CallSkein({"export", run_, "--format", "c", "-o", header});
  EXPECT_EQ(exported.exit_code, 0) << exported.error;
  EXPECT_THAT(ReadFile(header), HasSubstr("aircraft mine#"));
  const ProgramResult laws =
      CallSkein({"export", run_, "--flight-control", "c", "-o", scratch_ / "laws.h"});
  EXPECT_EQ(laws.exit_code, 0) << laws.error;
}

TEST_F(OwnAircraft, APolicyFliesNoOtherAircraftUnlessAsked) {
  ASSERT_EQ(CallSkein(TinyTraining(run_, {"--aircraft", mine_})).exit_code, 0);
  const std::string policy = run_ + "/checkpoints/policy-final.skein";
  const std::vector<std::string> alone = {"eval", "--policy", policy, "--episodes", "16"};
  const auto with = [](std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  Refused(alone, 2, "env.aircraft = mine, but is to fly with env.aircraft = f16");
  WriteFile(scratch_ / "mine2.json", MyAircraft(12).dump());
  Refused(with(alone, {"--aircraft", scratch_ / "mine2.json"}), 2, "fly with env.aircraft = mine2");
  // The same content is the same aircraft, whatever the file is called.
  WriteFile(scratch_ / "same.json", MyAircraft(11.5).dump());
  const ProgramResult same = CallSkein(with(alone, {"--aircraft", scratch_ / "same.json"}));
  EXPECT_EQ(same.exit_code, 0) << same.error;
  const ProgramResult other =
      CallSkein(with(alone, {"--aircraft", scratch_ / "mine2.json", "--other-aircraft"}));
  EXPECT_EQ(other.exit_code, 0) << other.error;
  const ProgramResult compared = CallSkein({"compare", "--task", "heading", "--aircraft",
                                            scratch_ / "mine2.json", "--episodes", "16", "--agents",
                                            "zero,policy:" + policy + "@sampled@other-aircraft"});
  EXPECT_EQ(compared.exit_code, 0) << compared.error;
  Refused({"compare", "--task", "heading", "--agents", "zero,policy:" + policy}, 2,
          "env.aircraft = mine, but is to fly with env.aircraft = f16");
}

TEST_F(OwnAircraft, ARunIsComparedOnItsOwnAircraft) {
  ASSERT_EQ(CallSkein(TinyTraining(run_, {"--aircraft", mine_})).exit_code, 0);
  std::filesystem::remove(mine_);
  const std::string results = scratch_ / "result.json", config = scratch_ / "calm.toml";
  const std::string agents = "zero,policy:" + run_;
  const std::vector<std::string> compare = {
      "compare", "--agents", agents,         "--episodes", "4",    "--json",
      results,   "--set",    "env.hold_s=0", "--config",   config, "--no-html"};
  WriteFile(config, "[env]\nobservation_noise = 0\n");
  const ProgramResult compared = CallSkein(compare);
  EXPECT_EQ(compared.exit_code, 0) << compared.error;
  EXPECT_THAT(ReadFile(results), HasSubstr("mine#"));
  const ProgramResult replayed =
      CallSkein({"replay", "--agents", agents, "--episodes", "1", "-o", scratch_ / "flights.csv"});
  EXPECT_EQ(replayed.exit_code, 0) << replayed.error;
  // Under the task's own preset, not as it was trained.
  const ProgramResult preset =
      CallSkein({"eval", "--policy", run_, "--preset", "default", "--episodes", "4"});
  EXPECT_EQ(preset.exit_code, 0) << preset.error;
  // What the command says comes first.
  Refused({"compare", "--agents", agents, "--aircraft", "f16", "--no-html"}, 2,
          "is to fly with env.aircraft = f16 (--aircraft chooses its own, of a run "
          "RUN/aircraft.json;");
  WriteFile(config, "[env]\naircraft = \"f16\"\n");
  Refused(compare, 2, "is to fly with env.aircraft = f16");
  const ProgramResult other = CallSkein({"compare", "--agents", agents + "@other-aircraft",
                                         "--episodes", "4", "--json", results, "--no-html"});
  EXPECT_EQ(other.exit_code, 0) << other.error;
  EXPECT_THAT(ReadFile(results), Not(HasSubstr("mine#")));
  // The aircraft's file is read, too.
  Refused({"compare", "--agents", agents, "--csv", run_ + "/aircraft.json", "--no-html"}, 2,
          "aircraft.json");
}

TEST_F(OwnAircraft, ATaskFileMayNameIt) {
  const std::string task = scratch_ / "bank.toml";
  WriteFile(task, ReadFile(SKEIN_SOURCE "/examples/tasks/bank_and_altitude.toml") +
                      "[env]\naircraft = \"mine.json\"\n");
  const ProgramResult trained = CallSkein(TinyTrainingOf(task, run_));
  ASSERT_EQ(trained.exit_code, 0) << trained.error;
  EXPECT_THAT(ReadFile(run_ + "/config.toml"), HasSubstr("true_airspeed_min_fps = 75.0"));
  EXPECT_THAT(ReadFile(run_ + "/config.toml"), HasSubstr("drag_rise = false"));
  const std::vector<std::string> untrained = {"eval",       "--policy", "untrained",
                                              "--episodes", "2",        "--task",
                                              task,         "--set",    "env.time_limit_steps=50"};
  const ProgramResult before = CallSkein(untrained);
  EXPECT_EQ(before.exit_code, 0) << before.error;
  json silent = MyAircraft(11.5);
  silent.erase("env");
  WriteFile(mine_, silent.dump());
  Refused(untrained, 2, "but all else is made for f16, from 1000 ft/s on");
  WriteFile(scratch_ / "scale.toml",
            "[env.initial]\naltitude_min_ft = 1500\naltitude_max_ft = 1600\n"
            "true_airspeed_min_fps = 75\ntrue_airspeed_max_fps = 88\n"
            "[env.termination]\nmin_altitude_ft = 500\n");
  std::vector<std::string> scaled = untrained;
  scaled.insert(scaled.end(), {"--config", scratch_ / "scale.toml"});
  const ProgramResult by_config = CallSkein(scaled);
  EXPECT_EQ(by_config.exit_code, 0) << by_config.error;
  // The text of it that the policy has names a file from a folder that is not there any more.
  std::filesystem::remove(task);
  std::filesystem::remove(mine_);
  const std::string policy = run_ + "/checkpoints/policy-final.skein";
  const std::vector<std::string> all[] = {
      {"compare", "--agents", "policy:" + run_, "--episodes", "4", "--no-html"},
      {"eval", "--policy", run_, "--episodes", "4"},
      {"eval", "--policy", policy, "--aircraft", run_ + "/aircraft.json", "--episodes", "4"},
      {"export", run_, "--format", "c", "-o", scratch_ / "policy.h"},
      {"export", policy, "--aircraft", run_ + "/aircraft.json", "-o", scratch_ / "alone.h"}};
  for (const std::vector<std::string>& arguments : all) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments[0] << ": " << result.error;
  }
  Refused({"eval", "--policy", policy}, 2, "is to fly with env.aircraft = f16 (--aircraft chooses");
}

TEST_F(OwnAircraft, WhatDoesNotSayWhereItFliesIsRefused) {
  const std::string out = scratch_ / "none";
  json silent = MyAircraft(11.5);
  silent.erase("env");
  WriteFile(mine_, silent.dump());
  Refused({"train", "heading", "--aircraft", mine_, "--out", out}, 2,
          "but all else is made for f16, from 1000 ft/s on: set env.initial");
  json half = MyAircraft(11.5);
  half["env"].erase("heading");
  WriteFile(mine_, half.dump());
  Refused({"train", "heading", "--aircraft", mine_, "--out", out}, 2,
          "what the task asks is made for f16: set env.heading.*");
  json wrong = MyAircraft(11.5);
  wrong["env"]["heading"]["altitude_chnge_ft"] = 1;
  WriteFile(mine_, wrong.dump());
  Refused({"train", "heading", "--aircraft", mine_, "--out", out}, 2,
          "env.heading.altitude_change_ft");
  for (const char* key : {"task", "task_file_hash", "task_interface"}) {
    wrong = MyAircraft(11.5);
    wrong["env"][key] = "control";
    WriteFile(mine_, wrong.dump());
    Refused({"train", "heading", "--aircraft", mine_, "--out", out}, 2,
            "not for an aircraft to say");
  }
  WriteFile(mine_, "{");
  Refused({"train", "heading", "--aircraft", mine_, "--out", out}, 2, mine_);
  Refused({"train", "heading", "--aircraft", scratch_ / "no.json", "--out", out}, 2, "no.json");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(OwnAircraft, AVariantTakesThePresetsOfItsAircraft) {
  json variant = json::parse(AircraftText("aerosonde"));
  variant["airframe"]["mass_kg"] = 12;
  WriteFile(mine_, variant.dump());
  Refused({"train", "heading", "--aircraft", mine_}, 2, "use --preset aerosonde, or set");
  const ProgramResult trained =
      CallSkein(TinyTraining(run_, {"--preset", "aerosonde", "--aircraft", mine_}));
  EXPECT_EQ(trained.exit_code, 0) << trained.error;
  // Its policy alone does not hold the aircraft.
  const std::vector<std::string> alone = {"export",   run_ + "/checkpoints/policy-final.skein",
                                          "--format", "c",
                                          "-o",       scratch_ / "policy.h"};
  // In a process of its own: this one has read the file.
  const ProgramResult without = RunSkein(alone);
  EXPECT_EQ(without.exit_code, 1);
  ExpectOneLine(without.error, "the file of the aircraft mine#");
  std::vector<std::string> with_file = alone;
  with_file.insert(with_file.end(), {"--aircraft", mine_});
  const ProgramResult exported = CallSkein(with_file);
  EXPECT_EQ(exported.exit_code, 0) << exported.error;
}

TEST_F(OwnAircraft, ATamperedCopyIsRefused) {
  ASSERT_EQ(CallSkein(TinyTraining(run_, {"--aircraft", mine_})).exit_code, 0);
  WriteFile(run_ + "/aircraft.json", MyAircraft(5).dump());
  Refused({"eval", "--policy", run_}, 1, "run/aircraft.json: is the aircraft mine#");
}

TEST_F(OwnAircraft, BenchmarksAndStudiesTakeAFile) {
  const ProgramResult measured =
      CallSkein({"bench", "sim", "--aircraft", mine_, "--num-aircraft", "64", "--steps", "2"});
  EXPECT_EQ(measured.exit_code, 0) << measured.error;
  Refused({"bench", "sim", "--aircraft", "4096"}, 2, "how many are stepped at once is --num-air");
  Refused({"bench", "rollout", "--aircraft", scratch_ / "no.json"}, 2, "no.json");

  const std::string study = scratch_ / "study.toml", out = scratch_ / "study";
  const std::string text = R"(
tasks = ["heading"]
seeds = [1]
[training]
steps = 20480
set = ["ppo.num_aircraft=64", "ppo.rollout_steps=16", "ppo.chunk_length=8", "ppo.minibatches=2",
       "env.action_repeat=5", "network.hidden_size=16", "network.gru_size=16", "evaluation.interval_iterations=0",
       "evaluation.final_episodes=8"]
[evaluation]
episodes = 8
)";
  WriteFile(study, text);
  const ProgramResult studied = CallSkein({"study", study, "--out", out, "--aircraft", mine_});
  EXPECT_EQ(studied.exit_code, 0) << studied.error;
  EXPECT_THAT(ReadFile(out + "/runs/heading-default-seed1/config.toml"), HasSubstr("\"mine#"));
  // The file of the study may say so, too.
  WriteFile(study, "aircraft = \"" + mine_ + "\"\n" + text);
  const ProgramResult again = CallSkein({"study", study, "--out", out});
  EXPECT_EQ(again.exit_code, 0) << again.error;
  WriteFile(study, "aircraft = \"" + mine_ + "\"\nset = [\"env.aircraft=f16\"]" + text);
  Refused({"study", study, "--out", out}, 2, "aircraft says it already");
}

TEST_F(OwnAircraft, TheFlightDynamicsTakeAFile) {
  const ProgramResult trim =
      CallSkein({"fdm", "trim", "--aircraft", mine_, "--altitude-ft", "1500", "--speed-fps", "82"});
  EXPECT_EQ(trim.exit_code, 0) << trim.error;
  Refused({"fdm", "trim", "--aircraft", scratch_ / "no.json", "--altitude-ft", "1500",
           "--speed-fps", "82"},
          2, "there is no such aircraft file");
}

}  // namespace
}  // namespace skein
