// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "src/bench/machine.h"
#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

class ComparisonPipeline : public ::testing::Test {
 protected:
  /// Everything that cannot be seen counts as reached, from step 60 on.
  static std::vector<std::string> Command(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"compare"};
    for (const char* setting :
         {"task=heading", "episodes=40", "set=env.time_limit_steps=120",
          "set=env.heading.earliest_success_step=60", "set=env.heading.altitude_tolerance_ft=2000",
          "set=env.heading.yaw_tolerance_deg=120", "set=env.heading.speed_tolerance_fps=250"}) {
      const std::string text = setting;
      arguments.push_back("--" + text.substr(0, text.find('=')));
      arguments.push_back(text.substr(text.find('=') + 1));
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  nlohmann::json Compare(const std::string& agents, const std::vector<std::string>& more = {}) {
    const std::string path = scratch_ / "result.json";
    std::vector<std::string> arguments = Command({"--agents", agents, "--json", path});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.error;
    output_ = result.output;
    return nlohmann::json::parse(ReadFile(path));
  }

  const ScratchDirectory scratch_;
  std::string output_;
};

TEST_F(ComparisonPipeline, EveryAgentFliesTheSameEpisodesWhateverTheOrderAndThreads) {
  const auto forth = Compare("policy:untrained,random:0.2,zero", {"--threads", "1"});
  const auto back = Compare("zero,random:0.2,policy:untrained", {"--threads", "3"});
  EXPECT_EQ(forth["starts"], back["starts"]);
  ASSERT_EQ(forth["agents"].size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(forth["agents"][i]["estimates"], back["agents"][2 - i]["estimates"]);
    EXPECT_EQ(forth["agents"][i]["terminations"], back["agents"][2 - i]["terminations"]);
  }
  // Differences turn round with the order.
  const auto& ahead = forth["agents"][2]["against_first"];
  const auto& behind = back["agents"][2]["against_first"];
  EXPECT_EQ(ahead["success_p_value"], behind["success_p_value"]);
  EXPECT_DOUBLE_EQ(ahead["estimates"]["mach"]["value"].get<double>(),
                   -behind["estimates"]["mach"]["value"].get<double>());
  EXPECT_FALSE(forth["agents"][0].contains("against_first"));
}

TEST_F(ComparisonPipeline, FliesWhatEvalFlies) {
  const auto compared = Compare("policy:untrained,policy:untrained@sampled", {"--seed", "5"});
  const std::string path = scratch_ / "eval.json";
  std::vector<std::string> arguments =
      Command({"--policy", "untrained", "--seed", "5", "--json", path});
  arguments[0] = "eval";
  EXPECT_EQ(CallSkein(arguments).exit_code, 0);
  const auto evaluated = nlohmann::json::parse(ReadFile(path));
  EXPECT_EQ(compared["agents"][0]["estimates"], evaluated["deterministic"]["estimates"]);
  EXPECT_EQ(compared["agents"][1]["estimates"], evaluated["sampled"]["estimates"]);
  EXPECT_EQ(compared["environment"], evaluated["environment"]);
  EXPECT_EQ(compared["program"], nlohmann::json(ProgramJson()));
  EXPECT_EQ(evaluated["program"], nlohmann::json(ProgramJson()));
}

TEST_F(ComparisonPipeline, FliesEveryOtherAgentAsEvalDoes) {
  const auto compared = Compare("zero,random:0.5,autopilot:traditional", {"--seed", "5"});
  for (const auto& expected : compared["agents"]) {
    const std::string name = expected["name"], path = scratch_ / "eval.json";
    SCOPED_TRACE(name);
    std::vector<std::string> arguments = Command({"--policy", name, "--seed", "5", "--json", path});
    arguments[0] = "eval";
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.error;
    EXPECT_THAT(result.output, HasSubstr(name + " on heading"));
    const auto evaluated = nlohmann::json::parse(ReadFile(path));
    EXPECT_EQ(evaluated["agent"], name);
    EXPECT_EQ(evaluated["estimates"], expected["estimates"]);
    EXPECT_EQ(evaluated["terminations"], expected["terminations"]);
    EXPECT_FALSE(evaluated.contains("sampled"));
    auto environment = compared["environment"];
    environment["env.action_repeat"] = expected["action_repeat"];
    EXPECT_EQ(evaluated["environment"], environment);
  }
}

TEST_F(ComparisonPipeline, PairedDifferencesAreThoseOfTheMeans) {
  constexpr Tolerance kRounding{1e-9, "float64 rounding, relative"};
  const auto result = Compare("zero,random");
  const auto& first = result["agents"][0];
  const auto& second = result["agents"][1];
  for (const auto& [key, difference] : second["against_first"]["estimates"].items()) {
    const auto& a = first["estimates"][key];
    const auto& b = second["estimates"][key];
    if (a["count"] != 40 || b["count"] != 40) continue;  // the time, where not all succeeded
    if (key.find("_worst") != std::string::npos) {
      EXPECT_TRUE(difference["value"].is_null()) << key << " is of two flights that differ";
      continue;
    }
    EXPECT_NEAR(difference["value"].get<double>(),
                b["value"].get<double>() - a["value"].get<double>(),
                kRounding * (1 + std::abs(a["value"].get<double>())))
        << key;
    EXPECT_LE(difference["low"], difference["value"]) << key;
    EXPECT_GE(difference["high"], difference["value"]) << key;
  }
}

TEST_F(ComparisonPipeline, PeaksOfEveryAgentHaveTheWorstFlightBehindTheMean) {
  const std::string csv = scratch_ / "table.csv";
  const auto agents = Compare("autopilot,random,zero", {"--hold", "3", "--csv", csv})["agents"];
  for (const auto& agent : agents) {
    const auto value = [&agent](const std::string& key) {
      return agent["estimates"].at(key)["value"].get<double>();
    };
    for (const char* key :
         {"peak_load_factor_g", "peak_alpha_deg", "peak_abs_beta_deg", "peak_abs_p_deg_s"}) {
      EXPECT_GE(value(std::string(key) + "_worst"), value(key)) << agent["name"] << " " << key;
      EXPECT_EQ(agent["estimates"][key]["count"], 40);
    }
    EXPECT_LE(value("lowest_load_factor_g_worst"), value("lowest_load_factor_g"));
    EXPECT_GE(value("peak_load_factor_g"), value("load_factor_g"));
    EXPECT_LE(value("lowest_load_factor_g"), value("load_factor_g"));
    EXPECT_GE(value("peak_abs_beta_deg"), value("abs_beta_deg"));
  }
  // Nobody moves the stick of the last one.
  EXPECT_GT(agents[1]["estimates"]["peak_abs_p_deg_s"]["value"],
            agents[2]["estimates"]["peak_abs_p_deg_s"]["value"]);
  const std::size_t section = output_.find("peaks (worst flight):\n");
  ASSERT_NE(section, std::string::npos) << output_;
  std::istringstream rows(output_.substr(section));
  std::string row;
  std::getline(rows, row);
  for (const char* label : {"peak nz, g", "lowest nz, g", "peak alpha, deg", "peak sideslip, deg",
                            "peak roll rate, deg/s"}) {
    std::getline(rows, row);
    EXPECT_EQ(row.rfind(label, 0), 0u) << row;
    EXPECT_LE(row.size(), 100u) << row;
    EXPECT_EQ(std::count(row.begin(), row.end(), '('), 3) << "one flight's for each agent: " << row;
    EXPECT_THAT(row, ::testing::Not(HasSubstr(".."))) << "cut off";
  }
  const std::string text = ReadFile(csv), header = text.substr(0, text.find('\n'));
  EXPECT_THAT(header, HasSubstr(",hold_yaw_saturated_high,peak_load_factor_g,"
                                "peak_load_factor_g_low,peak_load_factor_g_high,"
                                "peak_load_factor_g_worst,"));
}

TEST_F(ComparisonPipeline, EveryAgentHasItsDifferencesFromAllAheadOfIt) {
  const auto result = Compare("policy:untrained,random:0.2,zero");
  const auto turned = Compare("random:0.2,zero,policy:untrained");
  const auto& agents = result["agents"];
  EXPECT_FALSE(agents[0].contains("against"));
  for (std::size_t i = 1; i < 3; ++i) {
    ASSERT_EQ(agents[i]["against"].size(), i);
    EXPECT_EQ(agents[i]["against"][0], agents[i]["against_first"]);
  }
  // zero beside random, which is ahead of it in both.
  EXPECT_EQ(agents[2]["against"][1], turned["agents"][1]["against_first"]);
  EXPECT_NE(agents[2]["against"][1], agents[2]["against_first"]);
}

TEST_F(ComparisonPipeline, MeasuresHoldsOfTheSameSuccesses) {
  const auto plain = Compare("autopilot,zero,policy:untrained", {"--set", "env.hold_s=0"});
  const auto held = Compare("autopilot,zero,policy:untrained", {"--hold", "3"});
  for (const char* words : {"holding:", "actions while holding:", "net rolls per minute"}) {
    EXPECT_THAT(output_, HasSubstr(words));
  }
  std::istringstream lines(output_);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  EXPECT_EQ(held["environment"]["env.hold_s"], 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &before = plain["agents"][i], &now = held["agents"][i];
    EXPECT_EQ(now["success_rate"], before["success_rate"]);
    EXPECT_EQ(now["estimates"]["success_rate"], before["estimates"]["success_rate"]);
    EXPECT_EQ(now["estimates"]["time_to_target_s"], before["estimates"]["time_to_target_s"]);
    EXPECT_FALSE(before["estimates"].contains("hold_within"));
    EXPECT_EQ(now["estimates"]["hold_within"]["count"],
              now["estimates"]["time_to_target_s"]["count"]);
    EXPECT_LE(now["estimates"]["hold_within_lowest"]["value"],
              now["estimates"]["hold_within"]["value"]);
  }
  EXPECT_GT(held["agents"][0]["estimates"]["hold_within"]["value"], 0.5);
  EXPECT_GT(held["agents"][0]["estimates"]["hold_roll_variation_per_s"]["value"], 0);
  EXPECT_EQ(held["agents"][1]["estimates"]["hold_roll_variation_per_s"]["value"], 0) << "zero";
}

TEST_F(ComparisonPipeline, MeasuresMissions) {
  const std::string csv = scratch_ / "table.csv";
  const auto result = Compare("autopilot,zero", {"--mission", "0.5", "--csv", csv});
  EXPECT_EQ(result["environment"]["env.mission.length_s"], 30);
  const auto& autopilot = result["agents"][0]["estimates"];
  EXPECT_GT(autopilot["targets_per_minute"]["value"], 1);
  EXPECT_EQ(autopilot["losses_per_hour"]["low"], 0);
  EXPECT_EQ(autopilot["success_rate"]["value"], 1);
  EXPECT_EQ(result["agents"][0]["terminations"]["time_limit"], 40);
  EXPECT_THAT(output_, HasSubstr("losses per flight hour"));
  EXPECT_THAT(output_, HasSubstr("flown to the end, %"));
  EXPECT_THAT(output_, ::testing::Not(HasSubstr("time_limit"))) << "said twice";
  const std::string text = ReadFile(csv);
  EXPECT_THAT(text.substr(0, text.find('\n')), HasSubstr(",targets_per_minute,"));
}

TEST_F(ComparisonPipeline, HoldsAndMissionsThatCannotBeAreErrors) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--hold", "0"}, "--hold: '0' is not a number above 0"},
      {{"--hold", "nan"}, "--hold: 'nan' is not a number above 0"},
      {{"--hold", "1e9"}, "env.hold_s = 1e+09"},
      {{"--hold", "1e-9"}, "env.hold_s = 1e-09"},
      {{"--mission", "-1"}, "--mission: '-1' is not a number above 0"},
      {{"--hold", "5", "--mission", "1"}, "--hold and --mission exclude each other"}};
  for (const auto& [options, message] : wrong) {
    std::vector<std::string> arguments = Command({"--agents", "zero"});
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 2) << message;
    EXPECT_THAT(result.error, HasSubstr(message));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
  const ProgramResult point =
      CallSkein({"compare", "--task", "tracking", "--agents", "autopilot", "--hold", "5"});
  EXPECT_EQ(point.exit_code, 2);
  EXPECT_THAT(point.error, HasSubstr("env.hold_s"));
}

