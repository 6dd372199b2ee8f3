// SPDX-License-Identifier: Apache-2.0
// Runs studies as a user does, on trainings of a moment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "src/bench/machine.h"
#include "src/config/configuration.h"
#include "src/files/output_file.h"
#include "src/report/run_record.h"
#include "src/run/run_directory.h"
#include "src/study/study.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Two levels and two seeds, in trainings of four iterations.
const char* const kStudy = R"(
tasks = ["heading"]
seeds = [3, 4]
agents = ["zero"]
set = ["env.time_limit_steps=100", "env.heading.earliest_success_step=100"]

[training]
steps = 20480
set = ["ppo.num_aircraft=64", "ppo.rollout_steps=16", "ppo.chunk_length=8", "ppo.minibatches=2",
       "network.hidden_size=16", "network.gru_size=16", "evaluation.interval_iterations=2",
       "evaluation.episodes=8", "evaluation.final_episodes=8", "checkpoint.interval_iterations=1"]

[evaluation]
episodes = 20
seed = 5

[[level]]
name = "quiet"
[[level]]
name = "loud, 0.1"
condition = ["noisy=0.1"]
)";

class StudyPipeline : public ::testing::Test {
 protected:
  StudyPipeline() { WriteFile(file_, kStudy); }

  std::vector<std::string> Command(const std::string& out) const {
    return {"study", file_, "--out", out, "--threads", "1"};
  }

  std::vector<std::string> CommandForLevel(const std::string& out, const char* level) const {
    std::vector<std::string> words = Command(out);
    words.insert(words.end(), {"--level", level});
    return words;
  }

  void ExpectError(const std::string& text, const std::string& message) {
    WriteFile(file_, text);
    const ProgramResult result = CallSkein(Command(scratch_ / "wrong"));
    EXPECT_EQ(result.exit_code, 2) << text;
    EXPECT_THAT(result.error, HasSubstr(message));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }

  const ScratchDirectory scratch_;
  std::string file_ = scratch_ / "small.toml";
};

