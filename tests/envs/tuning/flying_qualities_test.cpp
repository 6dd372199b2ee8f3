// SPDX-License-Identifier: Apache-2.0
// Margins and equivalent systems of loops whose figures follow from formulas, and the levels of
// MIL-F-8785C at their limits.
#include "envs/tuning/flying_qualities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "envs/aircraft/registry.h"
#include "envs/tuning/trial_flight.h"
#include "tests/envs/f16_at.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

/// gain exp(-steps dt s) / s, sampled: a loop of an integrator and a delay.
SampledSystem DelayedIntegrator(double gain, int steps, double dt) {
  const long size = steps + 1;
  SampledSystem system{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size),
                       Eigen::RowVectorXd::Zero(size), dt};
  system.A(0, 0) = 1;
  system.c[0] = gain * dt;
  if (steps == 0) {
    system.b[0] = 1;
    return system;
  }
  system.A(0, 1) = 1;
  for (long i = 1; i + 1 < size; ++i) system.A(i, i + 1) = 1;
  system.b[size - 1] = 1;
  return system;
}

TEST(LoopMargins, OfAnIntegratorWithDelayFollowTheFormula) {
  constexpr Tolerance kSampling{0.02, "second order in the step, and interpolation"};
  constexpr double kGain = 2, kDt = 0.01;
  constexpr int kSteps = 20;
  const LoopMargins margins = FindLoopMargins(DelayedIntegrator(kGain, kSteps, kDt));
  const double delay = (kSteps + 0.5) * kDt;  // the hold's half step, too
  // |L| is one at the gain; the phase is -90 deg less the delay's; it is -180 at pi / (2 delay).
  EXPECT_NEAR(margins.crossover_rad_s, kGain, kSampling * kGain);
  EXPECT_NEAR(margins.phase_deg, 90 - kGain * delay * kDegPerRad, kSampling * 90);
  EXPECT_NEAR(margins.delay_s, margins.phase_deg / kDegPerRad / kGain, kSampling * delay);
  const double limit = M_PI / 2 / delay;
  EXPECT_NEAR(margins.gain_up_db, 20 * std::log10(limit / kGain), kSampling * 10);
  EXPECT_TRUE(std::isinf(margins.gain_down_db));
}

// The gain margin of the real loop is the gain that makes it unstable.
TEST(LoopMargins, AreWhereTheAircraftBecomesUnstable) {
  constexpr double kSlight = 0.02;
  // Phugoid and spiral may grow slowly, with any gain: factor of a step.
  constexpr double kSlowest = 1 + 3e-4;
  const Plant plant(LoadAircraft("f16"), AtmosphereModel::kStevensLewis);
  TrimRequest request;
  request.altitude_ft = 15000;
  request.true_airspeed_ft_s = 500;
  const TrimPoint trim = Trim(plant, request);
  for (const auto& [where, name] : kLoopBreaks) {
    const SampledSystem loop = BreakLoop(plant, trim, where, kTrialInterval);
    const LoopMargins margins = FindLoopMargins(loop);
    ASSERT_TRUE(std::isfinite(margins.gain_up_db)) << name;
    const double limit = std::pow(10, margins.gain_up_db / 20);
    const auto fastest_growth = [&loop](double gain) {
      const Eigen::MatrixXd closed = loop.A - gain * loop.b * loop.c;
      return FindLinearModes(closed).back().frequency_rad_s();  // the largest eigenvalue
    };
    EXPECT_LT(fastest_growth(limit * (1 - kSlight)), kSlowest) << name;
    EXPECT_GT(fastest_growth(limit * (1 + kSlight)), kSlowest) << name;
  }
}

/// x'' + 2 damping frequency x' + frequency^2 x = u, u held over steps; output x' + lead x.
SampledSystem SecondOrder(double frequency, double damping, double lead, double dt) {
  // Small steps of a Taylor series of the matrix exponential.
  Eigen::Matrix3d rate = Eigen::Matrix3d::Zero();
  rate(0, 1) = 1;
  rate(1, 0) = -frequency * frequency;
  rate(1, 1) = -2 * damping * frequency;
  rate(1, 2) = 1;
  Eigen::Matrix3d power = Eigen::Matrix3d::Identity(), sum = power;
  for (int i = 1; i < 12; ++i) {
    power = power * rate * dt / i;
    sum += power;
  }
  return {sum.topLeftCorner(2, 2), sum.topRightCorner(2, 1), Eigen::RowVector2d(lead, 1), dt};
}

