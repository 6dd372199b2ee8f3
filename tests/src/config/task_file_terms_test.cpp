// SPDX-License-Identifier: Apache-2.0
// What the terms of task files come to in flight, by the formulas of docs/reference/task-files.md.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "envs/aircraft/aircraft.h"
#include "envs/control_step.h"
#include "envs/state/attitude.h"
#include "envs/step_memory.h"
#include "envs/vec_env.h"
#include "simd/random.h"
#include "simd/target.h"
#include "src/config/task_file.h"
#include "tests/extremes.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

// More than the 64 that terms are evaluated for at a time, and no multiple of any vector's lanes.
constexpr int kAircraft = 70;
constexpr int kStepsPerAction = 5, kSteps = 40 * kStepsPerAction;

/// A flight after a control step: what float32 holds, in double precision.
struct Flight {
  double north_ft = 0, east_ft = 0, altitude_ft = 0;
  double u_fps = 0, v_fps = 0, w_fps = 0;
  double p_rad_s = 0, q_rad_s = 0, r_rad_s = 0;
  double load_factor_g = 0;
  EulerAngles attitude;

  Flight(const Tile& state, int i) {
    const auto at = [&](int column) -> double { return state[column][i]; };
    north_ft = at(kNorth);
    east_ft = at(kEast);
    altitude_ft = -at(kDown);
    u_fps = at(kU);
    v_fps = at(kV);
    w_fps = at(kW);
    p_rad_s = at(kP);
    q_rad_s = at(kQ);
    r_rad_s = at(kR);
    load_factor_g = at(kNz);
    attitude = EulerFromQuaternion({at(kQ0), at(kQx), at(kQy), at(kQz)});
  }

  double p_deg_s() const { return kDegPerRad * p_rad_s; }
  double q_deg_s() const { return kDegPerRad * q_rad_s; }
  double r_deg_s() const { return kDegPerRad * r_rad_s; }
  double speed_fps() const { return std::hypot(u_fps, v_fps, w_fps); }
};

/// Is shown what a control step did to one aircraft.
using OnStep = std::function<void(int aircraft, const Flight&, double reward, Termination end)>;

class FlightObserver : public ControlStepObserver {
 public:
  explicit FlightObserver(OnStep on_step) : on_step_(std::move(on_step)) {}

  void See(const ControlStep& step) override {
    for (int i = 0; i < step.state.count; ++i) {
      on_step_(step.first_aircraft + i, Flight(step.state, i), step.reward[i],
               static_cast<Termination>(step.termination[i]));
    }
  }

 private:
  OnStep on_step_;
};

/// Flies the task of the terms with random actions, from banks of up to `bank_deg`. Flights that
/// end are followed by others.
void Fly(const std::string& terms, double bank_deg, const OnStep& on_step) {
  EnvConfig env;
  env.SetTermTask(ReadTaskFile("name = \"terms\"\n[observe]\n" + terms, "terms.toml", {}).terms);
  env.initial.training_bank_max_deg = bank_deg;
  VecEnv flights(env, kAircraft, 3);
  simd::RandomStream random({7, 0, 0, 0, simd::RandomPurpose::kActionNoise});
  StepMemory memory(kAircraft);
  std::vector<float> actions(static_cast<std::size_t>(kAircraft * flights.action_size()));
  FlightObserver observer(on_step);
  StepOutput output = memory.output();
  output.observer = &observer;
  for (int step = 0; step < kSteps; ++step) {
    if (step % kStepsPerAction == 0) {
      for (float& action : actions) action = static_cast<float>(random.Uniform(-0.7, 0.7));
    }
    flights.Step(0, actions.data(), output);
  }
}

constexpr const char* kTerrain =
    "[terrain]\n"
    "base_ft = 14000\n"
    "waves = [{height_ft = 600, wavelength_north_ft = 1500},\n"
    "{height_ft = 300, wavelength_north_ft = 2500, wavelength_east_ft = 1000, phase_deg = 50},\n"
    "{height_ft = 200, wavelength_east_ft = 1200, phase_deg = -30}]\n";

