// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/flying_qualities.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "envs/reference/linear_flight.h"
#include "envs/state/state.h"
#include "envs/tuning/closed_loop_model.h"
#include "envs/tuning/closed_loop_outputs.h"
#include "envs/tuning/trial_flight.h"

namespace skein {
namespace {

/// The axes of a closed loop, with what is measured of them.
struct Axis {
  ClosedLoopModel model;
  ClosedLoopOutputs outputs;
  std::vector<LinearMode> modes;

  Axis(const Plant& plant, const TrimPoint& trim, LoopAxis axis)
      : model(LineariseClosedLoop(plant, trim, axis, kTrialInterval, false)),
        outputs(LineariseOutputs(plant, trim, axis, model)),
        modes(model.ModesWithShares()) {}

  SampledSystem From(int input, int output) const {
    return {model.A, model.B.col(input), outputs.C.row(output), model.dt};
  }
  /// The share of a mode that is of some columns of the memory.
  double ShareOf(const LinearMode& mode, const std::vector<int>& columns) const {
    double share = 0;
    for (std::size_t i = 0; i < mode.shares.size(); ++i) {
      const bool counts =
          std::find(columns.begin(), columns.end(), model.columns[i]) != columns.end();
      if (counts) share += mode.shares[i];
    }
    return share;
  }
  /// The oscillatory mode that is mostly of them; nullptr without an oscillatory one.
  const LinearMode* OscillatoryIn(const std::vector<int>& columns) const {
    const LinearMode* most = nullptr;
    for (const LinearMode& mode : modes) {
      if (!mode.is_oscillatory()) continue;
      if (most == nullptr || ShareOf(mode, columns) > ShareOf(*most, columns)) most = &mode;
    }
    return most;
  }
};

/// Whether it is of path and attitude.
bool IsSlow(const LinearMode& mode) {
  constexpr double kSlow = 0.3;  // rad/s
  return mode.frequency_rad_s() <= kSlow;
}

/// A divergence of airspeed may be fast; what is fast and decays is of filters and actuators.
bool IsAperiodicAirspeed(const LinearMode& mode) {
  return !mode.is_oscillatory() && (IsSlow(mode) || mode.eigenvalue.real() > 0);
}

bool IsPhugoid(const LinearMode& mode) { return mode.is_oscillatory() && IsSlow(mode); }

/// Whether no pilot bears it: what grows and swings faster than a phugoid, and what diverges faster
/// than 3.2.1.1 has it of an airspeed of level 3.
bool IsUnstable(const LinearMode& mode) {
  constexpr double kGrowth = 0.02;    // 1/s: a phugoid that is a little too fast to be slow
  constexpr double kLeastDouble = 6;  // s
  if (!mode.is_oscillatory()) return mode.time_to_double_s() < kLeastDouble;
  return !IsSlow(mode) && mode.eigenvalue.real() > kGrowth;
}

/// Of the modes that count, the one that decays least or grows fastest; nullptr without one.
const LinearMode* LeastStable(const std::vector<LinearMode>& modes,
                              bool (*counts)(const LinearMode& mode)) {
  const LinearMode* least = nullptr;
  for (const LinearMode& mode : modes) {
    if (!counts(mode)) continue;
    if (least == nullptr || mode.eigenvalue.real() > least->eigenvalue.real()) least = &mode;
  }
  return least;
}

// Outputs of closed_loop_outputs.h.
constexpr int kPitchRateOutput = 3, kRollRateOutput = 2;

constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

/// What `sticks` add to what is measured of a flight with hands off.
std::vector<double> AddedBy(const Sticks& sticks, const Plant& plant, const TrimPoint& trim,
                            double seconds, std::vector<double> TrialFlight::*measured) {
  std::vector<double> added = FlyTrial(plant, trim, seconds, sticks).*measured;
  const std::vector<double> hands_off = FlyTrial(plant, trim, seconds, HandsOff()).*measured;
  std::transform(added.begin(), added.end(), hands_off.begin(), added.begin(), std::minus<>());
  return added;
}

/// Seconds until the bank has changed by `bank_deg`, with full roll stick.
double TimeToBank(const Plant& plant, const TrimPoint& trim, double bank_deg) {
  constexpr double kSeconds = 8;
  const TrialFlight flight = FlyTrial(plant, trim, kSeconds, Held(0, 1, 0));
  for (std::size_t i = 0; i < flight.bank.size(); ++i) {
    const double change = flight.bank[i] - trim.bank_rad * kDegPerRad;
    if (change >= bank_deg || change < -bank_deg) return flight.time[i];
  }
  return std::numeric_limits<double>::infinity();
}

std::string Figure(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// "from 0.16", "0.16 to 10", "to 10".
std::string Span(double least, double most) {
  if (std::isinf(most)) return "from " + Figure(least);
  return (least > 0 ? Figure(least) + " " : "") + "to " + Figure(most);
}

/// What `of` says of the levels, one after the other.
template <typename Of>
std::string OfLevels(const Of& of) {
  return of(0) + "; " + of(1) + "; " + of(2);
}

std::string FromLevels(const LevelLimit& least) {
  return OfLevels([&](std::size_t level) { return "from " + Figure(least[level]); });
}

std::string ToLevels(const LevelLimit& most) {
  return OfLevels([&](std::size_t level) { return "to " + Figure(most[level]); });
}

std::string AirspeedDivergenceText(const LevelLimits& limits) {
  return OfLevels([&](std::size_t level) {
    const double least = limits.airspeed_double_min_s[level];
    return std::isinf(least) ? "no divergence" : "from " + Figure(least);
  });
}

std::string PhugoidText(const LevelLimits& limits) {
  return "from " + Figure(limits.phugoid_damping_min[0]) + "; from " +
         Figure(limits.phugoid_damping_min[1]) + "; time to double from " +
         Figure(limits.phugoid_double_min_s) + " s";
}

std::string AnticipationText(const LevelLimits& limits) {
  return OfLevels([&](std::size_t level) {
    const double frequency = limits.short_period_frequency_min[level],
                 load_factor = limits.load_factor_by_alpha_min[level];
    return Span(limits.anticipation_min[level], limits.anticipation_max[level]) +
           (frequency > 0 ? " and " + Figure(frequency) + " rad/s" : "") +
           (load_factor > 0 ? ", n/alpha " + Figure(load_factor) : "");
  });
}

std::string DutchRollText(const LevelLimits& limits) {
  return OfLevels([&](std::size_t level) {
    const double product = limits.dutch_roll_product_min[level];
    return "from " + Figure(limits.dutch_roll_frequency_min[level]) +
           (product > 0 ? (level == 0 ? ", damping x frequency from " : ", ") + Figure(product)
                        : "");
  });
}

Requirement EquivalentDelay(const char* what, double delay_s, bool is_doubtful,
                            const LevelLimits& limits) {
  return {"3.5.3",
          what,
          "s",
          delay_s,
          EquivalentDelayLevel(limits, delay_s),
          ToLevels(limits.equivalent_delay_max_s),
          is_doubtful};
}

void AssessShortPeriod(const Plant& plant, const TrimPoint& trim, const Axis& axis,
                       const LevelLimits& limits, FlyingQualities* qualities) {
  const LinearFlight bare = LineariseFlight(plant, trim, FlapMotion::kScheduled);
  const double inverse_T = -bare.A(kAngleOfAttack, kAngleOfAttack);
  qualities->short_period = qualities->unstable_mode
                                ? EquivalentShortPeriod{kNoFigure, kNoFigure, kNoFigure, kNoFigure}
                                : FitShortPeriod(axis.From(0, kPitchRateOutput), inverse_T);
  const double frequency = qualities->short_period.frequency_rad_s;
  const double damping = qualities->short_period.damping_ratio;
  const double load_factor = qualities->load_factor_by_alpha = bare.C(0, kAngleOfAttack);
  const double anticipation = frequency * frequency / load_factor;
  const bool is_doubtful = qualities->short_period.mismatch > kMostMismatch;
  auto& requirements = qualities->requirements;
  requirements.push_back({"3.2.2.1.1", "control anticipation parameter (CAP)", "1/(g s2)",
                          anticipation,
                          AnticipationLevel(limits, anticipation, frequency, load_factor),
                          AnticipationText(limits), is_doubtful});
  requirements.push_back({"3.2.2.1.2", "short-period damping", "1", damping,
                          ShortPeriodDampingLevel(limits, damping),
                          OfLevels([&](std::size_t level) {
                            return Span(limits.short_period_damping_min[level],
                                        limits.short_period_damping_max[level]);
                          }),
                          is_doubtful});
  requirements.push_back(EquivalentDelay("equivalent delay of pitch",
                                         qualities->short_period.delay_s, is_doubtful, limits));
}

void AssessPitch(const Plant& plant, const TrimPoint& trim, const Axis& axis,
                 const LevelLimits& limits, FlyingQualities* qualities) {
  AssessShortPeriod(plant, trim, axis, limits, qualities);
  for (const Requirement& requirement : AssessAirspeed(axis.modes, limits)) {
    qualities->requirements.push_back(requirement);
  }
}

void AssessDutchRoll(const Axis& axis, const LevelLimits& limits, FlyingQualities* qualities) {
  const LinearMode* const mode = axis.OscillatoryIn({kV, kR});
  if (mode == nullptr) return;
  qualities->dutch_roll = *mode;
  const double frequency = mode->frequency_rad_s(), damping = mode->damping_ratio();
  const int level = DutchRollLevel(limits, damping, frequency);
  qualities->requirements.push_back({"3.3.1.1", "Dutch roll damping", "1", damping, level,
                                     FromLevels(limits.dutch_roll_damping_min)});
  qualities->requirements.push_back(
      {"3.3.1.1", "Dutch roll frequency", "rad/s", frequency, level, DutchRollText(limits)});
}

void AssessRoll(const Axis& axis, const LevelLimits& limits, FlyingQualities* qualities) {
  qualities->roll = qualities->unstable_mode ? EquivalentRoll{kNoFigure, kNoFigure, kNoFigure}
                                             : FitRoll(axis.From(0, kRollRateOutput));
  const double time = qualities->roll.time_constant_s;
  const bool is_doubtful = qualities->roll.mismatch > kMostMismatch;
  qualities->requirements.push_back({"3.3.1.2", "roll mode time constant", "s", time,
                                     RollModeLevel(limits, time), ToLevels(limits.roll_time_max_s),
                                     is_doubtful});
  qualities->requirements.push_back(
      EquivalentDelay("equivalent delay of roll", qualities->roll.delay_s, is_doubtful, limits));
}

void AssessLateral(const Plant& plant, const TrimPoint& trim, const Axis& axis,
                   const LevelLimits& limits, FlyingQualities* qualities) {
  AssessDutchRoll(axis, limits, qualities);
  AssessRoll(axis, limits, qualities);
  auto& requirements = qualities->requirements;
  if (const LinearMode* spiral = LeastStable(axis.modes, IsSlow)) {
    const double time_to_double = spiral->time_to_double_s();
    requirements.push_back({"3.3.1.3", "spiral: time to double", "s", time_to_double,
                            SpiralLevel(limits, time_to_double),
                            FromLevels(limits.spiral_double_min_s)});
  }
  qualities->bank_deg = limits.bank_deg;
  qualities->bank_s = TimeToBank(plant, trim, limits.bank_deg);
  requirements.push_back({limits.roll_paragraph,
                          "full stick to " + Figure(limits.bank_deg) + " deg of bank", "s",
                          qualities->bank_s, RollPerformanceLevel(limits, qualities->bank_s),
                          ToLevels(limits.bank_time_max_s)});
}

}  // namespace

StepResponse MeasureStep(const std::vector<double>& added, double size) {
  StepResponse response;
  response.size = size;
  response.reached = added.back();
  if (!std::isfinite(response.reached) || response.reached == 0) {
    response.rise_s = response.overshoot = std::nan("");
    return response;
  }
  const auto first = [&](double share) {
    const auto found = std::find_if(added.begin(), added.end(), [&](double value) {
      return value / response.reached >= share;
    });
    return kTrialInterval * static_cast<double>(found - added.begin() + 1);
  };
  response.rise_s = first(0.9) - first(0.1);
  double most = 0;
  for (const double value : added) most = std::max(most, value / response.reached);
  response.overshoot = most - 1;
  return response;
}

std::vector<Requirement> AssessAirspeed(const std::vector<LinearMode>& modes,
                                        const LevelLimits& limits) {
  std::vector<Requirement> requirements;
  if (const LinearMode* mode = LeastStable(modes, IsAperiodicAirspeed)) {
    const double time_to_double = mode->time_to_double_s();
    requirements.push_back({"3.2.1.1", "airspeed divergence: time to double", "s", time_to_double,
                            AirspeedDivergenceLevel(limits, time_to_double),
                            AirspeedDivergenceText(limits)});
  }
  if (const LinearMode* phugoid = LeastStable(modes, IsPhugoid)) {
    const double damping = phugoid->damping_ratio();
    requirements.push_back({"3.2.1.2", "phugoid damping", "1", damping,
                            PhugoidLevel(limits, damping, phugoid->time_to_double_s()),
                            PhugoidText(limits)});
  }
  return requirements;
}

FlyingQualities AssessFlyingQualities(const Plant& plant, const TrimPoint& trim,
                                      const LevelLimits& limits) {
  constexpr double kPitchStick = 0.1, kRollStick = 0.2, kPitchSeconds = 3, kRollSeconds = 2;
  const Axis pitch(plant, trim, LoopAxis::kLongitudinal), lateral(plant, trim, LoopAxis::kLateral);
  FlyingQualities qualities;
  std::vector<LinearMode> modes = pitch.modes;
  modes.insert(modes.end(), lateral.modes.begin(), lateral.modes.end());
  if (const LinearMode* mode = LeastStable(modes, IsUnstable)) qualities.unstable_mode = *mode;
  AssessPitch(plant, trim, pitch, limits, &qualities);
  AssessLateral(plant, trim, lateral, limits, &qualities);
  qualities.pitch_step = MeasureStep(
      AddedBy(Held(kPitchStick, 0, 0), plant, trim, kPitchSeconds, &TrialFlight::nz), kPitchStick);
  qualities.roll_step = MeasureStep(
      AddedBy(Held(0, kRollStick, 0), plant, trim, kRollSeconds, &TrialFlight::p), kRollStick);
  if (qualities.unstable_mode) return qualities;
  for (const auto& [where, name] : kLoopBreaks) {
    qualities.loops.push_back(
        {where, FindLoopMargins(BreakLoop(plant, trim, where, kTrialInterval))});
  }
  return qualities;
}

}  // namespace skein
