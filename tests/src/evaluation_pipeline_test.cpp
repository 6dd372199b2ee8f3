// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> Evaluation(const std::string& json,
                                    const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"eval",   "--policy", "untrained",
                                        "--task", "heading",  "--episodes",
                                        "64",     "--set",    "env.time_limit_steps=400",
                                        "--json", json};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

class EvaluationPipeline : public ::testing::Test {
 protected:
  const ScratchDirectory scratch_;
  std::string folder_ = scratch_.path();

  nlohmann::json Fly(const std::string& name, const std::vector<std::string>& more = {}) {
    const std::string path = folder_ + "/" + name + ".json";
    const ProgramResult result = CallSkein(Evaluation(path, more));
    EXPECT_EQ(result.exit_code, 0) << result.error;
    return nlohmann::json::parse(ReadFile(path));
  }
};

TEST_F(EvaluationPipeline, ReportsTheModeAskedForAndBoth) {
  const auto sampled = Fly("sampled", {"--sampled"}), mean = Fly("mean");
  for (const char* key :
       {"episodes", "success_rate", "return_mean", "time_to_target_mean", "terminations"}) {
    EXPECT_TRUE(sampled.contains(key)) << key;
    EXPECT_EQ(sampled[key], sampled["sampled"][key]);
    EXPECT_EQ(mean[key], mean["deterministic"][key]);
  }
  EXPECT_EQ(sampled["deterministic"], mean["deterministic"]);
  EXPECT_EQ(sampled["sampled"], mean["sampled"]);
  EXPECT_NE(mean["deterministic"]["return_mean"], mean["sampled"]["return_mean"]);
  EXPECT_EQ(mean["environment"]["env.time_limit_steps"], 400);
}

TEST_F(EvaluationPipeline, CountsEveryEpisodeOnce) {
  const auto result = Fly("count");
  int ended = 0;
  for (const auto& [kind, count] : result["terminations"].items()) ended += count.get<int>();
  EXPECT_EQ(ended, 64);
  EXPECT_EQ(result["success_rate"].get<double>() * 64,
            result["terminations"]["target_reached"].get<double>());
}

TEST_F(EvaluationPipeline, DependsOnTheSeedAndNotOnThreads) {
  const auto first = Fly("first", {"--seed", "5", "--threads", "1"});
  EXPECT_EQ(first, Fly("again", {"--seed", "5", "--threads", "3"}));
  EXPECT_NE(first["return_mean"], Fly("other", {"--seed", "6"})["return_mean"]);
}

TEST_F(EvaluationPipeline, RecordsFlightsAndChangesNothingByIt) {
  const auto plain = Fly("plain");
  const std::string one = folder_ + "/one.csv", three = folder_ + "/three.csv";
  EXPECT_EQ(plain, Fly("one", {"--flights", one, "--flights-count", "3", "--threads", "1"}));
  EXPECT_EQ(plain, Fly("three", {"--flights", three, "--flights-count", "3", "--threads", "3"}));
  const std::string text = ReadFile(one);
  EXPECT_EQ(text, ReadFile(three));
  EXPECT_EQ(text.rfind("episode,time_s,north_ft,", 0), 0u);
  // Each flight's last row names its end.
  std::size_t ends = 0;
  for (const char* kind : {"target_reached\n", "time_limit\n", "overload\n", "extreme_state\n",
                           "low_altitude\n", "low_speed\n", "high_speed\n", "non_finite\n"}) {
    for (std::size_t at = text.find(kind); at != std::string::npos; at = text.find(kind, at + 1)) {
      ++ends;
    }
  }
  EXPECT_EQ(ends, 3u);
  const std::string sampled = folder_ + "/sampled.csv";
  Fly("sampled", {"--flights", sampled, "--flights-count", "3", "--sampled"});
  EXPECT_NE(text, ReadFile(sampled));
}

TEST_F(EvaluationPipeline, FlightsCanHaveWhatThePolicyObserved) {
  const std::string plain = folder_ + "/plain.csv", observed = folder_ + "/observed.csv";
  ASSERT_EQ(CallSkein(Evaluation(folder_ + "/a.json", {"--flights", plain})).exit_code, 0);
  ASSERT_EQ(
      CallSkein(Evaluation(folder_ + "/a.json", {"--flights", observed, "--flights-observations"}))
          .exit_code,
      0);
  std::istringstream without(ReadFile(plain)), with(ReadFile(observed));
  std::string left, right;
  std::getline(without, left);
  std::getline(with, right);
  EXPECT_EQ(right.rfind(left + ",observation_error_0_scaled,", 0), 0u) << right;
  const auto columns = std::count(right.begin(), right.end(), ',');
  EXPECT_EQ(columns - std::count(left.begin(), left.end(), ','), 22);
  while (std::getline(without, left) && std::getline(with, right)) {
    EXPECT_EQ(right.rfind(left + ",", 0), 0u) << "the rest stays";
    EXPECT_EQ(std::count(right.begin(), right.end(), ','), columns);
  }
  const ProgramResult alone =
      CallSkein({"eval", "--policy", "untrained", "--task", "heading", "--flights-observations"});
  EXPECT_EQ(alone.exit_code, 2);
}