TEST_F(StudyPipeline, TrainsAndComparesEveryCell) {
  const std::string out = scratch_ / "out";
  const ProgramResult result = CallSkein(Command(out));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  for (const char* run : {"heading-quiet-seed3", "heading-quiet-seed4", "heading-loud--0.1-seed3",
                          "heading-loud--0.1-seed4"}) {
    EXPECT_TRUE(fs::exists(out + "/runs/" + run + "/evaluation.json")) << run;
  }
  const auto results = nlohmann::json::parse(ReadFile(out + "/results.json"));
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[1]["level"], "loud, 0.1");
  for (const auto& level : results) {
    ASSERT_EQ(level["comparison"]["agents"].size(), 3u);
    EXPECT_EQ(level["comparison"]["agents"][1]["name"], "seed 4");
    EXPECT_EQ(level["comparison"]["episodes"], 20);
    EXPECT_EQ(level["comparison"]["program"], nlohmann::json(ProgramJson()));
  }
  EXPECT_EQ(results[0]["comparison"]["environment"]["env.observation_noise"], 0.01);
  EXPECT_EQ(results[1]["comparison"]["environment"]["env.observation_noise"], 0.1);
  // Under another level another policy came out.
  EXPECT_NE(results[0]["comparison"]["agents"][0]["return_mean"],
            results[1]["comparison"]["agents"][0]["return_mean"]);
  std::istringstream rows(ReadFile(out + "/results.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(rows, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 1u + 2 * 4);
  EXPECT_EQ(lines[0].rfind("task,level,agent,episodes,seeds,success_rate,", 0), 0u);
  EXPECT_EQ(lines[1].rfind("heading,quiet,trained,20,2,", 0), 0u);
  EXPECT_EQ(lines[8].rfind("heading,\"loud, 0.1\",zero,20,,", 0), 0u);
  for (const std::string& text :
       {"training 3 of 4: " + out + "/runs/heading-loud--0.1-seed3",
        std::string("trained (2 seeds)"), std::string("heading, loud, 0.1"),
        std::string("results.csv"), std::string("\nreport          ")}) {
    EXPECT_THAT(result.output, HasSubstr(text));
  }
}

TEST_F(StudyPipeline, TrainingsRecordThePresetOrTaskFileThatTheyBeganWith) {
  const std::string out = scratch_ / "out";
  WriteFile(file_, std::string("preset = \"robust\"\n") + kStudy);
  ASSERT_EQ(CallSkein(CommandForLevel(out, "quiet")).exit_code, 0);
  const RunRecord run = ReadRunRecord(out + "/runs/heading-quiet-seed3");
  EXPECT_EQ(run.preset, "robust");
  const auto is_changed = [rows = ConfigurationJson(run)](const std::string& key) {
    return std::any_of(rows.begin(), rows.end(), [&](const nlohmann::ordered_json& row) {
      return row["key"] == key && row.contains("preset");
    });
  };
  EXPECT_FALSE(is_changed("env.wind.speed_max_fps")) << "the preset's own";
  EXPECT_TRUE(is_changed("env.time_limit_steps")) << "the study's";

  const std::string task = SKEIN_SOURCE "/examples/tasks/heading.toml";
  std::string of_file = kStudy;
  of_file.replace(of_file.find("heading"), 7, task);
  of_file.replace(of_file.find(", \"env.heading"), 41, "");
  of_file.replace(of_file.find("steps=100"), 9, "steps=300");
  WriteFile(file_, of_file);
  const std::string of_task = scratch_ / "of_task";
  const ProgramResult result = CallSkein(CommandForLevel(of_task, "quiet"));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  const std::string path = of_task + "/runs/" + FileNamePart(task) + "-quiet-seed3";
  EXPECT_EQ(ReadRunRecord(path).preset, "of " + task);
}

TEST_F(StudyPipeline, ALevelHasPrecedenceOverWhatAllConfigurationsBeginWith) {
  WriteFile(file_, R"(
tasks = ["heading"]
seeds = [1]
set = ["env.observation_noise=0.02"]
[training]
set = ["env.observation_noise=0.03", "ppo.epochs=7"]
[[level]]
name = "usual"
[[level]]
name = "noisy"
condition = ["noisy=0.05"]
)");
  const Study study = ReadStudy(file_);
  const auto noise = [](const ProgramConfig& config) { return config.train.env.observation_noise; };
  EXPECT_EQ(noise(LevelConfig(study, "heading", study.levels[0])), 0.02);
  EXPECT_EQ(noise(LevelConfig(study, "heading", study.levels[1])), 0.05);
  EXPECT_EQ(noise(TrainingConfig(study, "heading", study.levels[0], 1)), 0.03);
  EXPECT_EQ(noise(TrainingConfig(study, "heading", study.levels[1], 1)), 0.05);
  EXPECT_EQ(TrainingConfig(study, "heading", study.levels[1], 1).train.ppo.epochs, 7);
}

TEST_F(StudyPipeline, EvaluatesHoldsAndMissionsButDoesNotTrainThem) {
  const std::string tasks = "tasks = [\"heading\", \"tracking\"]\nseeds = [1]\n";
  WriteFile(file_, tasks + "[evaluation]\nhold = 12.5\n");
  const Study held = ReadStudy(file_);
  EXPECT_EQ(LevelConfig(held, "heading", held.levels[0]).train.env.hold_s, 12.5);
  EXPECT_EQ(LevelConfig(held, "tracking", held.levels[0]).train.env.hold_s, 0) << "a point";
  EXPECT_EQ(TrainingConfig(held, "heading", held.levels[0], 1).train.env.hold_s,
            ResolveConfig({"heading", "default", "", {}}).train.env.hold_s)
      << "the preset's";
  WriteFile(file_, tasks + "[evaluation]\nmission = 2\n");
  const Study mission = ReadStudy(file_);
  EXPECT_EQ(LevelConfig(mission, "tracking", mission.levels[0]).train.env.mission.length_s, 120);
  EXPECT_EQ(TrainingConfig(mission, "heading", mission.levels[0], 1).train.env.mission.length_s, 0);
}

TEST_F(StudyPipeline, ReportsHowTargetsWereHeld) {
  std::string text = kStudy;
  // The whole range counts as reached at the end of the time, and is held then.
  text.insert(text.find("episodes = 20\n"), "hold = 2\n");
  text.insert(text.find("\"env.time_limit_steps"),
              "\"env.heading.yaw_tolerance_deg=180\", \"env.heading.altitude_tolerance_ft=5000\", "
              "\"env.heading.speed_tolerance_fps=500\", ");
  WriteFile(file_, text);
  const std::string out = scratch_ / "out";
  const ProgramResult result = CallSkein(Command(out));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("within tolerances, %"));
  EXPECT_THAT(result.output, HasSubstr("net rolls per minute"));
  const auto results = nlohmann::json::parse(ReadFile(out + "/results.json"));
  EXPECT_EQ(results[0]["comparison"]["agents"][0]["estimates"]["hold_within"]["count"], 20);
  const std::string csv = ReadFile(out + "/results.csv");
  for (const char* columns : {",hold_within,hold_within_low,", ",peak_load_factor_g,",
                              ",lowest_load_factor_g_worst,", ",peak_abs_p_deg_s_worst,"}) {
    EXPECT_THAT(csv.substr(0, csv.find('\n')), HasSubstr(columns));
  }
}

