// SPDX-License-Identifier: Apache-2.0
#include "src/config/task_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "envs/state/attitude.h"
#include "envs/task_registry.h"
#include "envs/vec_env.h"
#include "simd/random.h"
#include "src/config/configuration.h"
#include "src/config/target_reach.h"
#include "src/files/output_file.h"
#include "tests/envs/step_buffers.h"
#include "tests/envs/test_policy.h"
#include "tests/error_message.h"
#include "tests/scratch_directory.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

const std::vector<std::string> kTables = {"env", "ppo", "run"};

std::string Example(const std::string& name) {
  return std::string(SKEIN_SOURCE "/examples/tasks/") + name + ".toml";
}

/// A whole file, of which one line can be another.
std::string Minimal(const std::string& from = "", const std::string& to = "") {
  std::string text =
      "name = \"hold\"\n"
      "[observe]\n"
      "numbers = [\"error_altitude\"]\n"
      "[[target]]\n"
      "quantity = \"altitude_ft\"\n"
      "around_start = 500\n"
      "[[reward]]\n"
      "quantity = \"error_altitude\"\n"
      "weight = -1\n"
      "[reached]\n"
      "conditions = [{quantity = \"error_altitude_ft\", within = 50}]\n";
  if (!from.empty()) text.replace(text.find(from), from.size(), to);
  return text;
}

TermTaskConfig Read(const std::string& text) {
  return ReadTaskFile(text, "my.toml", kTables).terms;
}

TEST(TaskFileTest, ATaskIsFlownByALowLevelPolicyIfItObservesWhatThatDoes) {
  const auto message = [](const std::string& observed) {
    EnvConfig config;
    config.SetTermTask(Read(Minimal("[\"error_altitude\"]", observed)));
    return MessageOf([&] { VecEnv(config, 4, 1, 32, std::make_shared<const TestPolicy>(1)); });
  };
  const std::string three = "[\"error_altitude\", \"sin_roll\", \"mach\"]";
  EXPECT_EQ(message(three), "");
  for (const std::string& other :
       {std::string("[\"error_altitude\"]"), three + "\nlast_actions = true"}) {
    EXPECT_NE(message(other).find("needs the standard observation: not hold's"), std::string::npos);
  }
}

TEST(TaskFileTest, ReadsWhatItSays) {
  const TermTaskConfig task = Read(Minimal());
  EXPECT_EQ(task.name, "hold");
  ASSERT_EQ(task.targets.size(), 1u);
  EXPECT_EQ(task.targets[0].name, "altitude");
  EXPECT_EQ(task.targets[0].draw.min, -500);
  EXPECT_EQ(task.rewards[0].weight, -1);
  EXPECT_EQ(task.reached[0].limit, 50);
  EXPECT_TRUE(task.observes_flight);
}

TEST(TaskFileTest, TakesDegreesAndRadians) {
  const std::string yaw = "[[target]]\nquantity = \"yaw_deg\"\nbetween = [-90, 180]\n[[reward]]";
  const TermTaskConfig task = Read(Minimal("[[reward]]", yaw));
  EXPECT_DOUBLE_EQ(task.targets[1].draw.max, M_PI);
}

TEST(TaskFileTest, AUnitIsInTheUnitOfItsQuantity) {
  const auto unit_of = [](const std::string& target) {
    return Read(Minimal("[[reward]]", "[[target]]\n" + target + "[[reward]]")).targets[1].unit;
  };
  const auto in_degrees = unit_of("quantity = \"roll_deg\"\nbetween = 60\nunit = 90\n");
  EXPECT_DOUBLE_EQ(in_degrees.number, M_PI / 2);
  const auto in_radians = unit_of("quantity = \"roll_rad\"\nbetween = 1\nunit = 0.5\n");
  EXPECT_EQ(in_radians.number, 0.5);
  EXPECT_EQ(unit_of("quantity = \"roll_deg\"\nbetween = 60\n").number, 1) << "a radian";
}

TEST(TaskFileTest, ATargetIsCalledAsItsQuantityWithoutTheUnit) {
  const std::string rate = "[[target]]\nquantity = \"p_deg_s\"\nbetween = 60\n[[reward]]";
  EXPECT_EQ(Read(Minimal("[[reward]]", rate)).targets[1].name, "p");
}

struct Wrong {
  const char *from, *to, *message;
};