double TerrainFt(const Flight& of) {
  const auto wave = [](double height_ft, double turns, double phase_deg) {
    return height_ft * std::sin(2 * M_PI * turns + phase_deg / kDegPerRad);
  };
  return 14000 + wave(600, of.north_ft / 1500, 0) +
         wave(300, of.north_ft / 2500 + of.east_ft / 1000, 50) + wave(200, of.east_ft / 1200, -30);
}

double WithinTolerance(double x, double width, double margin) {
  if (std::abs(x) <= width) return 1;
  return margin > 0 ? std::max(0.0, 1 - (std::abs(x) - width) / margin) : 0;
}

double Gaussian(double x, double width) { return std::exp(-x * x / (2 * width * width)); }

// Of the F-16, by the page.
constexpr double kAltitudeErrorUnitFt = 1000 / 0.3048, kAltitudeUnitFt = 5000 / 0.3048;
constexpr double kSpeedUnitFps = 340 / 0.3048;

/// A term of a reward and its formula.
struct Term {
  const char* name;
  double weight;
  const char* keys;                ///< all others
  double (*shape)(const Flight&);  ///< by the page
  double lowest, highest;          ///< what flights must come to, for all of the formula to count
  double step_at_deg_s = 0;        ///< of abs(p); 0: none
};

std::ostream& operator<<(std::ostream& out, const Term& term) { return out << term.name; }

/// Of every shape and way to say what it is of.
std::vector<Term> Terms() {
  return {
      {"linear", -0.5, "quantity = \"p_deg_s\"\nunit = 10\nshape = \"linear\"\n",
       [](const Flight& of) { return of.p_deg_s() / 10; }, -2, 2},
      {"absolute", 0.75, "quantity = \"roll_deg\"\nunit = 30\nshape = \"absolute\"\n",
       [](const Flight& of) { return std::abs(of.attitude.roll * kDegPerRad / 30); }, 0.05, 2},
      {"by_default", -1, "quantity = \"q_rad_s\"\nunit = 0.1\n",
       [](const Flight& of) { return std::abs(of.q_rad_s / 0.1); }, 0.01, 0.5},
      {"squared", 1.25, "quantity = \"r_deg_s\"\nunit = 4\nshape = \"squared\"\n",
       [](const Flight& of) { return std::pow(of.r_deg_s() / 4, 2); }, 0.01, 1},
      {"gaussian", -1.5, "quantity = \"p_deg_s\"\nunit = 10\nshape = \"gaussian\"\nwidth = 1.5\n",
       [](const Flight& of) { return Gaussian(of.p_deg_s() / 10, 1.5); }, 0.3, 0.99},
      {"tolerance_with_margin", 1.75,
       "quantity = \"q_deg_s\"\nshape = \"tolerance\"\nwidth = 1\nmargin = 2.5\n",
       [](const Flight& of) { return WithinTolerance(of.q_deg_s(), 1, 2.5); }, 0, 1},
      {"tolerance_without_margin", -2, "quantity = \"p_deg_s\"\nshape = \"tolerance\"\nwidth = 8\n",
       [](const Flight& of) { return WithinTolerance(of.p_deg_s(), 8, 0); }, 0, 1, 8},
      {"norm", 2.25, "quantity = [\"u_fps\", \"v_fps\", \"w_fps\"]\nunit = \"speed\"\n",
       [](const Flight& of) { return of.speed_fps() / kSpeedUnitFps; }, 0.93, 1.05},
      {"gaussian_of_a_norm", -2.5,
       "quantity = [\"p_deg_s\", \"q_deg_s\", \"r_deg_s\"]\nunit = 10\n"
       "shape = \"gaussian\"\nwidth = 2\n",
       [](const Flight& of) {
         return Gaussian(std::hypot(of.p_deg_s(), of.q_deg_s(), of.r_deg_s()) / 10, 2);
       },
       0.5, 0.98},
      {"terrain", 0.25,
       "quantity = \"terrain_ft\"\nunit = \"altitude_error\"\nshape = \"linear\"\n",
       [](const Flight& of) { return TerrainFt(of) / kAltitudeErrorUnitFt; }, 4.1, 4.5},
      {"height_above_terrain", -3,
       "quantity = \"height_above_terrain_ft\"\nunit = \"altitude\"\nshape = \"squared\"\n",
       [](const Flight& of) {
         return std::pow((of.altitude_ft - TerrainFt(of)) / kAltitudeUnitFt, 2);
       },
       0.08, 0.14}};
}

