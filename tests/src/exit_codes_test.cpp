// SPDX-License-Identifier: Apache-2.0
// The law of exit codes in docs/reference/commands.md, over all commands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "envs/aircraft/registry.h"
#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Commands that read `path`, each by another option or argument.
std::vector<std::vector<std::string>> ReadersOf(const std::string& path, const std::string& out) {
  const std::vector<std::string> trim = {"--altitude-ft", "15000", "--speed-fps", "500"};
  std::vector<std::vector<std::string>> readers = {
      {"train", path + ".toml"},
      {"train", "heading", "--config", path},
      {"train", "heading", "--aircraft", path + ".json"},
      {"train", "heading", "--from", path},
      {"train", "heading", "--resume", path},
      {"train", "tracking", "--preset", "planner", "--low-level", path},
      {"eval", "--policy", path, "--task", "heading"},
      {"eval", "--policy", "untrained", "--task", path + ".toml"},
      {"eval", "--policy", "untrained", "--task", "heading", "--config", path},
      {"eval", "--policy", "untrained", "--task", "heading", "--aircraft", path + ".json"},
      {"eval", "--policy", "untrained", "--task", "tracking", "--low-level", path},
      {"compare", "--task", "heading", "--no-html", "--agents", "policy:" + path},
      {"replay", "--policy", path, "-o", out + ".acmi"},
      {"replay", "--task", "heading", "--agents", "policy:" + path, "-o", out + ".acmi"},
      {"study", path, "--out", out},
      {"plot", "space", path, "-o", out + ".svg"},
      {"plot", "tracks", "--policy", path, "-o", out + ".svg"},
      {"plot", "flights", path, "-o", out + ".svg"},
      {"plot", "curves", path, "-o", out + ".svg"},
      {"plot", "curves", path, "--comparison", path, "-o", out + ".svg"},
      {"report", path},
      {"fdm", "eval", "--in", path, "--out", out},
      {"fdm", "simulate", "--in", path, "--out", out},
      {"aircraft", "check", path + ".json"},
      {"aircraft", "tune", path + ".json"},
      {"export", path, "--format", "c", "-o", out},
      {"export", "--flight-control", "c", "--aircraft", path + ".json", "-o", out},
      {"bench", "compare", path, path},
      {"bench", "sim", "--aircraft", path + ".json"},
      {"bench", "iteration", "--task", "tracking", "--preset", "planner", "--low-level", path}};
  for (std::vector<std::string> words :
       std::vector<std::vector<std::string>>{{"fdm", "trim", "--aircraft", path + ".json"},
                                             {"fdm", "linearise", "--aircraft", path + ".json"},
                                             {"fdm", "sweep", "--aircraft", path + ".json"},
                                             {"fdm", "fly", "-o", out, "--commands", path}}) {
    words.insert(words.end(), trim.begin(), trim.end());
    readers.push_back(words);
  }
  return readers;
}

TEST(ExitCodes, APathThatIsNotThereIsWrongUsageInEveryCommand) {
  const ScratchDirectory scratch;
  for (const auto& arguments : ReadersOf(scratch / "absent", scratch / "out")) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.error;
    EXPECT_THAT(result.error, HasSubstr(scratch / "absent"));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
  EXPECT_TRUE(fs::is_empty(scratch.path()));
}

TEST(ExitCodes, AFolderWithoutARunIsWrongUsageInEveryCommand) {
  const ScratchDirectory scratch;
  const std::string folder = scratch / "folder";
  for (const char* ending : {"", ".toml", ".json"}) fs::create_directory(folder + ending);
  for (const auto& arguments : ReadersOf(folder, scratch / "out")) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.error;
    EXPECT_THAT(result.error, HasSubstr(folder));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
}

