// SPDX-License-Identifier: Apache-2.0
// Every exported form against the policy itself, flown by what reads the form elsewhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "envs/aircraft/registry.h"
#include "src/export/export_flights.h"
#include "src/export/export_form.h"
#include "src/files/output_file.h"
#include "tests/error_message.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"
#include "tests/tolerance.h"
#include "tests/train/libtorch.h"
#include "train/export/c_flight_control.h"
#include "train/export/c_policy.h"
#include "train/export/onnx_policy.h"
#include "train/network/backend_module.h"

namespace skein {
namespace {

using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

constexpr Tolerance kFloat32{1e-5, "float32 sums in another order, over whole flights"};

std::string ShippedPolicy(const std::string& task) {
  return SKEIN_SOURCE "/policies/" + task + ".skein";
}

/// A policy with all that its exported forms are made of and held to.
struct Flown {
  ExportedPolicy exported;
  PolicyTrace trace;
  int steps_per_flight = 0;
};

Flown FlyShipped(const std::string& task) {
  const std::string path = ShippedPolicy(task);
  const RecurrentPolicy policy = RecurrentPolicy::Load(path);
  Flown flown;
  flown.exported = PrepareExport(policy, path, "test");
  flown.trace = RecordExportFlights(path, policy, flown.exported.interface.env);
  flown.steps_per_flight = kExportSteps;
  return flown;
}

/// An untrained network, shown made-up observations.
Flown FlyMadeUp(const NetworkConfig& config) {
  constexpr int kObservations = 9, kActions = 3;
  const RecurrentPolicy policy = RecurrentPolicy::Untrained(config, kObservations, kActions, 3);
  Flown flown;
  flown.exported.name = "made_up";
  flown.exported.policy = policy.parameters();
  flown.exported.metadata["version"] = "test";
  flown.steps_per_flight = 40;
  PolicyTrace& trace = flown.trace;
  trace.observation_size = kObservations;
  trace.action_size = kActions;
  std::vector<float> state, action(kActions);
  for (int step = 0; step < 2 * flown.steps_per_flight; ++step) {
    const bool begins = step % flown.steps_per_flight == 0;
    if (begins) state.assign(static_cast<std::size_t>(policy.state_size()), 0.0f);
    trace.begins.push_back(begins ? 1.0f : 0.0f);
    std::vector<float> observation;
    for (int i = 0; i < kObservations; ++i) {
      observation.push_back(0.25f * static_cast<float>((i * 7 + step * 3) % 11 - 5));
    }
    policy.Act(1, observation.data(), state.data(), action.data());
    trace.observations.insert(trace.observations.end(), observation.begin(), observation.end());
    trace.actions.insert(trace.actions.end(), action.begin(), action.end());
  }
  return flown;
}

/// Networks that differ from the usual one in every part but the activation.
NetworkConfig SmallNetwork() {
  NetworkConfig small;
  small.hidden_layers = 1;
  small.hidden_size = 24;
  small.gru_size = 17;
  small.tanh_mean = false;
  small.actor_head_scale = 2;
  return small;
}

NetworkConfig DeepNetwork() {
  NetworkConfig deep = SmallNetwork();
  deep.hidden_layers = 0;
  deep.gru_layers = 3;
  deep.tanh_mean = true;
  return deep;
}

/// What flies a form: a compiler, a Python, or LibTorch.
struct Flyer {
  const char* name;
  ExportForm form;
  std::string program;
};

/// SKEIN_PYTHON is the Python of those packages that Debian does not have.
const std::vector<Flyer>& Flyers() {
  static const std::string python = FlyerOf(ExportForm::kOnnx);
  static const std::vector<Flyer> flyers = {
      {"Gcc", ExportForm::kC, "gcc"},
      {"Clang", ExportForm::kC, "clang-14"},
      {"Onnxruntime", ExportForm::kOnnx, python},
      {"SafetensorsLibrary", ExportForm::kSafetensors, python},
      {"LibTorch", ExportForm::kTorchScript, FlyerOf(ExportForm::kTorchScript)},
      {"TorchOfDebian", ExportForm::kTorchScript, "/usr/bin/python3"},
  };
  return flyers;
}

/// Whether a shell finds `program`.
bool Has(const std::string& program) {
  return std::system((program + " --version >/dev/null 2>&1").c_str()) == 0;
}

/// Whether a form cannot be written or flown for want of Python packages or of LibTorch's module.
bool IsForWantOfLibraries(const std::string& complaint) {
  return testing::Matches(AnyOf(
      ContainsRegex("^nothing is written: .* has no package .* -m pip install "),
      HasSubstr(std::string(kLibTorchModule) + ": cannot open shared object file")))(complaint);
}

class Exported : public ::testing::TestWithParam<Flyer> {
 protected:
  /// Whether the flyer answered at all; if not, says what is missing.
  bool ExpectTheSameActions(const Flown& flown) {
    const Flyer& flyer = GetParam();
    if (flyer.program != FlyerOf(ExportForm::kTorchScript) && !Has(flyer.program)) {
      missing_ = "needs " + flyer.program;
      return false;
    }
    std::vector<float> actions;
    const std::string complaint = MessageOf([&] {
      const std::string bytes =
          Encode(flyer.form, flown.exported, flown.trace, flown.steps_per_flight);
      actions = Fly(flyer.form, bytes, flown.exported, flown.trace, flyer.program);
    });
    if (IsForWantOfLibraries(complaint)) {
      missing_ = complaint;
      return false;
    }
    EXPECT_EQ(complaint, "");
    EXPECT_LE(LargestError(flown.trace, actions), kFloat32) << flown.exported.name;
    return true;
  }