TEST_F(ComparisonPipeline, TheTableFitsATerminalAndTheCsvHasARowForEachAgent) {
  const std::string csv = scratch_ / "table.csv";
  Compare("autopilot,random,random:0.1,policy:untrained", {"--csv", csv});
  std::istringstream lines(output_);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  for (const char* word : {"success, %", "time to target, s", "FSM", "McNemar", "random:0.1"}) {
    EXPECT_THAT(output_, HasSubstr(word));
  }
  std::istringstream rows(ReadFile(csv));
  std::string row;
  std::getline(rows, row);
  const auto columns = std::count(row.begin(), row.end(), ',');
  EXPECT_EQ(row.rfind("task,conditions,agent,episodes,seed,policy_step_s,success_rate,", 0), 0u);
  int agents = 0;
  for (; std::getline(rows, row); ++agents) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), columns) << row;
  }
  EXPECT_EQ(agents, 4);
}

TEST_F(ComparisonPipeline, APageMayShowFewerFlights) {
  const std::string page = scratch_ / "page.html";
  const ProgramResult result =
      RunSkein({"compare", "--task", "heading", "--agents", "zero", "--episodes", "4", "--html",
                page, "--flights-count", "2"});
  const char* const no_page = "this build has no page for reports: ";
  if (result.error.find(no_page) != std::string::npos) GTEST_SKIP() << result.error;
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_TRUE(std::filesystem::exists(page));
}