TEST(ExitCodes, AnOutputWhoseFolderIsNotThereIsWrongUsageInEveryCommand) {
  const ScratchDirectory scratch;
  const std::string out = scratch / "absent/file";
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"info", "--json", out},
           {"eval", "--policy", "untrained", "--task", "heading", "--json", out},
           {"compare", "--task", "heading", "--agents", "zero", "--csv", out},
           {"replay", "--task", "heading", "--agents", "zero", "-o", out + ".csv"},
           {"plot", "tracks", "--task", "heading", "--agents", "zero", "-o", out + ".svg"},
           {"fdm", "trim", "--altitude-ft", "0", "--speed-fps", "500", "--json", out},
           {"fdm", "fly", "--altitude-ft", "0", "--speed-fps", "500", "-o", out},
           {"fdm", "eval", "--in", "x", "--out", out},
           {"aircraft", "tune", "cessna172", "-o", out},
           {"export", "--flight-control", "c", "-o", out},
           {"bench", "sim", "--json", out}}) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.error;
    EXPECT_THAT(result.error, HasSubstr("cannot be written"));
  }
}

/// Commands that read one of these files and would write over it.
std::vector<std::pair<std::vector<std::string>, std::string>> ReplacersOf(
    const ScratchDirectory& scratch) {
  const std::string policy = scratch / "policy.skein", task = scratch / "task.toml",
                    config = scratch / "config.toml", aircraft = scratch / "aircraft.json",
                    sticks = scratch / "sticks.csv", points = scratch / "points.json",
                    link = scratch / "link", drawing = scratch / "link.svg",
                    own = scratch / "own.toml", own_task = scratch / "own_task.toml";
  fs::copy_file(SKEIN_SOURCE "/policies/heading.skein", policy);
  fs::copy_file(SKEIN_SOURCE "/examples/tasks/heading.toml", task);
  WriteFile(config, "[env]\nobservation_noise = 0.02\n");
  WriteFile(aircraft, AircraftText("f16"));
  WriteFile(own, "[env]\naircraft = \"aircraft.json\"\n");
  WriteFile(own_task, ReadFile(SKEIN_SOURCE "/examples/tasks/bank_and_altitude.toml") +
                          "[env]\naircraft = \"aircraft.json\"\n");
  WriteFile(sticks, "time_s,pitch\n0,0.1\n");
  WriteFile(points, "{}");
  fs::create_symlink(policy, link);
  fs::create_symlink(sticks, drawing);
  const std::string agent = "policy:" + policy;
  std::vector<std::pair<std::vector<std::string>, std::string>> replacers = {
      {{"export", policy, "--format", "c", "-o", policy}, policy},
      {{"export", policy, "--format", "c", "-o", link}, policy},
      {{"export", "--flight-control", "c", "--aircraft", aircraft, "-o", aircraft}, aircraft},
      {{"eval", "--policy", policy, "--json", policy}, policy},
      {{"eval", "--policy", link, "--acmi", policy}, policy},
      {{"eval", "--policy", policy, "--task", task, "--json", task}, task},
      {{"eval", "--policy", policy, "--config", config, "--flights", config}, config},
      {{"eval", "--policy", policy, "--aircraft", aircraft, "--json", aircraft}, aircraft},
      {{"eval", "--policy", policy, "--set", "env.aircraft=" + aircraft, "--json", aircraft},
       aircraft},
      {{"compare", "--agents", agent, "--no-html", "--set", "env.aircraft = '" + aircraft + "'",
        "--csv", aircraft},
       aircraft},
      {{"compare", "--task", "heading", "--no-html", "--agents", agent, "--csv", policy}, policy},
      {{"compare", "--agents", agent, "--config", config, "--html", config}, config},
      {{"eval", "--policy", policy, "--config", own, "--json", aircraft}, aircraft},
      {{"compare", "--agents", agent, "--config", own, "--no-html", "--csv", aircraft}, aircraft},
      {{"compare", "--agents", "zero", "--task", own_task, "--json", aircraft}, aircraft},
      {{"bench", "rollout", "--task", own_task, "--json", aircraft}, aircraft},
      {{"replay", "--policy", policy, "--format", "csv", "-o", policy}, policy},
      {{"replay", "--agents", agent, "--config", config, "--format", "acmi", "-o", config}, config},
      {{"fdm", "eval", "--in", points, "--out", points}, points},
      {{"fdm", "simulate", "--in", points, "--out", points}, points},
      {{"plot", "flights", sticks, "-o", drawing}, sticks},
      {{"bench", "compare", points, points, "--json", points}, points},
      {{"bench", "rollout", "--task", task, "--json", task}, task}};
  for (std::vector<std::string> words : std::vector<std::vector<std::string>>{
           {"fdm", "trim", "--aircraft", aircraft, "--json", aircraft},
           {"fdm", "linearise", "--aircraft", aircraft, "--json", aircraft},
           {"fdm", "sweep", "--aircraft", aircraft, "--json", aircraft},
           {"fdm", "fly", "--commands", sticks, "-o", sticks},
           {"fdm", "fly", "--policy", policy, "-o", policy}}) {
    const std::string replaced = words.back();
    words.insert(words.end(), {"--altitude-ft", "15000", "--speed-fps", "500"});
    replacers.emplace_back(words, replaced);
  }
  return replacers;
}

