// SPDX-License-Identifier: Apache-2.0
// The command line: help, what is refused, and the commands without a pipeline of their own.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "simd/target.h"
#include "src/config/presets.h"
#include "src/files/output_file.h"
#include "tests/sanitizers.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"
#include "train/network/backend.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

std::string Sorted(std::string text) {
  std::sort(text.begin(), text.end());
  return text;
}

TEST(Usage, EveryCommandHasHelp) {
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{},
                                             {"train"},
                                             {"eval"},
                                             {"compare"},
                                             {"study"},
                                             {"fdm"},
                                             {"fdm", "trim"},
                                             {"fdm", "linearise"},
                                             {"fdm", "sweep"},
                                             {"fdm", "fly"},
                                             {"aircraft"},
                                             {"aircraft", "check"},
                                             {"aircraft", "tune"},
                                             {"fdm", "eval"},
                                             {"fdm", "simulate"},
                                             {"export"},
                                             {"bench"},
                                             {"bench", "sim"},
                                             {"bench", "rollout"},
                                             {"bench", "update"},
                                             {"bench", "signature"},
                                             {"list"},
                                             {"info"},
                                             {"completion"},
                                             {"man"},
                                             {"help"}}) {
    std::vector<std::string> arguments = command;
    arguments.push_back("--help");
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output, HasSubstr("Usage: skein"));
    EXPECT_EQ(result.error, "");
    if (command == std::vector<std::string>{"help"}) continue;
    std::vector<std::string> words = {"help"};
    words.insert(words.end(), command.begin(), command.end());
    // But for the order of the options that one excludes, which is that of their addresses.
    EXPECT_EQ(Sorted(CallSkein(words).output), Sorted(result.output));
  }
}

/// Processor time of the program, s: the shortest of some runs.
double ProcessorTimeOf(const char* argument) {
  constexpr int kRuns = 5;
  const auto children_s = [] {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  };
  double shortest = 1e9;
  for (int i = 0; i < kRuns; ++i) {
    const double before = children_s();
    EXPECT_EQ(RunSkein({argument}).exit_code, 0);
    shortest = std::min(shortest, children_s() - before);
  }
  return shortest;
}

TEST(Usage, HelpAndVersionComeAtOnce) {
  if (kIsSanitized) GTEST_SKIP() << "sanitizers take their time";
  constexpr double kAtOnce_s = 0.03;
  EXPECT_LT(ProcessorTimeOf("--help"), kAtOnce_s);
  EXPECT_LT(ProcessorTimeOf("--version"), kAtOnce_s);
}

TEST(Usage, VersionNamesTheCommitAndTheBuild) {
  const ProgramResult result = CallSkein({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, testing::MatchesRegex(
                                 "skein [0-9]+\\.[0-9]+\\.[0-9]+ \\(commit "
                                 "([0-9a-f]{10,}(-dirty(-[0-9a-f]{10})?)?|unknown), .+, .+\\)\n"));
}

TEST(Usage, ListNamesWhatThereIs) {
  const auto list = [](const std::string& what) {
    const ProgramResult result = CallSkein({"list", what});
    EXPECT_EQ(result.exit_code, 0) << result.error;
    return result.output;
  };
  EXPECT_THAT(list("tasks"), HasSubstr("heading   altitude_ft, yaw_deg, true_airspeed_fps"));
  EXPECT_THAT(list("presets"), ContainsRegex("heading  +quick +25.0 M +Heading in minutes"));
  EXPECT_THAT(list("conditions"), HasSubstr("60fps,light"));
  EXPECT_THAT(list("aircraft"), HasSubstr("aerosonde"));
  EXPECT_THAT(list("agents"), HasSubstr("zero "));
  const ProgramResult all = CallSkein({"list"});
  for (const char* what : {"tasks", "presets", "conditions", "policies", "runs", "agents"}) {
    EXPECT_THAT(all.output, HasSubstr(list(what))) << what;
  }
  EXPECT_EQ(CallSkein({"list", "pilots"}).exit_code, 2);
}

TEST(Usage, ListSaysWhichFilesAreNoPolicies) {
  const ScratchDirectory scratch;
  fs::create_directory(scratch / "policies");
  WriteFile(scratch / "policies/broken.skein", "no policy");
  const ProgramResult result =
      RunSkein({"list", "policies"}, [&] { fs::current_path(scratch.path()); });
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("policies/broken.skein  "));
}