TEST(TaskFileTest, RefusesInOneLineThatNamesTheField) {
  const Wrong all[] = {
      {"name = \"hold\"", "name = \"Hold it\"", "name must be a name"},
      {"name = \"hold\"", "name = \"heading\"", "built-in task"},
      {"name = \"hold\"", "nmae = \"hold\"", "unknown key nmae; did you mean name?"},
      {"[[reward]]", "[[rewards]]", "unknown key rewards; did you mean reward?"},
      {"\"altitude_ft\"", "\"altitude_feet\"", "unknown quantity altitude_feet"},
      {"[\"error_altitude\"]", "[\"eror_altitude\"]", "did you mean error_altitude?"},
      {"[\"error_altitude\"]", "[\"point_up_ft\"]", "a target that is a point"},
      {"[\"error_altitude\"]", "[\"terrain_ft\"]", "there is no [terrain]"},
      {"[\"error_altitude\"]", "[\"nose_angle_rad\"]", "a target pitch and yaw"},
      {"[\"error_altitude\"]", "[\"error_altitude\", \"error_altitude\"]", "twice"},
      {"[\"error_altitude\"]", "[\"error_altitude\"]\nflight = false", "at least 4"},
      {"\"altitude_ft\"", "\"climb_rate_fps\"", "climb_rate_fps cannot be a target"},
      {"[[reward]]",
       "[[target]]\nquantity = \"roll_deg\"\nname = \"x\"\nbetween = 9\n"
       "[[target]]\nquantity = \"mach\"\nname = \"x_deg\"\nbetween = 1\n[[reward]]",
       "two targets' errors are called error_x_deg"},
      {"[\"error_altitude\"]", "[1]", "numbers must be the name of a quantity"},
      {"around_start = 500", "around_start = nan", "around_start must be a finite number"},
      {"around_start = 500", "around_start = -5", "must not be negative"},
      {"around_start = 500", "around_start = [5, 3]", "must not end before it begins"},
      {"around_start = 500", "around_start = 5\nbetween = [1, 2]", "it must have just one of"},
      {"around_start = 500", "", "it needs one of around_start, between"},
      {"around_start = 500", "around_start = 5\nspread = 5", "unknown key spread"},
      {"weight = -1", "weight = inf", "weight must be a finite number"},
      {"weight = -1", "", "a reward needs a weight"},
      {"weight = -1", "weigth = -1", "my.toml:9: unknown key weigth; did you mean weight?"},
      {"within = 50", "witin = 50", "unknown key witin; did you mean within?"},
      {"around_start = 500", "betwen = [1, 2]", "unknown key betwen; did you mean between?"},
      {"weight = -1", "weight = -1\nshape = \"gausian\"", "did you mean gaussian?"},
      {"weight = -1", "weight = -1\nshape = \"gaussian\"", "needs a width"},
      {"weight = -1", "weight = -1\nwidth = 3", "unknown key width"},
      {"weight = -1", "weight = -1\nunit = \"sped\"", "unknown unit sped; did you mean speed?"},
      {"weight = -1", "weight = -1\nunit = 0", "unit must be a finite number"},
      {"within = 50", "within = 0", "within must be a finite number"},
      {"within = 50", "beyond = 50", "it needs one of within, below, above"},
      {"within = 50}", "box_ft = 50}", "a target that is a point"},
      {"[reached]",
       "[[termination]]\nquantity = \"mach\"\nabove = 1\nas = \"overloaded\"\n[reached]",
       "did you mean overload?"},
      {"[observe]", "[observe", "not valid TOML"},
  };
  for (const Wrong& wrong : all) {
    const std::string message = MessageOf([&] { Read(Minimal(wrong.from, wrong.to)); });
    EXPECT_NE(message.find(wrong.message), std::string::npos) << wrong.to << ": " << message;
    EXPECT_EQ(message.rfind("my.toml", 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(TaskFileTest, NamesTheLineOfASetting) {
  const ScratchDirectory scratch;
  const std::string file = scratch / "hold.toml";
  WriteFile(file, Minimal() + "[ppo]\nlearning_rate = 1e-3\ngama = 0.9\n");
  const std::string message = MessageOf([&] { ResolveConfig({file, "default", "", {}}); });
  EXPECT_NE(message.find("hold.toml:14: unknown key ppo.gama"), std::string::npos) << message;
}

TEST(TaskFileTest, ItsAircraftIsChosenAsByAConfiguration) {
  const ScratchDirectory scratch;
  const std::string file = scratch / "hold.toml", bare = scratch / "bare.toml";
  const std::string config = scratch / "config.toml", aircraft = scratch / "mine.json";
  nlohmann::json mine = nlohmann::json::parse(AircraftText("aerosonde"));
  mine.erase("presets_of");
  WriteFile(file, Minimal() + "[env]\naircraft = \"mine.json\"\nhold_s = 5\n");
  WriteFile(bare, Minimal() + "[env]\nhold_s = 5\n");
  WriteFile(config, "[env]\naircraft = \"mine.json\"\n");

  WriteFile(aircraft, mine.dump());
  const std::string refusal = MessageOf([&] { ResolveConfig({file, "default", "", {}}); });
  EXPECT_NE(refusal.find("but all else is made for f16, from 1000 ft/s on"), std::string::npos)
      << refusal;
  // What --set says counts.
  ResolveConfig({file,
                 "default",
                 "",
                 {"env.initial.true_airspeed_min_fps=75", "env.initial.true_airspeed_max_fps=88"}});

  mine["env"] = {{"initial", {{"true_airspeed_min_fps", 75}, {"true_airspeed_max_fps", 88}}},
                 {"hold_s", 3}};
  WriteFile(aircraft, mine.dump());
  const ProgramConfig named = ResolveConfig({file, "default", "", {}});
  const ProgramConfig configured = ResolveConfig({bare, "default", config, {"env.hold_s=5"}});
  EXPECT_EQ(named.train.env.initial.true_airspeed_fps.min, 75);
  EXPECT_EQ(named.train.env.hold_s, 5) << "the task file's settings are on top of the aircraft's";
  EXPECT_FALSE(named.train.env.drag_rises);
  for (const std::string& difference : Differences(named, configured)) {
    EXPECT_EQ(difference.rfind("env.task_file_hash", 0), 0u) << difference;
  }
}

TEST(TaskFileTest, TargetsBeyondWhereFlightsEndAreNamed) {
  const auto lines = [](const std::string& draw) {
    EnvConfig env;  // from 19,000 to 20,000 ft, flights end below 2500 ft and above Mach 3
    env.SetTermTask(Read(Minimal("quantity = \"altitude_ft\"\naround_start = 500", draw)));
    return TargetsBeyondLimits(env);
  };
  const auto altitude = [&](const std::string& draw) {
    return lines("quantity = \"altitude_ft\"\n" + draw);
  };
  const std::string altitude_too = "quantity = \"altitude_ft\"\naround_start = 500\n[[target]]\n";
  const auto other = [&](const std::string& target) { return lines(altitude_too + target); };
  EXPECT_TRUE(altitude("around_start = 500").empty());
  EXPECT_TRUE(altitude("between = [0, 2600]").empty()) << "some can be reached";
  EXPECT_TRUE(altitude("around_start = [-30000, -17000]").empty());
  ASSERT_EQ(altitude("between = [0, 2400]").size(), 1u);
  EXPECT_EQ(altitude("between = [0, 2400]")[0],
            "target altitude cannot be reached: it is 2400 or less (altitude_ft), but flights end "
            "below 2500 ft (env.termination.min_altitude_ft)");
  EXPECT_EQ(altitude("around_start = [-30000, -18000]").size(), 1u);
  EnvConfig raised;
  raised.target_altitude_min_ft = 3000;
  raised.SetTermTask(Read(Minimal("around_start = 500", "between = [0, 2400]")));
  EXPECT_TRUE(TargetsBeyondLimits(raised).empty());
  const std::string speed = "quantity = \"true_airspeed_fps\"\n", mach = "quantity = \"mach\"\n";
  EXPECT_TRUE(other(speed + "around_start = 5").empty());
  EXPECT_TRUE(other(speed + "between = [3200, 4000]").empty())
      << "less than Mach 3 where it is warm";
  EXPECT_EQ(other(speed + "between = [3400, 4000]").size(), 1u);
  EXPECT_EQ(other(speed + "between = [1, 5]").size(), 1u) << "below Mach 0.01";
  EXPECT_TRUE(other(mach + "between = [2, 4]").empty());
  EXPECT_EQ(other(mach + "between = [3.1, 4]").size(), 1u);
}

TEST(TaskFileTest, TargetsAndStartsBeyondOwnEndsAreNamed) {
  const auto with = [](const std::string& target, const std::string& end) {
    EnvConfig env;  // from 19,000 to 20,000 ft
    env.SetTermTask(Read(Minimal("[[reward]]", target + "[[termination]]\n" + end + "[[reward]]")));
    return env;
  };
  const std::string roll = "[[target]]\nquantity = \"roll_deg\"\nbetween = ";
  const std::string beyond = "quantity = \"roll_rad\"\nbeyond = 2\n";
  EXPECT_TRUE(TargetsBeyondLimits(with(roll + "[100, 130]\n", beyond)).empty());
  ASSERT_EQ(TargetsBeyondLimits(with(roll + "[130, 150]\n", beyond)).size(), 1u);
  EXPECT_EQ(TargetsBeyondLimits(with(roll + "[130, 150]\n", beyond))[0],
            "target roll cannot be reached: it is 130 or more (roll_deg), but flights end above "
            "114.59 ([[termination]])");
  EXPECT_EQ(TargetsBeyondLimits(with(roll + "[-150, -130]\n", beyond)).size(), 1u);
  EXPECT_TRUE(TargetsBeyondLimits(with(roll + "[130, 250]\n", beyond)).empty()) << "wrapped";
  const std::string altitude = "quantity = \"altitude_ft\"\n";
  EnvConfig low;
  low.SetTermTask(Read(Minimal("around_start = 500\n", "between = [5000, 6000]\n[[termination]]\n" +
                                                           altitude + "below = 8000\n")));
  EXPECT_EQ(TargetsBeyondLimits(low).size(), 1u);
  low.target_altitude_min_ft = 9000;
  EXPECT_TRUE(TargetsBeyondLimits(low).empty()) << "raised";
  EXPECT_TRUE(StartsBeyondOwnEnds(with("", altitude + "below = 19500\n")).empty());
  EXPECT_EQ(StartsBeyondOwnEnds(with("", altitude + "below = 25000\n")),
            std::vector<std::string>{"flights end as they begin: with altitude_ft from 19000 to "
                                     "20000, and a [[termination]] is below 25000"});
  EXPECT_EQ(StartsBeyondOwnEnds(with("", altitude + "above = 18000\n")).size(), 1u);
}

TEST(TaskFileTest, RefusesTooMuch) {
  std::string rewards = Minimal();
  for (int i = 0; i < TermTaskConfig::kMaxRewards; ++i) {
    rewards += "[[reward]]\nquantity = \"mach\"\nweight = 1\n";
  }
  EXPECT_NE(MessageOf([&] { Read(rewards); }).find("at most 24"), std::string::npos);
  const std::string nested(5000, '[');
  EXPECT_FALSE(MessageOf([&] { Read("name = " + nested); }).empty());
  EXPECT_NE(MessageOf([&] { Read(Minimal() + std::string(1 << 17, '#')); }).find("at most 65536"),
            std::string::npos);
}

TEST(TaskFileTest, KnowsWhatPoliciesObserveFromWhatTheyAreRewardedFor) {
  const TermTaskConfig task = Read(Minimal());
  const TermTaskConfig dearer = Read(Minimal("weight = -1", "weight = -2"));
  EXPECT_NE(task.hash, dearer.hash);
  EXPECT_EQ(task.interface, dearer.interface);
  EXPECT_NE(task.interface,
            Read(Minimal("[\"error_altitude\"]", "[\"error_altitude_ft\"]")).interface);
}

TEST(TaskFileTest, EveryExampleIsATask) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SKEIN_SOURCE "/examples/tasks")) {
    const ProgramConfig config = ResolveConfig({entry.path().string(), "default", "", {}});
    CheckConsistent(config);
    const auto task = MakeTask(config.train.env);
    EXPECT_EQ(task->target_quantities().size(), static_cast<std::size_t>(task->num_targets()));
    ++count;
  }
  EXPECT_GE(count, 6);
}

TEST(TaskFileTest, RollsAroundTheStartAreOfTheBankThatFlightsBeginWith) {
  EnvConfig env;
  env.SetTermTask(Read(
      Minimal("[[reward]]", "[[target]]\nquantity = \"roll_deg\"\naround_start = 0\n[[reward]]")));
  env.initial.training_bank_max_deg = 90;
  constexpr Tolerance kRounding{1e-5, "rad, of float32 quaternions"};
  const VecEnv flights(env, 20, 1);
  double most = 0;
  for (int i = 0; i < 20; ++i) {
    Eigen::Vector4d attitude;
    for (int k = 0; k < 4; ++k) attitude[k] = flights.StateOf(i, kQ0 + k);
    EXPECT_NEAR(flights.TargetOf(i)[1], EulerFromQuaternion(attitude).roll, kRounding) << i;
    most = std::max<double>(most, std::abs(flights.TargetOf(i)[1]));
  }
  EXPECT_GT(most, 0.5);
}

/// Flights of two control steps each that observe their last actions.
EnvConfig ObservingActions(double noise) {
  EnvConfig env;
  env.SetTermTask(Read(Minimal("[[target]]", "last_actions = true\n[[target]]")));
  env.time_limit_steps = 2;
  env.observation_noise = noise;
  return env;
}

/// The last four numbers of each row.
std::vector<float> ActionsObserved(const VecEnv& env) {
  const auto size = static_cast<std::size_t>(env.observation_size());
  std::vector<float> rows(static_cast<std::size_t>(env.num_aircraft()) * size), observed;
  env.Observe(0, rows.data());
  for (std::size_t end = size; end <= rows.size(); end += size) {
    observed.insert(observed.end(), rows.begin() + static_cast<std::ptrdiff_t>(end - kActionSize),
                    rows.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return observed;
}

TEST(TaskFileTest, LastActionsAreThoseOfThePolicyStepBeforeInItsEpisode) {
  VecEnv env(ObservingActions(0), 1, 1);
  StepBuffers buffers(1);
  buffers.action = {2, -0.5f, 0.25f, 0.125f};
  const std::vector<float> none(kActionSize), clipped = {1, -0.5f, 0.25f, 0.125f};
  for (int episode = 0; episode < 2; ++episode) {
    EXPECT_EQ(ActionsObserved(env), none);
    env.Step(0, buffers.action.data(), buffers.output());
    EXPECT_EQ(ActionsObserved(env), clipped);
    env.Step(0, buffers.action.data(), buffers.output());
    EXPECT_NE(buffers.termination[0], 0);
  }
}

TEST(TaskFileTest, LastActionsAreAsNoisyAsAllThatIsObserved) {
  constexpr double kNoise = 0.5;
  const std::vector<float> observed =
      ActionsObserved(VecEnv(ObservingActions(kNoise), 500, 1, 500));
  const auto count = static_cast<double>(observed.size()) / kActionSize;
  for (std::size_t k = 0; k < kActionSize; ++k) {
    double squares = 0;
    for (std::size_t i = k; i < observed.size(); i += kActionSize) {
      squares += observed[i] * observed[i];
    }
    const double variance = kNoise * kNoise;
    EXPECT_NEAR(squares / count, variance, kStandardErrors * variance * std::sqrt(2 / count)) << k;
  }
}

TEST(TaskFileTest, FrozenSensorsAreTheSameBehindAnyLeadingNumbers) {
  constexpr int kCount = 64;
  const auto observed = [](const std::string& numbers) {
    EnvConfig env;
    env.SetTermTask(Read(Minimal("\"error_altitude\"", numbers)));
    env.observation_noise = 0;
    env.plant.sensor_freeze_chance = 1;
    env.plant.sensor_freeze_s = {0.1, 0.1};
    VecEnv flights(env, kCount, 1);
    StepBuffers buffers(kCount);
    for (std::size_t i = 0; i < kCount; ++i) buffers.action[4 * i + 1] = 0.5f;
    for (int step = 0; step < 20; ++step) {
      flights.Step(0, buffers.action.data(), buffers.output());
    }
    const auto size = static_cast<std::size_t>(flights.observation_size());
    std::vector<float> rows(kCount * size), sensed;
    flights.Observe(0, rows.data());
    constexpr std::size_t kSensed = 19;
    for (std::size_t end = size; end <= rows.size(); end += size) {
      sensed.insert(sensed.end(), rows.begin() + static_cast<std::ptrdiff_t>(end - kSensed),
                    rows.begin() + static_cast<std::ptrdiff_t>(end));
    }
    return sensed;
  };
  const std::string one = "\"error_altitude\"", two = one + ", \"pitch_rad\"";
  EXPECT_EQ(observed(one), observed(two + ", \"q_rad_s\""));
  EXPECT_EQ(observed(two), observed(two + ", \"q_rad_s\""));
}

/// What is observed before each control step of a flight in turbulence, by a task that observes
/// these numbers, `delay` control steps late.
std::vector<std::vector<float>> ObservedInWind(const std::string& numbers, int delay) {
  EnvConfig env;
  env.SetTermTask(Read(Minimal("\"error_altitude\"", numbers)));
  env.observation_noise = 0;
  env.wind.turbulence_fps = {10, 10};
  env.plant.observation_delay_steps = {delay, delay};
  env.plant.mass = {1.1, 1.1};
  VecEnv flight(env, 1, 1);
  std::vector<std::vector<float>> rows;
  StepBuffers buffers(1);
  for (int step = 0; step < 30; ++step) {
    rows.emplace_back(static_cast<std::size_t>(flight.observation_size()));
    flight.Observe(0, rows.back().data());
    buffers.action = {0.5f, step % 8 < 4 ? 0.3f : -0.3f, 0.1f, 0};
    StepOutput output = buffers.output();
    std::vector<float> final(rows.back().size());
    output.final_observation = final.data();
    flight.Step(0, buffers.action.data(), output);
  }
  return rows;
}

TEST(TaskFileTest, LateNumbersInWindAreThoseOfStepsBefore) {
  const std::string numbers =
      "\"climb_rate_fps\", \"u_fps\", \"v_fps\", \"w_fps\", \"true_airspeed_fps\"";
  const auto prompt = ObservedInWind(numbers, 0), late = ObservedInWind(numbers, 2);
  for (std::size_t step = 0; step < prompt.size(); ++step) {
    EXPECT_EQ(late[step], prompt[step < 2 ? 0 : step - 2]) << step;
  }
}

TEST(TaskFileTest, LateErrorsOfWhatIsNotRememberedAreRefused) {
  EnvConfig env;
  std::string text = Minimal("around_start = 500\n", "between = [1, 2]\n");
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"altitude_ft", "load_factor_g"},
        {"error_altitude", "error_load_factor"}}) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from)) {
      text.replace(at, from.size(), to);
    }
  }
  env.SetTermTask(Read(text));
  env.plant.observation_delay_steps = {0, 1};
  EXPECT_NE(MessageOf([&] { VecEnv(env, 1, 1); }).find("not known of control steps before"),
            std::string::npos);
}