TEST(ExitCodes, AnOutputThatIsReadIsWrongUsageInEveryCommandAndStays) {
  const ScratchDirectory scratch;
  for (const auto& [arguments, file] : ReplacersOf(scratch)) {
    const std::string before = ReadFile(file);
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments[0] << " " << arguments[1] << result.error;
    EXPECT_THAT(result.error, HasSubstr(": is read, too; choose another output"));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
    EXPECT_EQ(ReadFile(file), before) << arguments[0];
  }
}

TEST(ExitCodes, AnOutputThatEndsAsAnotherFormatIsWrongUsageInEveryCommand) {
  const ScratchDirectory scratch;
  const std::string csv = scratch / "out.csv", json = scratch / "out.json",
                    svg = scratch / "out.svg";
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"info", "--json", csv},
           {"eval", "--policy", "untrained", "--task", "heading", "--json", csv},
           {"eval", "--policy", "untrained", "--task", "heading", "--flights", json},
           {"eval", "--policy", "untrained", "--task", "heading", "--acmi", csv},
           {"compare", "--task", "heading", "--agents", "zero", "--csv", json},
           {"compare", "--task", "heading", "--agents", "zero", "--html", json},
           {"replay", "--task", "heading", "--agents", "zero", "--format", "acmi", "-o", csv},
           {"fdm", "trim", "--altitude-ft", "0", "--speed-fps", "500", "--json", svg},
           {"fdm", "trim", "--altitude-ft", "0", "--speed-fps", "500,600", "--csv", svg},
           {"fdm", "linearise", "--altitude-ft", "0", "--speed-fps", "500", "--json", svg},
           {"fdm", "sweep", "--altitude-ft", "0", "--speed-fps", "500", "--json", svg},
           {"fdm", "eval", "--in", SKEIN_SOURCE "/tests/data/golden.json", "--out", csv},
           {"export", SKEIN_SOURCE "/policies/heading.skein", "--format", "c", "-o", json},
           {"export", SKEIN_SOURCE "/policies/heading.skein", "--format", "torchscript", "-o", csv},
           {"export", "--flight-control", "c", "-o", json},
           {"aircraft", "tune", SKEIN_SOURCE "/data/aerosonde/aircraft.json", "-o", csv},
           {"bench", "sim", "--json", csv}}) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments[0] << " " << arguments[1];
    EXPECT_THAT(result.error, HasSubstr(arguments.back() + ": "));
    EXPECT_THAT(result.error, HasSubstr(": let the name end in ."));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
    EXPECT_EQ(result.output, "");
    EXPECT_FALSE(fs::exists(arguments.back()));
  }
}