TEST(EquivalentSystem, FindsTheSystemThatItIsGiven) {
  constexpr Tolerance kFit{0.01, "of the search"};
  constexpr Tolerance kHold{2e-3, "of the search and the hold, s"};
  constexpr double kDt = 0.02;
  const auto pitch = FitShortPeriod(SecondOrder(4, 0.6, 0.8, kDt), 0.8);
  EXPECT_NEAR(pitch.frequency_rad_s, 4, 4 * kFit);
  EXPECT_NEAR(pitch.damping_ratio, 0.6, kFit);
  EXPECT_NEAR(pitch.delay_s, kDt / 2, kHold);  // a held input lags by half a step
  EXPECT_LT(pitch.mismatch, 0.1);
  SampledSystem roll{Eigen::MatrixXd(1, 1), Eigen::VectorXd(1), Eigen::RowVectorXd(1), kDt};
  roll.A << std::exp(-kDt / 0.4);
  roll.b << 1;
  roll.c << 3;
  EXPECT_NEAR(FitRoll(roll).time_constant_s, 0.4, 0.4 * kFit);
}

TEST(StepResponse, IsMeasuredOfWhatIsReached) {
  constexpr Tolerance kRounding{1e-12, "float64 rounding"};
  // To 10, in tenths, with a peak of 12 on the way.
  const StepResponse response = MeasureStep({1, 5, 9, 12, 10, 10}, 0.2);
  EXPECT_EQ(response.size, 0.2);
  EXPECT_EQ(response.reached, 10);
  EXPECT_NEAR(response.rise_s, 2 * kTrialInterval, kRounding);
  EXPECT_NEAR(response.overshoot, 0.2, kRounding);
}

TEST(StepResponse, HasNoRiseAndNoOvershootWhereNothingIsReached) {
  for (const double last : {std::nan(""), HUGE_VAL, -HUGE_VAL, 0.0}) {
    const StepResponse response = MeasureStep({1, 5, last}, 0.1);
    EXPECT_TRUE(std::isnan(response.rise_s)) << last;
    EXPECT_TRUE(std::isnan(response.overshoot)) << last;
  }
}

TEST(FlyingQualities, LevelsEndWhereTheStandardEndsThem) {
  const LevelLimits limits = LimitsOf(AirplaneClass::kIV, FlightPhaseCategory::kA);
  EXPECT_EQ(ShortPeriodDampingLevel(limits, 0.35), 1);
  EXPECT_EQ(ShortPeriodDampingLevel(limits, 0.349), 2);
  EXPECT_EQ(ShortPeriodDampingLevel(limits, 2.1), 3);
  EXPECT_EQ(ShortPeriodDampingLevel(limits, 0.1), 4);
  EXPECT_EQ(AnticipationLevel(limits, 0.28, 1, 1), 1);
  EXPECT_EQ(AnticipationLevel(limits, 0.28, 0.9, 1), 2);
  EXPECT_EQ(AnticipationLevel(limits, 5, 3, 1), 2);
  EXPECT_EQ(AnticipationLevel(limits, 11, 9, 1), 3);
  EXPECT_EQ(AnticipationLevel(limits, 0.1, 3, 1), 4);
  EXPECT_EQ(AirspeedDivergenceLevel(limits, INFINITY), 1);
  EXPECT_EQ(AirspeedDivergenceLevel(limits, 6), 3);
  EXPECT_EQ(AirspeedDivergenceLevel(limits, 5.9), 4);
  EXPECT_EQ(PhugoidLevel(limits, 0.04, INFINITY), 1);
  EXPECT_EQ(PhugoidLevel(limits, 0, INFINITY), 2);
  EXPECT_EQ(PhugoidLevel(limits, -0.01, 60), 3);
  EXPECT_EQ(PhugoidLevel(limits, -0.1, 50), 4);
  EXPECT_EQ(DutchRollLevel(limits, 0.19, 2), 1);
  EXPECT_EQ(DutchRollLevel(limits, 0.19, 1.5), 2) << "damping times frequency";
  EXPECT_EQ(DutchRollLevel(limits, 0.01, 2), 3);
  EXPECT_EQ(DutchRollLevel(limits, -0.01, 2), 4);
  EXPECT_EQ(RollModeLevel(limits, 1), 1);
  EXPECT_EQ(RollModeLevel(limits, 1.3), 2);
  EXPECT_EQ(RollModeLevel(limits, 11), 4);
  EXPECT_EQ(SpiralLevel(limits, INFINITY), 1);
  EXPECT_EQ(SpiralLevel(limits, 9), 2);
  EXPECT_EQ(SpiralLevel(limits, 3), 4);
  EXPECT_EQ(RollPerformanceLevel(limits, 1.3), 1);
  EXPECT_EQ(RollPerformanceLevel(limits, INFINITY), 4);
  EXPECT_EQ(EquivalentDelayLevel(limits, 0.1), 1);
  EXPECT_EQ(EquivalentDelayLevel(limits, 0.2), 2);
  EXPECT_EQ(EquivalentDelayLevel(limits, 0.25), 3);
  EXPECT_EQ(EquivalentDelayLevel(limits, 0.26), 4);
  EXPECT_EQ(EquivalentDelayLevel(limits, std::nan("")), 4);
}