TEST(Usage, HelpSaysWhatAutopilotAloneMeans) {
  for (const char* command : {"compare", "eval", "train"}) {
    EXPECT_THAT(CallSkein({command, "--help"}).output,
                HasSubstr("autopilot means autopilot:aggressive"));
  }
}

TEST(Usage, HelpNamesEveryPresetAndNoOther) {
  std::string help = CallSkein({"train", "--help"}).output;
  const std::string begin = "named configuration: ";
  const std::size_t at = help.find(begin);
  ASSERT_NE(at, std::string::npos);
  help = help.substr(at + begin.size(), help.find("; skein list", at) - at - begin.size());
  std::set<std::string> named, known;
  std::istringstream parts(help);
  for (std::string part; std::getline(parts, part, ',');) {
    std::istringstream words(part);
    std::string name, meaning;
    words >> name >> meaning;
    named.insert(name);
    EXPECT_EQ(meaning.substr(0, 1), "(") << name << " has no meaning";
  }
  for (const Preset& preset : Presets()) known.insert(preset.name);
  EXPECT_EQ(named, known);
}

TEST(Usage, HelpSaysWhereATaskFileCanBeFlown) {
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"train"}, {"eval"}, {"compare"}, {"replay"}, {"plot", "space"}, {"fdm", "fly"}}) {
    std::vector<std::string> arguments = command;
    arguments.push_back("--help");
    EXPECT_THAT(CallSkein(arguments).output,
                HasSubstr("what to fly: control, heading, tracking, or a task file, FILE.toml"));
  }
}

TEST(Usage, WhereTheReportGoesHasTheNameThatItHasElsewhere) {
  for (const char* option : {"-o", "--output", "--out"}) {
    const ProgramResult result = CallSkein({"report", "absent", option, "page.html"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.error, HasSubstr("absent: not the directory of a run")) << option;
  }
}

TEST(Usage, WrongUsageExitsWithTwoAndOneLine) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {},
           {"fly"},
           {"train"},
           {"train", "heading", "--stpes", "5"},
           {"train", "heading", "--steps", "many"},
           {"train", "heading", "--threads", "0"},
           {"train", "heading", "--out", ""},
           {"train", "--resume", ""},
           {"eval"},
           {"eval", "--policy", ""},
           {"eval", "--policy", "untrained", "--task", "heading", "--json="},
           {"eval", "--policy", "x", "--task", "heading", "--episodes", "0"},
           {"eval", "--policy", "untrained", "--task", "heading", "--seed", "-3"},
           {"--bogus"},
           {"fdm", "eval", "--in", "x"},
           {"fdm", "eval", "--in", "x", "--out", "y", "--precision", "float16"},
           {"bench"}}) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.error;
    EXPECT_EQ(result.error.rfind("skein: error: ", 0), 0u) << result.error;
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
    EXPECT_THAT(result.error, HasSubstr("--help"));
  }
}

TEST(Usage, AskingForWhatCannotBeExitsWithTwo) {
  const std::string shipped = SKEIN_SOURCE "/policies/heading.skein";
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"train", "heding"},
           {"train", "heading", "--preset", "fast"},
           {"train", "heading", "--set", "ppo.gama=1"},
           {"train", "heading", "--set", "ppo.gamma=2"},
           {"train", "heading", "--condition", "rainy=mild"},
           {"train", "heading", "--condition", "windy=often"},
           {"train", "heading", "--low-level", "autopilot"},
           {"train", "tracking", "--low-level", "autopilot"},
           {"train", "tracking", "--preset", "planner"},
           {"train", "tracking", "--preset", "planner", "--low-level", "autopilot:lazy"},
           {"eval", "--policy", "untrained"},
           {"eval", "--policy", "untrained", "--task", "heading", "--set", "ppo.epochs=3"},
           {"compare", "--task", "heading", "--agents", "ace"},
           {"compare", "--task", "heading", "--agents", "zero,zero"},
           {"compare", "--task", "heading", "--agents", "zero", "--no-html", "--flights-count",
            "2"},
           {"export", shipped, "--format", "c", "--aircraft", "cessna172", "-o", "/dev/null"},
           {"bench", "sim", "--set", "nonsense"},
           {"help", "fly"}}) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.error;
    EXPECT_EQ(result.error.rfind("skein: error: ", 0), 0u) << result.error;
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
}