/// Every mutation of a file is a task that can be made, or an Error of one line: never anything
/// else.
void ReadMutant(const std::string& text) {
  try {
    const TaskFile file = ReadTaskFile(text, "mutant.toml", kTables);
    EnvConfig env;
    env.SetTermTask(file.terms);
    MakeTask(env);
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

TEST(TaskFileTest, SurvivesMutations) {
  simd::RandomStream random({17, 0, 0, 0, simd::RandomPurpose::kActionNoise});
  const auto below = [&random](std::size_t end) {
    return std::min(static_cast<std::size_t>(random.Uniform(0, static_cast<double>(end))), end - 1);
  };
  const std::string alphabet = "[]{}=\",.\n#-019eainf_x \\\x01\xff";
  for (const char* name : {"heading", "tracking", "terrain_height", "level_turn"}) {
    const std::string text = ReadFile(Example(name));
    for (int i = 0; i < 150; ++i) {
      ReadMutant(text.substr(0, below(text.size())));
      std::string mutant = text;
      for (std::size_t k = 0; k <= below(4); ++k)
        mutant[below(mutant.size())] = alphabet[below(alphabet.size())];
      ReadMutant(mutant);
      const std::size_t from = below(text.size()), length = below(60), to = below(text.size());
      mutant = text;
      mutant.insert(to, text.substr(from, length));
      ReadMutant(mutant);
    }
  }
}

TEST(TaskFileTest, SurvivesDepthAndLength) {
  const std::string text = ReadFile(Example("heading"));
  for (const int depth : {50, 1000, 10000}) {
    std::string arrays = "x = ", tables = "x = ", dotted = "x";
    for (int i = 0; i < depth; ++i) {
      arrays += "[";
      tables += "{a=";
      dotted += ".a";
    }
    for (const std::string& deep : {arrays, tables, dotted + " = 1\n" + text}) {
      EXPECT_THROW(ReadTaskFile(deep, "deep.toml", kTables), Error) << depth;
    }
    // Behind a table of settings, which are read later.
    ReadMutant(text + "\n" + dotted + " = 1");
    ReadMutant(text + "\n[" + dotted + "]");
  }
  const std::string reward = "\n[[reward]]\nweight = 1\nquantity = ";
  ReadMutant(text + reward + "\"" + std::string(30000, 'x') + "\"");
  std::string names = "\"one\"";
  for (int i = 0; i < 5000; ++i) names += ", \"one\"";
  EXPECT_THROW(ReadTaskFile(text + reward + "[" + names + "]", "wide.toml", kTables), Error);
}

}  // namespace
}  // namespace skein