// The manifest of a high-level policy is called after its output.
TEST(ExitCodes, NoFileThatACommandNamesItselfIsOneThatIsRead) {
  const ScratchDirectory scratch;
  const std::string aircraft = scratch / "planner.json";
  WriteFile(aircraft, AircraftText("f16"));
  const ProgramResult result = CallSkein({"export", SKEIN_SOURCE "/policies/tracking-planner.skein",
                                          "--aircraft", aircraft, "-o", scratch / "planner.h"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.error, HasSubstr(aircraft + ": is read, too"));
  EXPECT_EQ(ReadFile(aircraft), AircraftText("f16"));
}

TEST(ExitCodes, WhatIsAskedOfFilesThatDoNotFitIsWrongUsage) {
  const ScratchDirectory scratch;
  const std::string heading = SKEIN_SOURCE "/policies/heading.skein", file = scratch / "file",
                    flights = scratch / "flights.csv", study = scratch / "study.toml",
                    sim = scratch / "sim.json", update = scratch / "update.json",
                    elsewhere = scratch / "elsewhere.json";
  WriteFile(file, "");
  WriteFile(flights, "episode,time_s,action_roll,termination\n0,0,0,\n0,1,0,crash\n");
  WriteFile(study,
            "tasks = [\"heading\"]\nseeds = [1]\n[training]\nsteps = 64\n"
            "set = [\"ppo.num_aircraft=64\"]\n");
  WriteFile(sim, R"({"benchmark": "sim", "machine": {"cpu": "one"}, "figures": {}})");
  WriteFile(update, R"({"benchmark": "update", "machine": {"cpu": "one"}, "figures": {}})");
  WriteFile(elsewhere, R"({"benchmark": "sim", "machine": {"cpu": "other"}, "figures": {}})");
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"bench", "compare", sim, update},
       "cannot be compared: benchmark is sim in one and update in the other"},
      {{"bench", "compare", sim, elsewhere}, "--other-machine compares them all the same"},
      {{"train", "tracking", "--preset", "planner", "--low-level", heading, "--out",
        scratch / "run"},
       "a policy of task heading"},
      {{"compare", "--task", "heading", "--agents", "zero", "--csv", file, "--json", file},
       "two results would go there"},
      {{"plot", "flights", flights, "--columns", "nope", "-o", scratch / "out.svg"},
       "no column nope; there are episode"},
      {{"plot", "flights", flights, "--columns", "action_nope", "-o", scratch / "out.svg"},
       "no column action_nope"},
      {{"study", study, "--out", file}, "is neither a study nor an empty directory"},
      {{"eval", "--policy", heading, "--set", "env.control_interval_s=0.01"},
       "env.control_interval_s = 0.02, but is to fly with"},
      {{"eval", "--policy", heading, "--aircraft", "cessna172", "--preset", "cessna172"},
       "env.aircraft = f16, but is to fly with env.aircraft = cessna172"}};
  for (const auto& [arguments, message] : wrong) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 2) << message;
    EXPECT_THAT(result.error, HasSubstr(message));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
  EXPECT_FALSE(fs::exists(scratch / "run"));
}