/// What bash would complete the words with, the last of them being typed.
std::string Completed(const ScratchDirectory& scratch, const std::vector<std::string>& words) {
  const std::string script = scratch / "complete.bash";
  std::string text = CallSkein({"completion", "bash"}).output + "COMP_WORDS=(";
  for (const std::string& word : words) text += "'" + word + "' ";
  WriteFile(script, text + ")\nCOMP_CWORD=" + std::to_string(words.size() - 1) +
                        "\n_skein\necho \"${COMPREPLY[*]}\" > " + (scratch / "found"));
  EXPECT_EQ(std::system(("bash " + script).c_str()), 0);
  return ReadFile(scratch / "found");
}

TEST(Usage, BashCompletesCommandsOptionsAndValues) {
  const ScratchDirectory scratch;
  EXPECT_EQ(Completed(scratch, {"skein", "tr"}), "train\n");
  EXPECT_EQ(Completed(scratch, {"skein", "fdm", "tr"}), "trim\n");
  EXPECT_EQ(Completed(scratch, {"skein", "train", "heading", "--res"}), "--resume\n");
  EXPECT_EQ(Completed(scratch, {"skein", "train", "he"}), "heading\n");
  EXPECT_EQ(Completed(scratch, {"skein", "train", "heading", "--preset", "pa"}), "paper\n");
  EXPECT_EQ(Completed(scratch, {"skein", "fdm", "trim", "--aircraft", "aero"}), "aerosonde\n");
  EXPECT_EQ(Completed(scratch, {"skein", "list", "pol"}), "policies\n");
  EXPECT_EQ(Completed(scratch, {"skein", "help", "tr"}), "train\n");
  EXPECT_EQ(Completed(scratch, {"skein", "train", "--config", "x"}), "\n") << "a file's name";
  for (const char* name : {"-o", "--output", "--out"}) {
    EXPECT_EQ(Completed(scratch, {"skein", "report", name, "-"}), "\n") << "a file's name";
  }
}

TEST(Usage, EveryShellHasACompletionScriptOfEveryOption) {
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const ProgramResult result = CallSkein({"completion", shell});
    EXPECT_EQ(result.exit_code, 0);
    for (const char* word : {"trim", "signature", "resume", "flights-count"}) {
      EXPECT_THAT(result.output, HasSubstr(word)) << shell;
    }
  }
  EXPECT_EQ(CallSkein({"completion", "tcsh"}).exit_code, 2);
}