/// Whether the rounding of float32 decides on which side of a step the flight is.
bool IsAtStep(const Term& term, const Flight& flight) {
  constexpr double kRoundingDegS = 1e-5;
  return term.step_at_deg_s > 0 &&
         std::abs(std::abs(flight.p_deg_s()) - term.step_at_deg_s) < kRoundingDegS;
}

std::string TextOf(const Term& term) {
  return fmt::format("[[reward]]\n{}weight = {}\n", term.keys, term.weight);
}

constexpr double kBankDeg = 60;  // of starts, so that flights turn east and west
constexpr Tolerance kFloat32{2e-6, "of a term: some 30 roundings to float32, one above the other"};

class TaskFileRewardTest : public testing::TestWithParam<std::tuple<simd::Target, Term>> {};

TEST_P(TaskFileRewardTest, IsTheFormulaOfItsShape) {
  const ScopedTarget target(std::get<0>(GetParam()));
  const Term& term = std::get<1>(GetParam());
  double lowest = INFINITY, highest = -INFINITY, worst = 0;
  int steps = 0;
  Fly(kTerrain + TextOf(term), kBankDeg,
      [&](int, const Flight& flight, double reward, Termination end) {
        if (end != Termination::kNone) return;  // there the reward is that of the end
        ++steps;
        const double shape = term.shape(flight);
        lowest = std::min(lowest, shape);
        highest = std::max(highest, shape);
        if (IsAtStep(term, flight)) return;
        const double size = std::abs(term.weight) * std::max(1.0, std::abs(shape));
        worst = Larger(worst, std::abs(reward - term.weight * shape) / size);
      });
  EXPECT_EQ(steps, kAircraft * kSteps) << "none ends";
  EXPECT_LE(worst, kFloat32);
  EXPECT_LE(lowest, term.lowest);
  EXPECT_GE(highest, term.highest);
}

INSTANTIATE_TEST_SUITE_P(Targets, TaskFileRewardTest,
                         testing::Combine(testing::ValuesIn(simd::SupportedTargets()),
                                          testing::ValuesIn(Terms())));

class TaskFileRewardsTest : public testing::TestWithParam<simd::Target> {};

TEST_P(TaskFileRewardsTest, AddUp) {
  const ScopedTarget target(GetParam());
  const std::vector<Term> terms = Terms();
  std::string text = kTerrain;
  for (const Term& term : terms) text += TextOf(term);
  double worst = 0;
  Fly(text, kBankDeg, [&](int, const Flight& flight, double reward, Termination) {
    double sum = 0, size = 0;
    for (const Term& term : terms) {
      if (IsAtStep(term, flight)) return;
      const double part = term.weight * term.shape(flight);
      sum += part;
      size += std::abs(part);
    }
    worst = Larger(worst, std::abs(reward - sum) / size);
  });
  EXPECT_LE(worst, kFloat32);
}

INSTANTIATE_TEST_SUITE_P(Targets, TaskFileRewardsTest, testing::ValuesIn(simd::SupportedTargets()));

/// A [[termination]].
struct End {
  const char* quantity;
  const char* condition;
  double limit;
  const char* as;  ///< null: not said
  Termination termination;
  double (*value)(const Flight&);  ///< of the quantity, by the page
  double rounding = 0;             ///< of float32 in it; 0 where it is what the state holds