TEST_F(ComparisonPipeline, APageThatHasNoPlaceIsNoFailure) {
  const std::string gone = scratch_ / "gone";
  std::filesystem::create_directory(gone);
  const ProgramResult result =
      RunSkein({"compare", "--task", "heading", "--agents", "zero", "--episodes", "4"}, [&] {
        if (chdir(gone.c_str()) != 0 || rmdir(gone.c_str()) != 0) _exit(1);
      });
  EXPECT_EQ(result.exit_code, 0) << result.error;
  if (result.output.find("\nreport ") == std::string::npos) GTEST_SKIP() << "built without a page";
  EXPECT_THAT(result.output, HasSubstr("report          none: "));
}

TEST_F(ComparisonPipeline, ThePageThatNobodyAskedForReplacesNoFileThatIsRead) {
  WriteFile(scratch_ / "compare.html", "[env]\n");
  const ProgramResult result = RunSkein({"compare", "--task", "heading", "--agents", "zero",
                                         "--episodes", "4", "--config", "./compare.html"},
                                        [&] {
                                          if (chdir(scratch_.path().c_str()) != 0) _exit(1);
                                        });
  if (result.exit_code == 0) GTEST_SKIP() << "built without a page";
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.error, HasSubstr("compare.html: the page goes there"));
  EXPECT_EQ(ReadFile(scratch_ / "compare.html"), "[env]\n");
}