TEST_F(EvaluationPipeline, FlightsThatCannotBeWrittenAreAnError) {
  for (const std::string& path : {folder_ + "/absent/flights.csv", std::string("/dev/full")}) {
    const ProgramResult result =
        CallSkein(Evaluation(folder_ + "/result.json", {"--flights", path}));
    EXPECT_EQ(result.exit_code, path == "/dev/full" ? 1 : 2);
    EXPECT_THAT(result.error, HasSubstr(path));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
  const ProgramResult alone = CallSkein(Evaluation("result.json", {"--flights-count", "3"}));
  EXPECT_EQ(alone.exit_code, 2) << "a number of flights without a file for them";
}

TEST_F(EvaluationPipeline, MoreFlightsThanCanBeRecordedAreRefusedBeforeAnythingFlies) {
  const ProgramResult result = CallSkein(Evaluation(
      folder_ + "/result.json",
      {"--flights", folder_ + "/flights.csv", "--flights-count", "1000", "--mission", "30"}));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.error,
              HasSubstr("to record 64 flights of up to 1800 s by 1 agent takes 5760000 control "
                        "steps, and 5000000 are the most: lower --flights-count or --mission\n"));
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  EXPECT_EQ(result.output, "");
}

TEST_F(EvaluationPipeline, MissionsTooShortForATargetAreRefused) {
  const ProgramResult result =
      CallSkein(Evaluation(folder_ + "/result.json", {"--mission", "0.05"}));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.error,
              HasSubstr("--mission: 3 s are too short for any target, which counts "
                        "after 5 s (env.mission.dwell_s); the option takes minutes\n"));
}

TEST_F(EvaluationPipeline, FilesThatCannotBeWrittenAreAnErrorBeforeAnythingFlies) {
  constexpr std::size_t kLongestName = 255;
  // /proc gives root every right and makes no files.
  for (const std::string& path : {folder_ + "/absent/file", folder_, std::string("/proc/file"),
                                  folder_ + "/" + std::string(300, 'n')}) {
    for (const char* option : {"--json", "--flights"}) {
      const ProgramResult result =
          CallSkein({"eval", "--policy", "untrained", "--task", "heading", option, path});
      const bool is_a_place = path == "/proc/file" || path.size() > kLongestName;
      EXPECT_EQ(result.exit_code, is_a_place ? 1 : 2) << path;
      EXPECT_THAT(result.error, HasSubstr(path + ": cannot be written"));
      EXPECT_EQ(result.output, "");
    }
    const ProgramResult compared =
        CallSkein({"compare", "--task", "heading", "--agents", "zero", "--csv", path});
    EXPECT_THAT(compared.error, HasSubstr(path + ": cannot be written"));
    EXPECT_EQ(compared.output, "");
  }
}

/// Commands that fly the policy `file` and do not train.
std::vector<std::vector<std::string>> FlightsOf(const std::string& file, const std::string& out) {
  return {{"eval", "--policy", file},
          {"compare", "--agents", "policy:" + file, "--no-html"},
          {"replay", "--policy", file, "-o", out + ".csv"},
          {"plot", "flights", "--agents", "policy:" + file, "-o", out + ".svg"},
          {"fdm", "fly", "--policy", file, "--altitude-ft", "15000", "--speed-fps", "800", "-o",
           out + ".csv"}};
}

TEST_F(EvaluationPipeline, SettingsThatNoFlightHeedsAreRefusedByEveryCommandThatFlies) {
  const char* const for_trainings = "is for trainings and changes no flight";
  const char* const for_fresh = "is of untrained networks, and none fly: a policy brings its own";
  const std::vector<std::pair<std::string, std::string>> unheeded = {
      {"network.gru_size=32", for_fresh},        {"network.tanh_mean=false", for_fresh},
      {"learner.precision=fp32", for_trainings}, {"learner.rollout_tile=64", for_trainings},
      {"ppo.epochs=3", for_trainings},           {"run.seed=3", for_trainings},
      {"evaluation.episodes=3", for_trainings},  {"checkpoint.keep=3", for_trainings},
      {"env.stagger_clocks=true", for_trainings}};
  const std::string heading = SKEIN_SOURCE "/policies/heading.skein";
  for (std::vector<std::string> words : FlightsOf(heading, folder_ + "/out")) {
    words.insert(words.end(), {"--set", ""});
    for (const auto& [assignment, why] : unheeded) {
      words.back() = assignment;
      const ProgramResult result = CallSkein(words);
      EXPECT_EQ(result.exit_code, 2) << words[0] << " " << assignment;
      EXPECT_EQ(result.error, "skein: error: --set " + assignment + ": " + why + "\n");
    }
  }
  const ProgramResult zero = CallSkein({"compare", "--task", "heading", "--agents", "zero",
                                        "--no-html", "--set", "learner.backend=fused"});
  EXPECT_EQ(zero.exit_code, 2);
  EXPECT_THAT(zero.error, HasSubstr("learner.backend=fused: computes networks, and no policy"));
}