TEST(ExitCodes, AFlightThatCannotBeginIsWrongUsageInEveryCommand) {
  const ScratchDirectory scratch;
  const std::string csv = scratch / "out.csv";
  struct Case {
    std::vector<std::string> start;
    std::string message;
    std::vector<std::vector<std::string>> commands;
  };
  const std::vector<std::vector<std::string>> of_environments = {
      {"train", "heading", "--out", scratch / "run"},
      {"eval", "--policy", "untrained", "--task", "heading", "--episodes", "1"},
      {"compare", "--no-html", "--task", "heading", "--agents", "zero", "--episodes", "1"},
      {"replay", "-o", csv, "--task", "heading", "--agents", "zero", "--episodes", "1"}};
  const std::vector<Case> cases = {
      {{"--altitude-ft", "20000", "--speed-fps", "60"},
       "this flight is below stall speed",
       {{"fdm", "trim"},
        {"fdm", "linearise"},
        {"fdm", "sweep"},
        {"fdm", "fly", "-o", csv},
        {"fdm", "fly", "-o", csv, "--task", "heading", "--agents", "zero"}}},
      {{"--altitude-ft", "20000", "--speed-fps", "1000", "--flight-path-deg", "90"},
       "no steady flight found",
       {{"fdm", "trim"}, {"fdm", "sweep"}}},
      {{"--altitude-ft", "20000", "--speed-fps", "60,70"},
       "there is no steady flight at any of these points",
       {{"fdm", "linearise"}, {"fdm", "sweep"}}},
      {{"--set", "env.initial.true_airspeed_min_fps=60", "--set", "env.termination.min_mach=0"},
       "flights cannot begin in all of env.initial",
       of_environments},
      {{"--set", "env.termination.max_mach=0.9"},
       "is Mach 1.16, beyond env.termination.max_mach",
       of_environments}};
  for (const Case& given : cases) {
    for (std::vector<std::string> arguments : given.commands) {
      arguments.insert(arguments.end(), given.start.begin(), given.start.end());
      const ProgramResult result = CallSkein(arguments);
      EXPECT_EQ(result.exit_code, 2) << arguments[0] << " " << arguments[1] << result.error;
      EXPECT_THAT(result.error, HasSubstr(given.message));
    }
  }
  EXPECT_TRUE(fs::is_empty(scratch.path()));
}

TEST(ExitCodes, AFileThatIsDamagedIsAFailure) {
  const ScratchDirectory scratch;
  const std::string damaged = scratch / "damaged";
  WriteFile(damaged, "GIF89a");
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"eval", "--policy", damaged, "--task", "heading"},
           {"train", "heading", "--from", damaged},
           {"compare", "--task", "heading", "--no-html", "--agents", "policy:" + damaged},
           {"plot", "flights", damaged, "-o", scratch / "out.svg"},
           {"fdm", "eval", "--in", damaged, "--out", scratch / "out"},
           {"bench", "compare", damaged, damaged},
           {"plot", "curves", scratch / "run", "--comparison", damaged, "-o", scratch / "out.svg"},
           {"export", damaged, "--format", "c", "-o", scratch / "out"}}) {
    EXPECT_EQ(CallSkein(arguments).exit_code, 1) << arguments[0];
  }
}

// The kernel's file of a process's memory is there, and its first byte cannot be read, whoever
// asks.
TEST(ExitCodes, AFileThatIsThereAndCannotBeReadIsAFailure) {
  const ScratchDirectory scratch;
  const std::string unreadable = scratch / "unreadable";
  for (const char* ending : {"", ".toml", ".json"}) {
    fs::create_symlink("/proc/self/mem", unreadable + ending);
  }
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"study", unreadable, "--out", scratch / "out"},
           {"train", unreadable + ".toml"},
           {"train", "heading", "--config", unreadable},
           {"train", "heading", "--aircraft", unreadable + ".json"},
           {"eval", "--policy", "untrained", "--task", "heading", "--config", unreadable},
           {"fdm", "eval", "--in", unreadable, "--out", scratch / "out"}}) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 1) << result.error;
    EXPECT_THAT(result.error, HasSubstr(unreadable));
    EXPECT_THAT(result.error, HasSubstr("cannot be read"));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
}

TEST(ExitCodes, ASimdTargetThatIsNotThereIsWrongUsage) {
  const ProgramResult result = RunSkein({"bench", "sim"}, [] { setenv("SKEIN_SIMD", "foo", 1); });
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.error.rfind("skein: error: SKEIN_SIMD: unknown SIMD target \"foo\"", 0), 0u);
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
}