TEST_F(ComparisonPipeline, SaysThatItReplacesAPageThatNobodyAskedFor) {
  const auto compare = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"compare", "--task",     "heading", "--agents",
                                      "zero",    "--episodes", "4"};
    words.insert(words.end(), more.begin(), more.end());
    return RunSkein(words, [&] {
      if (chdir(scratch_.path().c_str()) != 0) _exit(1);
    });
  };
  const ProgramResult first = compare({});
  EXPECT_EQ(first.exit_code, 0) << first.error;
  if (!std::filesystem::exists(scratch_ / "compare.html")) GTEST_SKIP() << "built without a page";
  EXPECT_THAT(first.output, HasSubstr("report          compare.html\n"));
  EXPECT_THAT(compare({}).output, HasSubstr("report          compare.html (replaced)\n"));
  EXPECT_THAT(compare({"--html", "compare.html"}).output,
              HasSubstr("report          compare.html\n"));
}

TEST_F(ComparisonPipeline, RecordsEveryAgentsFlights) {
  Compare("zero,random:0.5", {"--flights", scratch_ / "flights.csv", "--flights-count", "2"});
  const std::string zero = ReadFile(scratch_ / "flights.zero.csv");
  const std::string random = ReadFile(scratch_ / "flights.random-0.5.csv");
  EXPECT_NE(zero, random);
  // Header and first row, the state at time 0 and the target, are the same.
  const auto start = [](const std::string& text) {
    return text.substr(0, text.find('\n', text.find('\n') + 1));
  };
  EXPECT_EQ(start(zero), start(random));
  const std::string alone = scratch_ / "alone.csv";
  std::vector<std::string> arguments =
      Command({"--policy", "random:0.5", "--flights", alone, "--flights-count", "2"});
  arguments[0] = "eval";
  EXPECT_EQ(CallSkein(arguments).exit_code, 0);
  EXPECT_EQ(ReadFile(alone), random);
}