TEST_F(EvaluationPipeline, SettingsThatFlightsHeedAndThoseOfFilesAreTaken) {
  // Of untrained policies networks are made; a file may say what a run was trained with.
  WriteFile(folder_ + "/config.toml", "[ppo]\nepochs = 3\n[network]\ngru_size = 32\n");
  const std::vector<std::vector<std::string>> heeded = {
      {"--policy", "untrained", "--task", "heading", "--set", "network.gru_size=16", "--set",
       "network.hidden_size=16", "--set", "learner.backend=fused"},
      {"--policy", SKEIN_SOURCE "/policies/heading.skein", "--config", folder_ + "/config.toml",
       "--set", "learner.backend=fused"}};
  for (std::vector<std::string> words : heeded) {
    words.insert(words.begin(), {"eval", "--episodes", "2", "--set", "env.time_limit_steps=400"});
    const ProgramResult result = CallSkein(words);
    EXPECT_EQ(result.exit_code, 0) << result.error;
  }
  const ProgramResult compared =
      CallSkein({"compare", "--task", "heading", "--agents", "zero,policy:untrained", "--no-html",
                 "--episodes", "2", "--set", "network.hidden_size=16"});
  EXPECT_EQ(compared.exit_code, 0) << compared.error;
}

TEST_F(EvaluationPipeline, RefusesWhatIsNotAPolicy) {
  const std::string file = folder_ + "/foreign.skein";
  WriteFile(file, "GIF89a");
  const std::vector<std::vector<std::string>> wrong = {
      {"eval", "--policy", file, "--task", "heading"},
      {"eval", "--policy", folder_ + "/absent.skein", "--task", "heading"},
      {"eval", "--policy", folder_, "--task", "heading"}};
  for (const auto& arguments : wrong) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, arguments[2] == file ? 1 : 2);
    EXPECT_THAT(result.error, HasSubstr(arguments[2]));
  }
  const ProgramResult prefixed =
      CallSkein({"eval", "--policy", "policy:other.skein", "--task", "heading"});
  EXPECT_EQ(prefixed.exit_code, 2);
  EXPECT_THAT(prefixed.error, HasSubstr("it takes the file or run alone: other.skein"));
  const ProgramResult no_task = CallSkein({"eval", "--policy", "untrained"});
  EXPECT_EQ(no_task.exit_code, 2);
  EXPECT_THAT(no_task.error, HasSubstr("--task"));
}

TEST_F(EvaluationPipeline, AgentsThatAreNoPoliciesRefuseWhatOnlyPoliciesHave) {
  const std::vector<std::string> autopilot = {"eval", "--policy", "autopilot", "--task", "heading"};
  const std::pair<std::vector<std::string>, std::string> of_policies[] = {
      {{"--sampled"}, "--sampled is for policies, not for --policy autopilot"},
      {{"--deterministic"}, "--deterministic is for policies"},
      {{"--other-aircraft"}, "--other-aircraft is for policies"},
      {{"--low-level", "autopilot"}, "--low-level is for policies"},
      {{"--set", "env.action_repeat=2"},
       "env.action_repeat cannot be set here: every agent acts at its own rate"}};
  for (const auto& [options, error] : of_policies) {
    std::vector<std::string> arguments = autopilot;
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.error, HasSubstr(error));
  }
}

TEST_F(EvaluationPipeline, AFileThatIsCalledAsAnAgentIsTheFile) {
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::current_path(folder_);
  WriteFile("zero", "GIF89a");
  const ProgramResult result = CallSkein({"eval", "--policy", "zero", "--task", "heading"});
  std::filesystem::current_path(here);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.error, HasSubstr("zero"));
}

TEST_F(EvaluationPipeline, MisspeltAgentsAreSuggested) {
  const ProgramResult result = CallSkein({"eval", "--policy", "autopilt", "--task", "heading"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.error, HasSubstr("did you mean autopilot?"));
  for (const std::string option : {"sampled", "other-aircraft"}) {
    const ProgramResult suffixed = CallSkein({"eval", "--policy", "x.skein@" + option});
    EXPECT_EQ(suffixed.exit_code, 2);
    EXPECT_THAT(suffixed.error, HasSubstr("--" + option + " says the rest"));
  }
}

}  // namespace
}  // namespace skein