TEST_F(StudyPipeline, FliesAgainWhatItTrainedAgain) {
  const std::string out = scratch_ / "out";
  ASSERT_EQ(CallSkein(Command(out)).exit_code, 0);
  const auto hash = [&out] {
    return nlohmann::json::parse(
        ReadFile(out + "/results.json"))[0]["comparison"]["identity"]["agents"][0]["policy"];
  };
  const auto before = hash();
  std::string longer = kStudy;
  longer.replace(longer.find("20480"), 5, "25600");
  WriteFile(file_, longer);
  EXPECT_THAT(CallSkein(Command(out)).error, HasSubstr("was trained with another configuration"));
  // Other trainings behind the same names.
  fs::remove_all(out + "/runs");
  const ProgramResult again = CallSkein(Command(out));
  ASSERT_EQ(again.exit_code, 0) << again.error;
  EXPECT_THAT(again.output, HasSubstr("heading, quiet: flying"));
  EXPECT_NE(hash(), before);
  // A comparison that is no longer whole.
  WriteFile(out + "/comparisons/heading-loud--0.1.json", "{\"identity\": ");
  const ProgramResult mended = CallSkein(Command(out));
  ASSERT_EQ(mended.exit_code, 0) << mended.error;
  EXPECT_THAT(mended.output, HasSubstr("heading, loud, 0.1: flying"));
  EXPECT_THAT(mended.output, ::testing::Not(HasSubstr("heading, quiet: flying")));
}

TEST_F(StudyPipeline, HighLevelsAreTrainedOverTheLowLevelPolicy) {
  std::string tracking = kStudy;
  tracking.replace(tracking.find("heading"), 7, "tracking");
  tracking.replace(tracking.find(", \"env.heading"), 41, "");
  tracking.insert(0, "preset = \"planner\"\n");
  const std::string without = tracking;
  tracking.insert(0, "low_level = \"autopilot\"\n");
  const std::string out = scratch_ / "out";
  WriteFile(file_, tracking);
  const ProgramResult result = CallSkein(Command(out));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_TRUE(fs::exists(out + "/runs/tracking-quiet-seed3/low_level.skein"));
  const std::string log = ReadFile(out + "/runs/tracking-quiet-seed3/log.txt");
  EXPECT_THAT(log, HasSubstr("preset planner\n"));
  EXPECT_THAT(log, HasSubstr("low-level policy: the autopilot, variant aggressive\n"));
  // High-level policies and agents that fly themselves flew the same episodes, and it is known what
  // it depended on.
  EXPECT_THAT(CallSkein(Command(out)).output, ::testing::Not(HasSubstr("flying")));
  std::string other = tracking;
  other.replace(other.find("autopilot"), 9, "autopilot:traditional");
  WriteFile(file_, other);
  EXPECT_THAT(CallSkein(Command(out)).error, HasSubstr("another low-level policy"));
  ExpectError(without, "task tracking needs low_level = ");
  ExpectError(std::string("low_level = \"autopilot\"\n") + kStudy,
              "for tasks of a high-level policy");
}