TEST_F(ComparisonPipeline, RefusesMoreFlightsThanCanBeRecorded) {
  const auto refusal = [&](const std::string& option, const std::string& count) {
    const ProgramResult result =
        CallSkein({"compare", "--task", "heading", "--agents", "zero,random", "--no-html",
                   "--mission", "30", option, scratch_ / "flights", "--flights-count", count});
    EXPECT_EQ(result.exit_code, 2) << result.error;
    EXPECT_EQ(result.output, "");
    return result.error;
  };
  EXPECT_THAT(refusal("--acmi", "28"), HasSubstr("28 flights of up to 1800 s by 2 agents"));
  EXPECT_THAT(refusal("--flights", "56"), HasSubstr("56 flights of up to 1800 s by 1 agent "))
      << "a file of one agent is written before the next flies";
}

TEST_F(ComparisonPipeline, FliesInTheEnvironmentOfAFileWhateverTheRateThere) {
  const std::string file = scratch_ / "config.toml";
  WriteFile(file, "[env]\naction_repeat = 7\nobservation_noise = 0.05\n");
  const nlohmann::json result = Compare("zero", {"--config", file});
  EXPECT_EQ(result["environment"]["env.observation_noise"], 0.05);
  EXPECT_EQ(result["agents"][0]["action_repeat"], 1);
  EXPECT_THAT(output_, HasSubstr("still air; noise 0.05"));
}

TEST_F(ComparisonPipeline, WrongAgentsAreErrorsOfOneLine) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"zreo", "unknown agent zreo; did you mean zero?; known agents: autopilot"},
      {"zero:3", "unknown agent zero:3"},
      {"idle", "agent idle is now called zero"},
      {"policies/a.skein", "unknown agent policies/a.skein; did you mean policy:policies/a.skein?"},
      {"untrained", "unknown agent untrained; did you mean policy:untrained?"},
      {"polcy:a.skein", "unknown agent polcy:a.skein; did you mean policy?; known agents: "},
      {"autopilot:agressive", "unknown autopilot \"agressive\"; did you mean aggressive?; known: "},
      {"autopilot:lazy", "unknown autopilot \"lazy\"; known: public, traditional, aggressive"},
      {"policy", "policy: needs a file or a run"},
      {"random:often", "as in random:0.5"},
      {"random:0.001", "as in random:0.5"},
      {"zero,random,zero", "--agents: zero is there twice"}};
  for (const auto& [agents, message] : wrong) {
    const ProgramResult result = CallSkein(Command({"--agents", agents}));
    EXPECT_EQ(result.exit_code, 2) << agents;
    EXPECT_THAT(result.error, HasSubstr(message));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
  const std::vector<std::pair<std::string, std::string>> absent = {
      {"policy:" + (scratch_ / "absent.skein"), "absent.skein"},
      {"policy:" + scratch_.path(), "not the directory of a run"}};
  for (const auto& [agents, message] : absent) {
    const ProgramResult result = CallSkein(Command({"--agents", agents}));
    EXPECT_EQ(result.exit_code, 2) << agents;
    EXPECT_THAT(result.error, HasSubstr(message));
  }
  const ProgramResult rate =
      CallSkein(Command({"--agents", "zero", "--set", "env.action_repeat=2"}));
  EXPECT_THAT(rate.error, HasSubstr("env.action_repeat cannot be set here"));
  const std::string file = scratch_ / "same";
  const ProgramResult twice =
      CallSkein(Command({"--agents", "zero", "--csv", file, "--json", file}));
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.error, HasSubstr(file + ": two results would go there"));
  const ProgramResult trained = CallSkein(Command({"--agents", "zero", "--set", "ppo.epochs=3"}));
  EXPECT_THAT(trained.error, HasSubstr("--set ppo.epochs=3: is for trainings"));
  EXPECT_EQ(CallSkein({"compare", "--task", "heading"}).exit_code, 2) << "no agents";
  const ProgramResult no_task = CallSkein({"compare", "--agents", "zero"});
  EXPECT_EQ(no_task.exit_code, 2);
  EXPECT_THAT(no_task.error, HasSubstr("--task is needed: no agent is a policy that says its own"));
}