/// Of class IV, category A.
FlyingQualities QualitiesAt(const Plant& plant, double altitude_ft, double speed_ft_s,
                            double flight_path_deg = 0) {
  TrimRequest request;
  request.altitude_ft = altitude_ft;
  request.true_airspeed_ft_s = speed_ft_s;
  request.flight_path_angle_rad = flight_path_deg / kDegPerRad;
  return AssessFlyingQualities(plant, Trim(plant, request),
                               LimitsOf(AirplaneClass::kIV, FlightPhaseCategory::kA));
}

constexpr const char* kOfEquivalents[] = {"3.2.2.1.1", "3.2.2.1.2", "3.3.1.2", "3.5.3"};

TEST(FlyingQualities, DelaysOfBothAxesAreJudged) {
  const FlyingQualities qualities = QualitiesAt(F16At(0.3), 5000, 1000);
  std::vector<double> delays;
  for (const Requirement& requirement : qualities.requirements) {
    if (requirement.paragraph != std::string("3.5.3")) continue;
    delays.push_back(requirement.value);
    EXPECT_EQ(requirement.is_doubtful,
              (delays.size() == 1 ? qualities.short_period.mismatch : qualities.roll.mismatch) >
                  kMostMismatch);
  }
  EXPECT_EQ(delays, (std::vector<double>{qualities.short_period.delay_s, qualities.roll.delay_s}));
}

TEST(FlyingQualities, AnUnstableClosedLoopHasNeitherMarginsNorLevelsOfEquivalentSystems) {
  const FlyingQualities sound = QualitiesAt(F16At(0.3), 5000, 1000);
  EXPECT_FALSE(sound.unstable_mode);
  EXPECT_EQ(sound.loops.size(), kLoopBreaks.size());
  Aircraft hot = F16();
  hot.flight_control.pitch_proportional_deg_per_g *= 6;
  const FlyingQualities qualities =
      QualitiesAt(Plant(hot, AtmosphereModel::kStevensLewis), 5000, 1000);
  ASSERT_TRUE(qualities.unstable_mode);
  EXPECT_TRUE(qualities.unstable_mode->is_oscillatory());
  EXPECT_LT(qualities.unstable_mode->time_to_double_s(), 1);
  EXPECT_TRUE(qualities.loops.empty());
  EXPECT_TRUE(std::isnan(qualities.short_period.damping_ratio));
  EXPECT_TRUE(std::isnan(qualities.roll.time_constant_s));
  for (const char* paragraph : kOfEquivalents) {
    int count = 0;
    for (const Requirement& requirement : qualities.requirements) {
      if (requirement.paragraph != std::string(paragraph)) continue;
      ++count;
      EXPECT_EQ(requirement.level, 4) << requirement.what;
    }
    EXPECT_GT(count, 0) << paragraph;
  }
}

// What drifts slowly has requirements of its own.
TEST(FlyingQualities, ASlowDivergenceIsNoInstability) {
  const Plant plant = F16At(0.3);
  EXPECT_FALSE(QualitiesAt(plant, 25000, 400).unstable_mode) << "airspeed doubles in 36 s";
  const std::optional<LinearMode> mode = QualitiesAt(plant, 35000, 400).unstable_mode;
  ASSERT_TRUE(mode);
  EXPECT_FALSE(mode->is_oscillatory());
  EXPECT_LT(mode->time_to_double_s(), 6);
}

// In a climb flight control leads the load factor of the trim, cos(60 deg), to 1 with hands off.
TEST(StepResponse, IsWithoutWhatTheFlightDoesByItself) {
  constexpr Tolerance kSpeedLost{0.05, "what a climb slows down in 3 s, relative"};
  const Plant plant = F16At(0.3);
  const double level = QualitiesAt(plant, 5000, 1000).pitch_step.reached;
  const double climbing = QualitiesAt(plant, 5000, 1000, 60).pitch_step.reached;
  EXPECT_GT(level, 0.5);
  EXPECT_NEAR(climbing / level, 1, kSpeedLost);
}