TEST(Usage, TheManualIsARoffPageOfAllCommands) {
  const ScratchDirectory scratch;
  const ProgramResult result = CallSkein({"man"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.output.rfind(".TH SKEIN 1 ", 0), 0u);
  for (const char* part : {".SS skein fdm trim\n", "\\fB\\-\\-resume\\fR", ".SH EXIT STATUS\n"}) {
    EXPECT_THAT(result.output, HasSubstr(part));
  }
  if (std::system("command -v groff > /dev/null") != 0) GTEST_SKIP() << "no groff to read it";
  const std::string page = scratch / "skein.1", complaints = scratch / "complaints";
  WriteFile(page, result.output);
  EXPECT_EQ(std::system(("groff -man -ww -z " + page + " 2> " + complaints).c_str()), 0);
  EXPECT_EQ(ReadFile(complaints), "");
}

TEST(Usage, OldNamesAreErrorsThatSayTheNewOnes) {
  EXPECT_THAT(CallSkein({"train", "tracking", "--controller", "x"}).error,
              HasSubstr("unknown option --controller; it is now called --low-level"));
  EXPECT_THAT(CallSkein({"compare", "--task", "heading", "--agents", "idle"}).error,
              HasSubstr("agent idle is now called zero"));
}

TEST(Usage, FlagsAreNamedInTheirErrors) {
  EXPECT_THAT(CallSkein({"train", "heading", "--steps", "0"}).error,
              HasSubstr("--steps: '0' is not a whole number in [1 - 9007199254740991]"));
  EXPECT_THAT(CallSkein({"train", "heading", "--steps", "nan"}).error, HasSubstr("--steps"));
  EXPECT_THAT(CallSkein({"train", "heading", "--seed", "-1"}).error,
              HasSubstr("--seed: '-1' is not a whole number in [0 - 9007199254740991]"));
  // 2^53 + 1, which would be read as 2^53.
  EXPECT_THAT(CallSkein({"train", "heading", "--seed", "9007199254740993"}).error,
              HasSubstr("--seed: '9007199254740993' is not a whole number"));
  EXPECT_THAT(CallSkein({"fdm", "fly", "--seed", "9007199254740993"}).error,
              HasSubstr("--seed: '9007199254740993' is not a whole number"));
}

TEST(Usage, CountsMayBeInAnyNotationOfANumber) {
  const auto fly = [](const std::string& episodes) {
    return CallSkein({"eval", "--policy", "untrained", "--task", "heading", "--episodes", episodes,
                      "--set", "env.time_limit_steps=50", "--set",
                      "env.heading.earliest_success_step=50"});
  };
  const ProgramResult ten = fly("1e1");
  EXPECT_EQ(ten.exit_code, 0) << ten.error;
  EXPECT_EQ(ten.output, fly("10").output);
  for (const char* wrong : {"1.5", "1e9", "nan", "ten", "10x", "0x10", ""}) {
    const ProgramResult result = fly(wrong);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.error, HasSubstr("--episodes")) << wrong;
  }
}

TEST(Usage, FilesThatCannotBeReadAreNamed) {
  const ScratchDirectory scratch;
  const std::string loop = scratch / "loop", large = scratch / "large.toml";
  fs::create_symlink(loop, loop);
  WriteFile(large, "");
  fs::resize_file(large, kLargestText + 1);
  const auto error_of = [](const std::vector<std::string>& arguments) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_NE(result.exit_code, 0);
    return result.error;
  };
  const std::string loop_error = loop + ": Too many levels of symbolic links\n";
  EXPECT_EQ(error_of({"eval", "--task", "heading", "--policy", loop}),
            "skein: error: " + loop_error);
  EXPECT_THAT(error_of({"train", "heading", "--config", loop}),
              HasSubstr(loop + ": cannot be opened: Too many levels of symbolic links"));
  EXPECT_EQ(CallSkein({"train", "heading", "--config", loop}).exit_code, 2);
  EXPECT_THAT(error_of({"train", "heading", "--config", large}),
              HasSubstr(large + ": cannot be read: it has more than 64 MiB"));
}

TEST(Usage, AnErrorIsOneLineWhateverIsInIt) {
  const ScratchDirectory scratch;
  const std::string path = scratch / "config.toml";
  WriteFile(path, "[ppo]\n\"a\\nb\" = 1\n");
  const ProgramResult result = CallSkein({"train", "heading", "--config", path});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.error, HasSubstr(path + ":2: unknown key ppo.a"));
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
}

TEST(Usage, OutputThatIsLostIsAnError) {
  const std::vector<std::pair<std::string, std::function<void()>>> outputs = {
      {"No space left on device", [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); }},
      {"Bad file descriptor", [] { close(STDOUT_FILENO); }}};
  for (const auto& [reason, lose_output] : outputs) {
    for (const char* argument : {"info", "--help"}) {
      const ProgramResult result = RunSkein({argument}, lose_output);
      EXPECT_EQ(result.exit_code, 1) << reason;
      EXPECT_EQ(result.error,
                "skein: error: the standard output cannot be written: " + reason + "\n");
    }
  }
}