TEST_F(ComparisonPipeline, PoliciesSayTheTask) {
  const std::string json = scratch_ / "result.json";
  const auto compare = [&](const std::string& agents) {
    return CallSkein({"compare", "--agents", agents, "--episodes", "2", "--no-html", "--json", json,
                      "--set", "env.time_limit_steps=100"});
  };
  const std::string shipped = std::string("policy:") + SKEIN_SOURCE "/policies/";
  const ProgramResult result = compare("zero," + shipped + "control.skein");
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_EQ(nlohmann::json::parse(ReadFile(json))["task"], "control");
  // The first one's, which the other does not fly.
  const ProgramResult two = compare(shipped + "control.skein," + shipped + "tracking.skein");
  EXPECT_EQ(two.exit_code, 2);
  EXPECT_THAT(two.error, HasSubstr("env.task = tracking, but is to fly with env.task = control"));
}

TEST_F(ComparisonPipeline, NamesOfAgentsMayHaveBlanksAround) {
  const nlohmann::json result = Compare(" zero,\t random:0.2 \n");
  EXPECT_EQ(result["agents"][0]["name"], "zero");
  EXPECT_EQ(result["agents"][1]["name"], "random:0.2");
}

TEST_F(ComparisonPipeline, PathsOfPoliciesMayHaveCommasAndEndAsSuffixes) {
  const std::string commas = "policy:" + (scratch_ / "a, b,c.skein");
  const std::string sampled = "policy:" + (scratch_ / "run@sampled");
  const std::string drawn = sampled + "@sampled";
  // What stands before the first comma is near another policy.
  const std::string near = "policy:" + (scratch_ / "a.skein");
  for (const std::string& policy : {commas, sampled, near}) {
    std::filesystem::copy_file(SKEIN_SOURCE "/policies/heading.skein", policy.substr(7));
  }
  const nlohmann::json agents = Compare("zero," + commas + "," + sampled + "," + drawn)["agents"];
  ASSERT_EQ(agents.size(), 4u);
  EXPECT_EQ(agents[1]["name"], commas);
  EXPECT_EQ(agents[2]["name"], sampled);
  // The mean action: the same flights as by the other.
  EXPECT_EQ(agents[1]["return_mean"], agents[2]["return_mean"]);
  EXPECT_NE(agents[1]["return_mean"], agents[3]["return_mean"]);
  for (const char* list : {"zero,,random", "zero,", ""}) {
    EXPECT_EQ(CallSkein(Command({"--agents", list})).exit_code, 2) << list;
  }
}

TEST_F(ComparisonPipeline, SuffixesOfPoliciesAreKnownInEitherOrder) {
  const std::string policy = scratch_ / "a@home.skein";
  std::filesystem::copy_file(SKEIN_SOURCE "/policies/heading.skein", policy);
  const auto refused = [](const std::string& agent) {
    const ProgramResult result = CallSkein(Command({"--agents", agent}));
    EXPECT_EQ(result.exit_code, 2) << agent;
    return result.error;
  };
  EXPECT_THAT(refused("policy:" + policy + "@sampeld"),
              HasSubstr("@sampeld: unknown suffix @sampeld; did you mean @sampled?; known: "
                        "@sampled, @other-aircraft"));
  EXPECT_THAT(refused("policy:" + policy + "@foo@sampled"),
              HasSubstr("unknown suffix @foo; known"));
  EXPECT_THAT(refused("policy:" + (scratch_ / "absent@home.skein")), HasSubstr("No such file"));
  const std::string suffixed = "policy:" + policy + "@other-aircraft@sampled";
  EXPECT_EQ(Compare(suffixed)["agents"][0]["name"], suffixed);
}

}  // namespace
}  // namespace skein