TEST_F(StudyPipeline, KilledAgainAndAgainItEndsAsInOneGo) {
  const std::string whole = scratch_ / "whole", torn = scratch_ / "torn apart";
  ASSERT_EQ(CallSkein(Command(whole)).exit_code, 0);
  // Ends it at moments of every kind, by signals of both kinds.
  const std::vector<std::pair<const char*, int>> moments = {
      {"/runs/heading-quiet-seed3/lock", SIGKILL},
      {"/runs/heading-quiet-seed3/checkpoints/checkpoint-000002.skein", SIGTERM},
      {"/runs/heading-quiet-seed3/evaluation.json", SIGKILL},
      {"/runs/heading-quiet-seed4/config.toml", SIGKILL},
      {"/comparisons/heading-quiet.json", SIGKILL},
      {"/runs/heading-loud--0.1-seed4/checkpoints/checkpoint-000003.skein", SIGTERM}};
  int kills = 0;
  for (const auto& [path, signal] : moments) {
    RunningProgram program(Command(torn));
    program.WaitUntil([&, file = torn + path] { return fs::exists(file); });
    program.Signal(signal);
    const ProgramResult result = program.Wait();
    EXPECT_TRUE(result.exit_code == 0 || result.signal == signal) << path << result.error;
    if (result.exit_code == 0 && !fs::exists(torn + "/results.json")) {
      EXPECT_THAT(result.output, HasSubstr("; resume with: " SKEIN_PROGRAM " study " + file_ +
                                           " --out '" + torn + "'\n"));
    }
    kills += result.signal == SIGKILL;
  }
  EXPECT_GE(kills, 1);
  const ProgramResult last = CallSkein(Command(torn));
  ASSERT_EQ(last.exit_code, 0) << last.error;
  EXPECT_EQ(ReadFile(torn + "/results.csv"), ReadFile(whole + "/results.csv"));
  EXPECT_EQ(ReadFile(torn + "/results.json"), ReadFile(whole + "/results.json"));
}

TEST_F(StudyPipeline, KeepsWhatIsFinishedAndRefusesWhatIsOtherwise) {
  const std::string out = scratch_ / "out";
  std::string text = kStudy;
  const auto replace = [&text](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  WriteFile(file_, replace("seeds = [3, 4]", "seeds = [3]"));
  ASSERT_EQ(CallSkein(Command(out)).exit_code, 0);
  const std::string run = out + "/runs/heading-quiet-seed3/log.txt";
  const std::string log = ReadFile(run);
  // Another agent and more episodes need no training, another seed and another level their own.
  replace("agents = [\"zero\"]", "agents = [\"zero\", \"random\"]");
  WriteFile(file_, replace("episodes = 20", "episodes = 30"));
  EXPECT_THAT(CallSkein(Command(out)).output, ::testing::Not(HasSubstr("training 1 of")));
  replace("seeds = [3]", "seeds = [3, 4]");
  WriteFile(file_, text += "[[level]]\nname = \"louder\"\ncondition = [\"noisy=0.2\"]\n");
  ASSERT_EQ(CallSkein(Command(out)).exit_code, 0);
  EXPECT_EQ(ReadFile(run), log);
  EXPECT_TRUE(fs::exists(out + "/runs/heading-louder-seed4/evaluation.json"));
  EXPECT_EQ(nlohmann::json::parse(ReadFile(out + "/results.json"))[0]["comparison"]["episodes"],
            30);
  WriteFile(file_, replace("ppo.minibatches=2", "ppo.minibatches=4"));
  const ProgramResult other = CallSkein(Command(out));
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.error, HasSubstr("ppo.minibatches"));
}