  std::string missing_;
};

TEST_P(Exported, ActsAsTheShippedPolicies) {
  for (const char* task : {"heading", "tracking-planner"}) {
    const Flown flown = FlyShipped(task);
    EXPECT_EQ(flown.trace.steps(), 1000);
    EXPECT_GE(std::count(flown.trace.begins.begin(), flown.trace.begins.end(), 1.0f), 10);
    if (!ExpectTheSameActions(flown)) GTEST_SKIP() << missing_;
  }
}

TEST_P(Exported, KnowsNetworksOfOtherSizes) {
  for (const NetworkConfig& config : {SmallNetwork(), DeepNetwork()}) {
    if (!ExpectTheSameActions(FlyMadeUp(config))) GTEST_SKIP() << missing_;
  }
}

TEST_P(Exported, KnowsEveryActivation) {
  SKEIN_SKIP_WITHOUT_LIBTORCH();
  for (const auto& [activation, name] : kActivationNames) {
    SCOPED_TRACE(name);
    NetworkConfig config = SmallNetwork();
    config.activation = activation;
    if (!ExpectTheSameActions(FlyMadeUp(config))) GTEST_SKIP() << missing_;
  }
}

INSTANTIATE_TEST_SUITE_P(By, Exported, ::testing::ValuesIn(Flyers()),
                         [](const auto& tested) { return tested.param.name; });

TEST(CExport, TellsADifferenceByItsOwnTest) {
  if (!Has("cc")) GTEST_SKIP() << "needs cc";
  Flown flown = FlyMadeUp(SmallNetwork());
  flown.trace.actions[3] += 1e-3f;
  EXPECT_THAT(MessageOf([&] {
                Fly(ExportForm::kC,
                    Encode(ExportForm::kC, flown.exported, flown.trace, flown.steps_per_flight),
                    flown.exported, flown.trace, "cc");
              }),
              HasSubstr("the header's own test fails at policy step 2"));
}

TEST(CExport, WhatIsNoNumberShowsInTheActions) {
  if (!Has("cc")) GTEST_SKIP() << "needs cc";
  Flown flown = FlyMadeUp(SmallNetwork());
  // Not in the steps that the header's own test flies.
  const auto broken = static_cast<std::size_t>(flown.steps_per_flight - 1);
  flown.trace.observations[broken * static_cast<std::size_t>(flown.trace.observation_size)] = NAN;
  const std::vector<float> actions = Fly(
      ExportForm::kC, Encode(ExportForm::kC, flown.exported, flown.trace, flown.steps_per_flight),
      flown.exported, flown.trace, "cc");
  const auto size = static_cast<std::size_t>(flown.trace.action_size);
  for (std::size_t i = 0; i < size; ++i) {
    EXPECT_TRUE(std::isfinite(actions[(broken - 1) * size + i]));
    EXPECT_TRUE(std::isnan(actions[broken * size + i]));
  }
}

TEST(CExport, CompilesForMicrocontrollersAndAsCpp) {
  const Flown flown = FlyMadeUp(DeepNetwork());
  const ScratchDirectory scratch;
  WriteFile(scratch / "policy.h", CPolicy(flown.exported, flown.trace, flown.steps_per_flight));
  const std::string strict = " -Wall -Wextra -Wpedantic -Werror -DMADE_UP_IMPLEMENTATION -c -o " +
                             (scratch / "out.o") + " -x ";
  EXPECT_EQ(std::system(("c++ -std=c++17" + strict + "c++ " + (scratch / "policy.h")).c_str()), 0);
  if (!Has("arm-none-eabi-gcc")) GTEST_SKIP() << "needs arm-none-eabi-gcc (gcc-arm-none-eabi)";
  EXPECT_EQ(std::system(("arm-none-eabi-gcc -std=c99 -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 "
                         "-mfloat-abi=hard -Wdouble-promotion" +
                         strict + "c " + (scratch / "policy.h"))
                            .c_str()),
            0);
}

TEST(FlightControlExport, CommandsAsTheLawsDo) {
  if (!Has("cc")) GTEST_SKIP() << "needs cc";
  for (const char* aircraft : {"f16", "aerosonde"}) {
    EnvConfig env;
    env.aircraft = aircraft;
    env = ExportEnvironment("", env);
    const FlightControlTrace trace = RecordFlightControl(env, kExportFlights, 500, 3);
    const auto commands = FlyFlightControl(CFlightControl(env, trace, "test"),
                                           FlightControlName(env), trace.inputs, "cc");
    EXPECT_LE(LargestError(trace, LoadAircraft(aircraft).actuators, commands), kFloat32);
  }
}

// No identifier of C begins with a digit.
TEST(FlightControlExport, TakesAircraftWhoseNamesBeginWithADigit) {
  const ScratchDirectory scratch;
  EnvConfig env;
  env.aircraft = scratch / "747.json";
  WriteFile(env.aircraft, AircraftText("aerosonde"));
  EXPECT_EQ(FlightControlName(env), "aircraft_747_flight_control");
  env.aircraft = "f16";
  EXPECT_EQ(FlightControlName(env), "f16_flight_control");
}

TEST(FlightControlExport, RefusesWhatHasNoLaws) {
  EnvConfig env;
  env.flight_control = FlightControlMode::kDirect;
  EXPECT_THAT(MessageOf([&] { CFlightControl(env, {}, "test"); }), HasSubstr("no flight control"));
}

TEST(PolicyTrace, LargestErrorIsInfiniteWhereActionsAreMissingOrNotFinite) {
  PolicyTrace trace;
  trace.actions = {0.5f, -0.5f};
  EXPECT_EQ(LargestError(trace, {0.5f, -0.25f}), 0.25);
  EXPECT_EQ(LargestError(trace, {0.5f}), INFINITY);
  EXPECT_EQ(LargestError(trace, {0.5f, NAN}), INFINITY);
}

/// A low-level policy that acts as often as the high-level policy above it.
struct Hierarchy {
  ExportedPolicy high_level, low_level;
  PolicyTrace trace;  ///< the high-level policy's observations, the low-level policy's actions
};

ExportedPolicy Made(const std::string& task, const NetworkConfig& config, int actions,
                    std::shared_ptr<const StoredPolicy> low_level) {
  auto parameters = std::make_shared<RecurrentPolicy::Parameters>(
      *RecurrentPolicy::Untrained(config, 22, actions, 5, 5).parameters());
  parameters->task = task;
  parameters->low_level = std::move(low_level);
  return PrepareExport(RecurrentPolicy(std::move(parameters)), task, "test");
}

Hierarchy FlyHierarchy() {
  NetworkConfig config = SmallNetwork();
  Hierarchy flown;
  flown.low_level = Made("control", config, 4, nullptr);
  const RecurrentPolicy low_level(flown.low_level.policy);
  config.gru_layers = 2;
  flown.high_level =
      Made("tracking", config, 3, std::make_shared<const RecurrentPolicy>(low_level));
  const RecurrentPolicy high_level(flown.high_level.policy);
  const EnvConfig& env = flown.high_level.interface.env;
  std::vector<float> above(static_cast<std::size_t>(high_level.state_size()));
  std::vector<float> below(static_cast<std::size_t>(low_level.state_size()));
  flown.trace.observation_size = 22;
  flown.trace.action_size = 4;
  for (int step = 0; step < 60; ++step) {
    std::vector<float> observation(22), change(3), action(4);
    for (int i = 0; i < 22; ++i) {
      observation[static_cast<std::size_t>(i)] =
          std::sin(0.7f * static_cast<float>(i) + 0.3f * static_cast<float>(step));
    }
    flown.trace.begins.push_back(step == 0 ? 1.0f : 0.0f);
    flown.trace.observations.insert(flown.trace.observations.end(), observation.begin(),
                                    observation.end());
    high_level.Act(1, observation.data(), above.data(), change.data());
    const double pitch = std::asin(observation[6]);
    const double target = pitch + env.high_level.pitch_change_rad * change[0];
    observation[0] = static_cast<float>(std::clamp(target, -M_PI / 2, M_PI / 2) - pitch);
    observation[1] = static_cast<float>(env.high_level.yaw_change_rad * change[1]);
    observation[2] = static_cast<float>(env.high_level.speed_change_fps * change[2] /
                                        LoadAircraft(env.aircraft).units.speed_ft_s);
    low_level.Act(1, observation.data(), below.data(), action.data());
    flown.trace.actions.insert(flown.trace.actions.end(), action.begin(), action.end());
  }
  return flown;
}

TEST(OnnxHierarchy, ActsAsBothPoliciesOneAfterTheOther) {
  const std::string python = FlyerOf(ExportForm::kOnnx);
  if (!Has(python)) GTEST_SKIP() << "needs " << python;
  const Hierarchy flown = FlyHierarchy();
  ASSERT_TRUE(FitInOneGraph(flown.high_level, flown.low_level));
  std::vector<float> actions;
  const std::string complaint = MessageOf([&] {
    actions = Fly(ExportForm::kOnnx, OnnxHierarchy(flown.high_level, flown.low_level),
                  flown.high_level, flown.trace, python);
  });
  if (IsForWantOfLibraries(complaint)) GTEST_SKIP() << complaint;
  EXPECT_EQ(complaint, "");
  // The pitch comes from its float32 sine, which says little of it near the vertical.
  constexpr Tolerance kArcSine{1e-4, "float32 arc sine near the vertical"};
  EXPECT_LE(LargestError(flown.trace, actions), kArcSine);
}

TEST(OnnxHierarchy, NeedsAHighLevelPolicyThatActsAsOften) {
  Hierarchy flown = FlyHierarchy();
  flown.high_level.interface.action_repeat = 6;
  EXPECT_FALSE(FitInOneGraph(flown.high_level, flown.low_level));
  flown.high_level.interface.action_repeat = 1;
  EXPECT_TRUE(FitInOneGraph(flown.high_level, flown.low_level));
  flown.high_level.interface.env.high_level.averages_observations = true;
  EXPECT_FALSE(FitInOneGraph(flown.high_level, flown.low_level));
}

class ExportCommand : public ::testing::Test {
 protected:
  ProgramResult Export(const std::string& policy, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"export", policy};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return CallSkein(arguments);
  }