  /// How far the quantity is past the limit; 0 or less: it is not.
  double Past(const Flight& flight) const {
    const std::string kind = condition;
    const double is = value(flight);
    if (kind == "below") return limit - is;
    return (kind == "beyond" ? std::abs(is) : is) - limit;
  }
  std::string Text() const {
    const std::string name = as == nullptr ? "" : fmt::format("as = \"{}\"\n", as);
    return fmt::format("[[termination]]\nquantity = \"{}\"\n{} = {}\n{}", quantity, condition,
                       limit, name);
  }
};

std::ostream& operator<<(std::ostream& out, const End& end) {
  return out << end.quantity << "_" << end.condition;
}

/// Of every condition and name. Limits of what the state holds are float32 themselves.
std::vector<End> Ends() {
  return {{"q_rad_s", "below", -0.03125, "low_speed", Termination::kLowSpeed,
           [](const Flight& of) { return of.q_rad_s; }},
          {"load_factor_g", "above", 2.5, "overload", Termination::kOverload,
           [](const Flight& of) { return of.load_factor_g; }},
          {"r_rad_s", "above", 0.03125, "extreme_state", Termination::kExtremeState,
           [](const Flight& of) { return of.r_rad_s; }},
          {"p_rad_s", "beyond", 0.5, nullptr, Termination::kExtremeState,
           [](const Flight& of) { return of.p_rad_s; }},
          {"height_above_terrain_ft", "below", 4600, "low_altitude", Termination::kLowAltitude,
           [](const Flight& of) { return of.altitude_ft - TerrainFt(of); }, 0.01},
          {"alpha_deg", "above", 1.875, "high_speed", Termination::kHighSpeed,
           [](const Flight& of) { return std::atan2(of.w_fps, of.u_fps) * kDegPerRad; }, 1e-5},
          {"roll_deg", "beyond", 25, "overload", Termination::kOverload,
           [](const Flight& of) { return of.attitude.roll * kDegPerRad; }, 1e-4}};
}

class TaskFileEndTest : public testing::TestWithParam<std::tuple<simd::Target, End>> {};

TEST_P(TaskFileEndTest, ComesInTheStepThatPassesTheLimitAndInNoOther) {
  const ScopedTarget target(std::get<0>(GetParam()));
  const End& end = std::get<1>(GetParam());
  const double failure_reward = EnvConfig().termination.failure_reward;
  std::vector<int> flown(kAircraft);
  int ends = 0, ends_above_0 = 0, undecided = 0, least_flown = kSteps;
  Fly(kTerrain + end.Text(), 0,
      [&](int aircraft, const Flight& flight, double reward, Termination termination) {
        int& steps = flown[static_cast<std::size_t>(aircraft)];
        ++steps;
        const double past = end.Past(flight);
        if (end.rounding > 0 && std::abs(past) <= end.rounding) {
          ++undecided;
        } else if (!HasFailure()) {
          const Termination expected = past > 0 ? end.termination : Termination::kNone;
          EXPECT_EQ(termination, expected) << past << " past the limit in step " << steps;
          EXPECT_EQ(reward, past > 0 ? failure_reward : 0);
        }
        if (termination == Termination::kNone) return;
        ++ends;
        ends_above_0 += end.value(flight) > 0;
        least_flown = std::min(least_flown, steps);
        steps = 0;
      });
  EXPECT_GT(ends, kAircraft / 4);
  EXPECT_GT(least_flown, 1) << "none begins past the limit";
  EXPECT_LE(undecided, 2);
  if (std::string(end.condition) == "beyond") {
    EXPECT_GT(std::min(ends_above_0, ends - ends_above_0), ends / 5) << "to either side";
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, TaskFileEndTest,
                         testing::Combine(testing::ValuesIn(simd::SupportedTargets()),
                                          testing::ValuesIn(Ends())));

}  // namespace
}  // namespace skein