TEST_F(StudyPipeline, OneTrainingCanServeAllLevels) {
  std::string text = kStudy;
  const std::string steps = "steps = 20480";
  text.replace(text.find(steps), steps.size(),
               "steps = 20480\nper_level = false\ncondition = [\"noisy=0.05\"]");
  WriteFile(file_, text);
  const std::string out = scratch_ / "out";
  ASSERT_EQ(CallSkein(Command(out)).exit_code, 0);
  EXPECT_THAT(ReadFile(out + "/runs/heading-seed3/config.toml"),
              HasSubstr("observation_noise = 0.05"));
  EXPECT_FALSE(fs::exists(out + "/runs/heading-quiet-seed3"));
  EXPECT_EQ(nlohmann::json::parse(ReadFile(out + "/results.json")).size(), 2u);
}

TEST_F(StudyPipeline, TrainingsStartFromWhatTheirTaskHas) {
  const auto with = [](const std::string& begin, const std::string& from) {
    std::string text = kStudy;
    const std::string tasks = "tasks = [\"heading\"]", steps = "steps = 20480";
    text.replace(text.find(tasks), tasks.size(), begin);
    return text.replace(text.find(steps), steps.size(), steps + "\n" + from);
  };
  const std::string both = "tasks = [\"heading\", \"control\"]", fresh = scratch_ / "fresh";
  WriteFile(file_, with(both, ""));
  ASSERT_EQ(CallSkein(CommandForLevel(fresh, "quiet")).exit_code, 0);
  const std::string heading = fresh + "/runs/heading-quiet-seed3";
  const std::string control = fresh + "/runs/control-quiet-seed4/checkpoints/policy-final.skein";

  const std::string on = scratch_ / "on";
  WriteFile(file_, with(both, "from = [\"" + heading + "\", \"" + control + "\"]"));
  // What a process that was killed as it began such a run leaves.
  fs::create_directories(on + "/comparisons");
  fs::create_directories(on + "/runs/heading-quiet-seed3/checkpoints");
  WriteFile(on + "/runs/heading-quiet-seed3/checkpoints/checkpoint-000000.skein", "begun");
  const ProgramResult result = CallSkein(CommandForLevel(on, "quiet"));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  const auto started_from = [&on](const std::string& run) {
    const std::string config = ReadFile(on + "/runs/" + run + "/config.toml");
    return config.substr(0, config.find(" ("));
  };
  EXPECT_THAT(started_from("heading-quiet-seed4"), HasSubstr("# started from " + heading + "/"));
  EXPECT_EQ(started_from("control-quiet-seed3"), "# started from " + control);
  EXPECT_NE(ReadFile(on + "/runs/heading-quiet-seed3/metrics.csv"),
            ReadFile(heading + "/metrics.csv"));

  ExpectError(with(both, "from = [\"" + control + "\", \"" + heading + "\"]"),
              "training.from " + control);
}

TEST_F(StudyPipeline, OtherNetworksToStartFromAreNoticed) {
  const auto study = [&](const std::string& from) {
    std::string text = kStudy;
    const std::string steps = "steps = 20480";
    text.replace(text.find(steps), steps.size(), steps + "\n" + from);
    WriteFile(file_, text);
  };
  const auto carry_out = [&](const std::string& out) {
    std::vector<std::string> words = CommandForLevel(out, "quiet");
    words.insert(words.end(), {"--seeds", "3"});
    return CallSkein(words);
  };
  const std::string fresh = scratch_ / "fresh", out = scratch_ / "out";
  study("");
  ASSERT_EQ(carry_out(fresh).exit_code, 0);
  const std::string run = fresh + "/runs/heading-quiet-seed3";
  study("from = [\"" + run + "\"]");
  ASSERT_EQ(carry_out(out).exit_code, 0);

  // Called otherwise they are the same; others are not.
  const std::string checkpoint = CheckpointsIn(run + "/checkpoints").back().path;
  fs::copy_file(checkpoint, scratch_ / "copy.skein");
  study("from = [\"" + (scratch_ / "copy.skein") + "\"]");
  const ProgramResult same = carry_out(out);
  EXPECT_EQ(same.exit_code, 0) << same.error;
  EXPECT_THAT(same.output, ::testing::Not(HasSubstr("training 1 of")));
  for (const std::string& from :
       {std::string(), "from = [\"" + run + "/checkpoints/policy-final.skein\"]"}) {
    study(from);
    const ProgramResult other = carry_out(out);
    EXPECT_EQ(other.exit_code, 1) << from;
    EXPECT_THAT(other.error, HasSubstr("other networks to start from (training.from)"));
  }
  study("from = [\"" + run + "\"]");
  EXPECT_THAT(carry_out(fresh).error, HasSubstr("other networks to start from"));
}