  const ScratchDirectory scratch_;
  const std::string policy_ = ShippedPolicy("heading");
};

TEST_F(ExportCommand, WritesAHeaderThatSaysWhatItsNumbersAre) {
  const std::string out = scratch_ / "heading.h";
  const ProgramResult result = Export(policy_, {"--format", "c", "-o", out});
  EXPECT_EQ(result.exit_code, 0) << result.error;
  const std::string header = ReadFile(out);
  for (const char* text :
       {"error_altitude_ft = 3280.84 obs[0]", "error_yaw_deg = 57.29578 obs[1]",
        "altitude_ft = 16404.2 obs[3]", "elevator_deg = 25 obs[17]", "aileron_deg = 21.5 obs[18]",
        "rudder_deg = 30 obs[19]", "leading_edge_flap_deg = 25 obs[20]",
        "throttle_fraction = 0.5 actions[0] + 0.5", "held for 0.1 s",
        "void heading_step(const float obs[HEADING_OBSERVATION_SIZE]"}) {
    EXPECT_THAT(header, HasSubstr(text));
  }
}

TEST_F(ExportCommand, NamesKeepTwoPoliciesOfOneTaskApart) {
  if (!Has("cc")) GTEST_SKIP() << "needs cc";
  const std::string calm = scratch_ / "calm.h", robust = scratch_ / "robust.h";
  EXPECT_EQ(Export(policy_, {"--name", "calm", "-o", calm, "--check"}).exit_code, 0);
  EXPECT_EQ(Export(ShippedPolicy("heading-robust"), {"--name", "Robust_2", "-o", robust}).exit_code,
            0);
  const std::string program = scratch_ / "two.c";
  WriteFile(program,
            "#define CALM_IMPLEMENTATION\n#include \"calm.h\"\n"
            "#define ROBUST_2_IMPLEMENTATION\n#include \"robust.h\"\n"
            "int main(void) { return calm_self_test() + Robust_2_self_test(); }\n");
  const std::string built = scratch_ / "two";
  EXPECT_EQ(std::system(("cc -o " + built + " " + program + " -lm && " + built).c_str()), 0);
  for (const char* name : {"2nd", "_calm", "calm-1", "\xc3\xa4"}) {
    const ProgramResult refused = Export(policy_, {"--name", name, "-o", calm});
    EXPECT_EQ(refused.exit_code, 2) << name;
    EXPECT_THAT(refused.error, HasSubstr("is no name: letters, digits and underscores"));
  }
  const ProgramResult unused = Export(policy_, {"--name", "x", "-o", scratch_ / "x.safetensors"});
  EXPECT_EQ(unused.exit_code, 2);
  EXPECT_THAT(unused.error, HasSubstr("safetensors hold no name"));
}

TEST_F(ExportCommand, TheEndingOfItsNameTellsTheFormat) {
  for (const std::string name : {"policy.onnx", "policy.safetensors", "policy.h"}) {
    const std::string told = scratch_ / name, asked = scratch_ / ("asked." + name);
    const std::string ending = name.substr(name.find('.') + 1);
    EXPECT_EQ(Export(policy_, {"-o", told}).exit_code, 0) << name;
    EXPECT_EQ(Export(policy_, {"--format", ending == "h" ? "c" : ending, "-o", asked}).exit_code,
              0);
    EXPECT_EQ(ReadFile(told), ReadFile(asked)) << name;
  }
  const ProgramResult other = Export(policy_, {"--format", "c", "-o", scratch_ / "other.onnx"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.error, HasSubstr("let the name end in ."));
  const ProgramResult untold = Export(policy_, {"-o", scratch_ / "policy.pt"});
  EXPECT_EQ(untold.exit_code, 2);
  EXPECT_THAT(untold.error, HasSubstr("--format is needed: onnx, torchscript, safetensors or c"));
}

TEST_F(ExportCommand, WritesAHierarchyAsTwoFilesAndAManifest) {
  const ProgramResult result = Export(ShippedPolicy("tracking-planner"),
                                      {"--format", "safetensors", "-o", scratch_ / "tracking.st"});
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_GT(std::filesystem::file_size(scratch_ / "tracking.low_level.st"), 600000u);
  const auto manifest = nlohmann::json::parse(ReadFile(scratch_ / "tracking.json"));
  EXPECT_EQ(manifest["high_level"]["file"], "tracking.st");
  EXPECT_EQ(manifest["high_level"]["action_repeat"], 50);
  EXPECT_EQ(manifest["high_level"]["actions"][0]["name"], "pitch_change_rad");
  EXPECT_EQ(manifest["low_level"]["file"], "tracking.low_level.st");
  EXPECT_EQ(manifest["low_level"]["action_repeat"], 5);
  EXPECT_EQ(manifest["low_level"]["observations"][0]["name"], "error_pitch_deg");
}

TEST_F(ExportCommand, NamesWhatAnEarlierExportHasLeftAndRemovesNothing) {
  const auto names = [](const std::string& path) { return "untouched " + path + " ("; };
  const std::string out = scratch_ / "x.onnx", combined = scratch_ / "x.combined.onnx",
                    low_level = scratch_ / "x.low_level.onnx", manifest = scratch_ / "x.json";
  // This one acts less often than its low-level policy: both are not one graph.
  WriteFile(combined, "of another planner");
  const ProgramResult planner = Export(ShippedPolicy("tracking-planner"), {"-o", out});
  EXPECT_EQ(planner.exit_code, 0) << planner.error;
  EXPECT_THAT(planner.output, HasSubstr(names(combined)));
  for (const std::string& written : {low_level, manifest}) {
    EXPECT_THAT(planner.output, ::testing::Not(HasSubstr(names(written))));
  }
  const std::string before = ReadFile(manifest);
  const ProgramResult flat = Export(policy_, {"-o", out});
  EXPECT_EQ(flat.exit_code, 0) << flat.error;
  for (const std::string& left : {combined, low_level, manifest}) {
    EXPECT_THAT(flat.output, HasSubstr(names(left)));
  }
  EXPECT_EQ(ReadFile(combined), "of another planner");
  EXPECT_EQ(ReadFile(manifest), before);
  // What else is called so is nobody's business.
  WriteFile(manifest, "{\"mine\": 1}");
  EXPECT_THAT(Export(policy_, {"-o", out}).output, ::testing::Not(HasSubstr(names(manifest))));
}

TEST_F(ExportCommand, WritesTheLawsThatAPolicyFliesThrough) {
  const std::string out = scratch_ / "laws.h";
  const ProgramResult result = Export(policy_, {"--flight-control", "c", "-o", out});
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(ReadFile(out), HasSubstr("#define F16_FLIGHT_CONTROL_STEP_S 0.02f"));
}

TEST_F(ExportCommand, RefusesWhatItCannotDoInOneLine) {
  const std::string out = scratch_ / "out";
  EXPECT_EQ(Export(policy_, {"--format", "keras", "-o", out}).exit_code, 2);
  EXPECT_EQ(Export(policy_, {"--format", "c"}).exit_code, 2);
  EXPECT_EQ(Export(policy_, {"-o", out}).exit_code, 2);
  EXPECT_EQ(Export(policy_, {"--flight-control", "c", "--aircraft", "f16", "-o", out}).exit_code,
            2);
  const auto expect_failure = [this](const std::string& policy, const std::string& file,
                                     const std::string& message, int exit_code = 1) {
    const ProgramResult result = Export(policy, {"--format", "c", "-o", file});
    EXPECT_EQ(result.exit_code, exit_code) << message;
    EXPECT_THAT(result.error, HasSubstr(message));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1);
  };
  expect_failure(policy_, scratch_ / "missing" + "/out.h", "cannot be written", 2);
  expect_failure(scratch_ / "nothing.skein", out, "No such file", 2);
  expect_failure("autopilot:traditional", out, "autopilot:traditional is no policy", 2);
  WriteFile(scratch_ / "config.toml", "");
  expect_failure(scratch_.path(), out, "the run has not saved a policy yet");
  RecurrentPolicy::Untrained({}, 22, 4, 1).Save(scratch_ / "untrained.skein");
  expect_failure(scratch_ / "untrained.skein", out, "does not say for which task it was made");
  auto strange =
      std::make_shared<RecurrentPolicy::Parameters>(*RecurrentPolicy::Load(policy_).parameters());
  strange->environment.erase("aircraft_hash");  // by which the aircraft is known whatever its name
  strange->environment["aircraft"] = "kite";
  RecurrentPolicy(strange).Save(scratch_ / "kite.skein");
  expect_failure(scratch_ / "kite.skein", out, "kite.skein cannot be described: ");
  strange->environment["aircraft"] = "f16";
  strange->environment["control_interval_s"] = "0";
  RecurrentPolicy(strange).Save(scratch_ / "standing.skein");
  expect_failure(scratch_ / "standing.skein", out, "env.control_interval_s = 0 is out of range");
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace skein