TEST(ExitCodes, WhatIsTypedWronglyIsSaidInTheProgramsOwnWords) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"fdm"}, "a command is needed: trim, linearise, sweep, fly, eval, simulate"},
      {{"eval"}, "--policy is required"},
      {{"plot", "curves"}, "RUN... is required"},
      {{"eval", "--policy"}, "--policy needs a value"},
      {{"train", "heading", "control"}, "unexpected argument control"},
      {{"train", "heading", "--help-keys=foo"},
       "--help-keys=foo: give --help-keys or --help-keys=markdown"},
      {{"eval", "policies/heading.skein"},
       "unexpected argument policies/heading.skein; did you mean --policy policies/heading.skein?"},
      {{"eval", "heading"}, "unexpected argument heading; did you mean --task heading?"},
      {{"eval", "--policy", SKEIN_SOURCE "/policies/heading"},
       SKEIN_SOURCE "/policies/heading: no such file or run; did you mean " SKEIN_SOURCE
                    "/policies/heading.skein?"},
      {{"eval", "--policy", SKEIN_SOURCE "/policies/heding.skein"},
       SKEIN_SOURCE "/policies/heding.skein: no such file or run; did you mean " SKEIN_SOURCE
                    "/policies/heading.skein?"},
      {{"eval", "--policy", "x.skein", "--json", "--sampled"},
       "--json: a value is missing before --sampled (see skein eval --help)"},
      {{"fdm", "fly", "--commands", "-o", "x.csv"},
       "--commands: a value is missing before -o (see skein fdm fly --help)"},
      {{"compare", "a.skein"},
       "unexpected argument a.skein; did you mean --agents policy:a.skein?"},
      {{"compare", "--policy", "a.skein"},
       "unknown option --policy; did you mean --agents policy:FILE_OR_RUN? (see skein compare"},
      {{"eval", "--policy=a.skein", "--agents=zero"},
       "unknown option --agents=zero; it flies one --policy, and skein compare several agents"},
      {{"plot", "flights", "a.skein"}, "a.skein: not a file of flights; did you mean --policy"},
      {{"list", "pilots"}, "what: unknown pilots; known: tasks, presets"},
      {{"bench", "sim", "--set", "env.action_repeat=5"},
       "--set env.action_repeat=5: here that is --action-repeat"},
      {{"bench", "compare", "a,b", "c"}, "2 runs before and 1 run after: as many are needed"},
      {{"fdm", "trim", "--altitude-ft", "0,5000", "--speed-fps", "500", "--polar", "x.svg"},
       "--polar is for several speeds"},
      {{"fdm", "trim", "--altitude-ft", "0,5000", "--speed-fps", "500", "--picture", "x.svg"},
       "--picture is for several altitudes and several speeds"},
      {{"plot", "curves", "x", "--width", "1"}, "--width: '1' is not a number in [2.5 - 60]"},
      {{"plot", "curves", "x", "--width", "wide"}, "--width: 'wide' is not a number in"},
      {{"fdm", "eval", "--in", "x", "--out", "y", "--precision", "float"},
       "--precision: unknown float; did you mean float32?; known: float32, float64"},
      {{"fdm", "trim", "--altitude-ft", "0", "--speed-fps", "500", "--aircraft", "f17"},
       "unknown aircraft \"f17\"; did you mean f16?; known: aerosonde, cessna172, f16"},
      {{"train", "heading", "--aircraft", "f17"},
       "unknown aircraft \"f17\"; did you mean f16?; known: aerosonde, cessna172, f16"},
      {{"aircraft", "tune", "f17"},
       "unknown aircraft \"f17\"; did you mean f16?; known: aerosonde, cessna172, f16"}};
  for (const auto& [arguments, message] : wrong) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 2) << message;
    EXPECT_EQ(result.error.rfind("skein: error: " + message, 0), 0u) << result.error;
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
}

}  // namespace
}  // namespace skein