TEST(Usage, JsonMayGoToTheStandardOutput) {
  // Here a regular file, which must not be replaced under the stream.
  const ProgramResult result = RunSkein({"info", "--json", "/dev/stdout"});
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("\"libtorch\":"));
  EXPECT_THAT(result.output, HasSubstr("libtorch  "));
}

TEST(Usage, RatesOfTheSimulatorLineUp) {
  const ProgramResult result =
      CallSkein({"bench", "sim", "--num-aircraft", "64", "--steps", "2", "--threads", "1"});
  EXPECT_THAT(result.output, HasSubstr("64 aircraft, 2 steps, 1 thread, "));
  std::istringstream lines(result.output);
  std::set<std::size_t> columns;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(" ms a step");
    if (at != std::string::npos) columns.insert(at);
  }
  EXPECT_EQ(columns.size(), 1u) << result.output;
}

TEST(Usage, ExamplesAreOfTheProgramOrOfTheCommandAskedFor) {
  EXPECT_THAT(CallSkein({"--help"}).output, HasSubstr("skein train heading   "));
  EXPECT_THAT(CallSkein({"fdm", "--help"}).output, Not(HasSubstr("skein train heading")));
}

TEST(Usage, HelpKeysListsEveryKeyWithItsValue) {
  const ProgramResult result = CallSkein({"train", "heading", "--help-keys"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, HasSubstr("env.action_repeat = 5\n"));
  EXPECT_THAT(CallSkein({"train", "--help-keys", "--set", "env.action_repeat=7"}).output,
              HasSubstr("env.action_repeat = 7\n"));
}

TEST(Usage, HelpKeysNeedsNoCommand) {
  const ProgramResult result = CallSkein({"--help-keys"});
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("ppo.gamma = "));
  EXPECT_THAT(result.output, HasSubstr("env.task = "));
}

TEST(Usage, InfoNamesWhatItRunsOn) {
  const ScratchDirectory scratch;
  const std::string path = scratch / "info.json";
  const ProgramResult result =
      RunSkein({"info", "--json", path}, [] { setenv("SKEIN_SIMD", "scalar", 1); });
  EXPECT_EQ(result.exit_code, 0) << result.error;
  const auto info = nlohmann::json::parse(ReadFile(path));
  EXPECT_EQ(info["simd"], "scalar");
  EXPECT_GE(info["threads"], 1);
  EXPECT_NE(info["libtorch"], "");
  EXPECT_NE(info["libtorch_openblas"], "");
  EXPECT_EQ(info["native_bf16"], false) << "the scalar target has none";
  EXPECT_EQ(info["precision"], "fp32");
  EXPECT_THAT(result.output, HasSubstr("learner   precision fp32 (native bf16: no, amx: no;"));
}

TEST(Usage, InfoNamesThePrecisionOfThisProcessor) {
  const ScratchDirectory scratch;
  const std::string path = scratch / "info.json";
  const ProgramResult result = CallSkein({"info", "--json", path});
  const auto info = nlohmann::json::parse(ReadFile(path));
  EXPECT_EQ(info["native_bf16"], simd::NativeBfloat16());
  EXPECT_EQ(info["native_amx"], simd::NativeTiles());
  EXPECT_EQ(info["precision"], Name(DefaultPrecision()));
  EXPECT_THAT(result.output, HasSubstr(std::string("precision ") + Name(DefaultPrecision()) +
                                       " (native bf16: " + (simd::NativeBfloat16() ? "yes" : "no") +
                                       ", amx: " + (simd::NativeTiles() ? "yes;" : "no;")));
}

TEST(Usage, AnUnknownSimdTargetIsAnError) {
  const ProgramResult result = RunSkein({"info"}, [] { setenv("SKEIN_SIMD", "mmx", 1); });
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.error, HasSubstr("mmx"));
}

TEST(Usage, AFullDeviceIsAnError) {
  const ProgramResult result = CallSkein({"info", "--json", "/dev/full"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.error, HasSubstr("/dev/full"));
}

}  // namespace
}  // namespace skein