TEST_F(StudyPipeline, LevelsAndSeedsAreAddedByOption) {
  const std::string out = scratch_ / "out";
  std::vector<std::string> part = Command(out);
  part.insert(part.end(), {"--level", "quiet", "--seeds", "7", "--steps", "10240"});
  const ProgramResult result = CallSkein(part);
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("training 1 of 1: " + out + "/runs/heading-quiet-seed7"));
  EXPECT_THAT(result.output, HasSubstr("trained (1 seed)"));
  EXPECT_THAT(ReadFile(out + "/runs/heading-quiet-seed7/config.toml"),
              HasSubstr("total_steps = 10240"));
  part = Command(out);
  part.insert(part.end(),
              {"--seeds", "7,8", "--level", "quiet", "--level", "loud, 0.1", "--steps", "10240"});
  const ProgramResult more = CallSkein(part);
  ASSERT_EQ(more.exit_code, 0) << more.error;
  EXPECT_THAT(more.output, HasSubstr("training 4 of 4: "));
  EXPECT_THAT(more.output, ::testing::Not(HasSubstr("training 1 of")));
  part.back() = "10241";
  EXPECT_THAT(CallSkein(part).error, HasSubstr("was trained with another configuration"));
  for (const auto& [option, value, message] :
       {std::tuple{"--level", "quite", "no level is called quite; did you mean quiet?"},
        std::tuple{"--seeds", "1,1", "error: --seeds: seeds names 1 twice"},
        std::tuple{"--seeds", "1.5", "--seeds"}}) {
    part = Command(out);
    part.insert(part.end(), {option, value});
    const ProgramResult wrong = CallSkein(part);
    EXPECT_EQ(wrong.exit_code, 2) << value;
    EXPECT_THAT(wrong.error, HasSubstr(message));
  }
}

TEST_F(StudyPipeline, LevelsCarriedOutOneByOneGiveTheResultsOfAllAtOnce) {
  const std::string whole = scratch_ / "whole", parts = scratch_ / "parts";
  ASSERT_EQ(CallSkein(Command(whole)).exit_code, 0);
  for (const char* level : {"loud, 0.1", "quiet"}) {
    const ProgramResult result = CallSkein(CommandForLevel(parts, level));
    ASSERT_EQ(result.exit_code, 0) << result.error;
    EXPECT_THAT(result.output, ::testing::Not(HasSubstr("left out")));
  }
  EXPECT_EQ(ReadFile(parts + "/results.csv"), ReadFile(whole + "/results.csv"));
  EXPECT_EQ(ReadFile(parts + "/results.json"), ReadFile(whole + "/results.json"));
  // Each level keeps its own seeds.
  std::vector<std::string> fewer = CommandForLevel(parts, "quiet");
  fewer.insert(fewer.end(), {"--seeds", "3"});
  ASSERT_EQ(CallSkein(fewer).exit_code, 0);
  const std::string csv = ReadFile(parts + "/results.csv");
  EXPECT_THAT(csv, HasSubstr("\nheading,quiet,trained,20,1,"));
  EXPECT_THAT(csv, HasSubstr("\nheading,\"loud, 0.1\",trained,20,2,"));
}

TEST_F(StudyPipeline, ResultsThatTheStudyWouldFlyOtherwiseNowAreLeftOut) {
  const std::string out = scratch_ / "out";
  ASSERT_EQ(CallSkein(Command(out)).exit_code, 0);
  std::string longer = kStudy;
  longer.replace(longer.find("episodes = 20\n"), 13, "episodes = 30");
  WriteFile(file_, longer);
  const ProgramResult result = CallSkein(CommandForLevel(out, "quiet"));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("heading, loud, 0.1: left out of the results"));
  const auto results = nlohmann::json::parse(ReadFile(out + "/results.json"));
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0]["level"], "quiet");
}