/// What is asked of the airspeed where the longitudinal modes have these eigenvalues, 1/s.
std::vector<Requirement> AirspeedOf(const std::vector<std::complex<double>>& eigenvalues) {
  std::vector<LinearMode> modes;
  for (const std::complex<double>& eigenvalue : eigenvalues) modes.push_back({eigenvalue, {}});
  return AssessAirspeed(modes, LimitsOf(AirplaneClass::kIV, FlightPhaseCategory::kA));
}

/// The rate of growth, 1/s, of what doubles in so many seconds.
double Growth(double time_to_double_s) { return std::log(2.0) / time_to_double_s; }

TEST(FlyingQualities, AnAperiodicAirspeedDivergenceIsOfItsOwnParagraph) {
  constexpr Tolerance kRounding{1e-12, "float64 rounding"};
  const struct {
    double eigenvalue;
    int level;
  } cases[] = {{-0.01, 1}, {Growth(115), 3}, {Growth(10), 3}, {Growth(4), 4}, {Growth(1), 4}};
  for (const auto& [eigenvalue, level] : cases) {
    const std::vector<Requirement> asked = AirspeedOf({eigenvalue, {-2, 3}});
    ASSERT_EQ(asked.size(), 1u) << eigenvalue;
    EXPECT_STREQ(asked[0].paragraph, "3.2.1.1");
    EXPECT_EQ(asked[0].level, level) << eigenvalue;
    if (eigenvalue > 0) {
      EXPECT_NEAR(asked[0].value * eigenvalue, std::log(2.0), kRounding);
    } else {
      EXPECT_EQ(asked[0].value, INFINITY);
    }
  }
}

TEST(FlyingQualities, AnOscillatoryPhugoidIsJudgedByItsDamping) {
  constexpr double kFrequency = 0.1;  // rad/s
  const struct {
    double growth;
    int level;
  } cases[] = {{-0.01, 1}, {-0.001, 2}, {Growth(60), 3}, {Growth(50), 4}};
  for (const auto& [growth, level] : cases) {
    const std::vector<Requirement> asked = AirspeedOf({{growth, kFrequency}, {-2, 3}});
    ASSERT_EQ(asked.size(), 1u) << growth;
    EXPECT_STREQ(asked[0].paragraph, "3.2.1.2");
    EXPECT_EQ(asked[0].level, level) << growth;
  }
}

// Each is of the least stable of its kind; what is fast and decays is not of the airspeed.
TEST(FlyingQualities, BothKindsOfAirspeedMotionAreJudged) {
  const std::vector<Requirement> asked =
      AirspeedOf({-0.02, Growth(10), {-0.01, 0.1}, {Growth(50), 0.1}, -5});
  ASSERT_EQ(asked.size(), 2u);
  EXPECT_EQ(asked[0].level, 3);
  EXPECT_EQ(asked[1].level, 4);
  EXPECT_TRUE(AirspeedOf({-5, {-2, 3}}).empty());
}

TEST(FlyingQualities, LevelsDependOnClassAndCategory) {
  const auto of = [](AirplaneClass airplane, FlightPhaseCategory category) {
    return LimitsOf(airplane, category);
  };
  const LevelLimits light = of(AirplaneClass::kI, FlightPhaseCategory::kC);
  EXPECT_EQ(AnticipationLevel(light, 0.16, 0.87, 2.7), 1);
  EXPECT_EQ(AnticipationLevel(light, 0.16, 0.87, 2.6), 2) << "n/alpha";
  EXPECT_EQ(AnticipationLevel(light, 0.16, 0.87, 1.7), 3);
  EXPECT_EQ(DutchRollLevel(light, 0.15, 1), 1);
  EXPECT_EQ(RollPerformanceLevel(light, 1.8), 2);
  EXPECT_EQ(light.bank_deg, 30);
  const LevelLimits cruise = of(AirplaneClass::kI, FlightPhaseCategory::kB);
  EXPECT_EQ(AnticipationLevel(cruise, 0.085, 0.3, 1), 1) << "frequency alone is not asked for";
  EXPECT_EQ(ShortPeriodDampingLevel(cruise, 1.9), 1);
  EXPECT_EQ(SpiralLevel(cruise, 19), 2);
  EXPECT_EQ(RollModeLevel(cruise, 1.4), 1);
  const LevelLimits heavy = of(AirplaneClass::kIII, FlightPhaseCategory::kC);
  EXPECT_EQ(DutchRollLevel(heavy, 0.2, 0.5), 1) << "a product of 0.1 is enough";
  EXPECT_EQ(RollModeLevel(heavy, 3), 2);
  EXPECT_STREQ(heavy.roll_paragraph, "3.3.4.2");
}

}  // namespace
}  // namespace skein