TEST_F(StudyPipeline, WhatWouldNotBeFollowedIsRefused) {
  const std::string begin = "tasks = [\"heading\"]\nseeds = [1]\n";
  ExpectError(begin + "set = [\"run.seed = 2\"]", "seeds says the seeds");
  ExpectError(begin + "[training]\nsteps = 100\nset = [\"run.total_steps=1e6\"]",
              "training.steps says it already");
  ExpectError(begin + "[[training]]\nsteps = 100\n[[training]]\nper_level = false",
              "training must be one table");
  ExpectError(begin + "[training]\nfrom = [\"a\", \"b\"]", "from names 2 for 1 task");
  ExpectError(begin + "[training]\nfrom = [\"\"]", "from names a run or a policy");
  const std::string one_for_all =
      begin + "[training]\nper_level = false\n[[level]]\nname = \"a\"\n";
  ExpectError(one_for_all + "set = [\"ppo.epochs=3\"]", "set ppo.epochs=3 of level a");
  ExpectError(one_for_all + "set = [\"env.action_repeat=3\"]", "level a: env.action_repeat");
  ExpectError(one_for_all + "set = [\"env.hold_s=5\"]\n[evaluation]\nhold = 30",
              "set env.hold_s=5 of level a: evaluation.hold says it already");
}

TEST_F(StudyPipeline, KeepsOutOfDirectoriesOfOthers) {
  const std::string out = scratch_ / "mine";
  fs::create_directory(out);
  WriteFile(out + "/results.csv", "mine");
  const ProgramResult result = CallSkein(Command(out));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.error, HasSubstr("is neither a study nor an empty directory"));
  EXPECT_EQ(ReadFile(out + "/results.csv"), "mine");
}

TEST_F(StudyPipeline, WrongStudiesAreErrorsOfOneLineBeforeAnyTraining) {
  ExpectError("tasks = [\"heading\"]", "seeds must name at least one");
  ExpectError("tasks = [\"heading\"]\nseeds = [1, 1]", "seeds names 1 twice");
  ExpectError("tasks = \"heading\"\nseeds = [1]", ":1: tasks must be a list");
  ExpectError("tasks = [\"heading\"]\nseeds = [1.5]", ":2: seeds must be a whole number");
  ExpectError("tasks = [\"heading\"]\nseeds = [9007199254740993]",
              ":2: seeds must be a whole number in [0, 9007199254740991]");
  ExpectError("tasks = [\"hedding\"]\nseeds = [1]", "did you mean heading?");
  ExpectError("tasks = [\"heading\"]\nseed = [1]", ":2: unknown key seed; did you mean seeds?");
  ExpectError("tasks = [\"heading\"]\nseeds = [1]\nagents = [\"ace\"]", "unknown agent ace");
  ExpectError("tasks = [\"heading\"]\nseeds = [1]\n[[level]]\nset = []", "a level needs a name");
  ExpectError(
      "tasks = [\"heading\"]\nseeds = [1]\n[[level]]\nname = \"a b\"\n[[level]]\nname = "
      "\"a-b\"",
      "level names a-b twice");
  ExpectError("tasks = [\"heading\"]\nseeds = [1]\nset = [\"env.nose=1\"]", "unknown key env.nose");
  ExpectError(
      "tasks = [\"heading\"]\nseeds = [1]\n[training]\nset = [\"env.flight_control=direct\"]",
      "env.flight_control = direct, but is to fly with env.flight_control = full");
  ExpectError(
      "tasks = [\"heading\"]\nseeds = [1]\n[training]\ncondition = [\"noisy=0.1\"]\n"
      "[[level]]\nname = \"a\"\ncondition = [\"noisy=0.2\"]",
      "noisy is given twice");
  ExpectError("tasks = [\"heading\"]\nseeds = [1]\ncontroller = \"x\"",
              ":3: controller is now called low_level");
  ExpectError("tasks = [", "not valid TOML");
  EXPECT_FALSE(fs::exists(scratch_ / "wrong"));
}

}  // namespace
}  // namespace skein
