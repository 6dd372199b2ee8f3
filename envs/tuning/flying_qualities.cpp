// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/flying_qualities.h"

#include <algorithm>
#include <cmath>
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
  /// The mode that swings and is mostly of them; nullptr without any that swings.
  const LinearMode* SwingingIn(const std::vector<int>& columns) const {
    const LinearMode* most = nullptr;
    for (const LinearMode& mode : modes) {
      if (!mode.swings()) continue;
      if (most == nullptr || ShareOf(mode, columns) > ShareOf(*most, columns)) most = &mode;
    }
    return most;
  }
  /// Of the slow modes, of path and attitude, the one that decays least or grows fastest; nullptr
  /// without a slow one.
  const LinearMode* LeastStable() const {
    constexpr double kSlow = 0.3;  // rad/s
    const LinearMode* least = nullptr;
    for (const LinearMode& mode : modes) {
      if (mode.frequency_rad_s() > kSlow) continue;
      if (least == nullptr || mode.eigenvalue.real() > least->eigenvalue.real()) least = &mode;
    }
    return least;
  }
};

// Outputs of closed_loop_outputs.h.
constexpr int kPitchRateOutput = 3, kRollRateOutput = 2;

/// Of what a trial flight recorded after a step; where it started is the trim's value.
StepResponse MeasureStep(const std::vector<double>& values, double start, double size) {
  StepResponse response;
  response.size = size;
  response.reached = values.back() - start;
  const auto first = [&](double share) {
    const auto found = std::find_if(values.begin(), values.end(), [&](double value) {
      return (value - start) / response.reached >= share;
    });
    return kTrialInterval * static_cast<double>(found - values.begin() + 1);
  };
  response.rise_s = response.reached == 0 ? std::nan("") : first(0.9) - first(0.1);
  double most = 0;
  for (const double value : values) most = std::max(most, (value - start) / response.reached);
  response.overshoot = most - 1;
  return response;
}

/// Seconds until the bank has changed by 90 deg, with full roll stick.
double TimeToBank90(const Plant& plant, const TrimPoint& trim) {
  constexpr double kSeconds = 5, kBank = 90;
  const TrialFlight flight = FlyTrial(plant, trim, kSeconds, Held(0, 1, 0));
  for (std::size_t i = 0; i < flight.bank.size(); ++i) {
    const double change = flight.bank[i] - trim.bank_rad * kDegPerRad;
    if (change >= kBank || change < -kBank) return flight.time[i];
  }
  return std::numeric_limits<double>::infinity();
}

void AssessPitch(const Plant& plant, const TrimPoint& trim, FlyingQualities* qualities) {
  const LinearFlight bare = LineariseFlight(plant, trim, FlapMotion::kScheduled);
  const double inverse_T = -bare.A(kAngleOfAttack, kAngleOfAttack);
  const Axis axis(plant, trim, LoopAxis::kLongitudinal);
  qualities->short_period = FitShortPeriod(axis.From(0, kPitchRateOutput), inverse_T);
  const double frequency = qualities->short_period.frequency_rad_s;
  qualities->load_factor_by_alpha = bare.C(0, kAngleOfAttack);
  const double anticipation = frequency * frequency / qualities->load_factor_by_alpha;
  auto& requirements = qualities->requirements;
  requirements.push_back({"3.2.2.1.1", "control anticipation (frequency^2 over n/alpha)",
                          "1/(g s2)", anticipation, AnticipationLevel(anticipation, frequency),
                          "0.28 to 3.6 and 1 rad/s; 0.16 to 10 and 0.6 rad/s; from 0.16"});
  requirements.push_back({"3.2.2.1.2", "short-period damping", "1",
                          qualities->short_period.damping_ratio,
                          ShortPeriodDampingLevel(qualities->short_period.damping_ratio),
                          "0.35 to 1.3; 0.25 to 2; from 0.15"});
  const LinearMode* phugoid = axis.LeastStable();
  if (phugoid == nullptr) return;
  const double damping = phugoid->damping_ratio(), doubles = phugoid->time_to_double_s();
  Requirement requirement{"3.2.1.2",
                          "phugoid damping",
                          "1",
                          damping,
                          PhugoidLevel(damping, doubles),
                          "from 0.04; from 0; doubles from 55 s"};
  if (!phugoid->swings()) {
    requirement.what = "phugoid, which does not swing: time to double";
    requirement.unit = "s";
    requirement.value = doubles;
  }
  requirements.push_back(requirement);
}

void AssessLateral(const Plant& plant, const TrimPoint& trim, FlyingQualities* qualities) {
  const Axis axis(plant, trim, LoopAxis::kLateral);
  auto& requirements = qualities->requirements;
  if (const LinearMode* mode = axis.SwingingIn({kV, kR})) {
    qualities->dutch_roll = *mode;
    const double frequency = mode->frequency_rad_s(), damping = mode->damping_ratio();
    const int level = DutchRollLevel(damping, frequency);
    requirements.push_back(
        {"3.3.1.1", "Dutch roll damping", "1", damping, level, "from 0.19; from 0.02; from 0"});
    requirements.push_back({"3.3.1.1", "Dutch roll frequency", "rad/s", frequency, level,
                            "from 1, damping x frequency from 0.35; from 0.4, 0.05; from 0.4"});
  }
  qualities->roll = FitRoll(axis.From(0, kRollRateOutput));
  requirements.push_back({"3.3.1.2", "roll mode time constant", "s",
                          qualities->roll.time_constant_s,
                          RollModeLevel(qualities->roll.time_constant_s), "to 1; to 1.4; to 10"});
  if (const LinearMode* spiral = axis.LeastStable()) {
    const double doubles = spiral->time_to_double_s();
    requirements.push_back({"3.3.1.3", "spiral: time to double", "s", doubles, SpiralLevel(doubles),
                            "from 12; from 8; from 4"});
  }
  qualities->bank_90_s = TimeToBank90(plant, trim);
  requirements.push_back({"3.3.4.1", "full stick to 90 deg of bank", "s", qualities->bank_90_s,
                          RollPerformanceLevel(qualities->bank_90_s), "to 1.3; to 1.7; to 2.6"});
}

}  // namespace

int ShortPeriodDampingLevel(double damping_ratio) {
  if (damping_ratio >= 0.35 && damping_ratio <= 1.3) return 1;
  if (damping_ratio >= 0.25 && damping_ratio <= 2) return 2;
  return damping_ratio >= 0.15 ? 3 : 4;
}

int AnticipationLevel(double anticipation, double frequency_rad_s) {
  if (anticipation >= 0.28 && anticipation <= 3.6 && frequency_rad_s >= 1) return 1;
  if (anticipation >= 0.16 && anticipation <= 10 && frequency_rad_s >= 0.6) return 2;
  return anticipation >= 0.16 ? 3 : 4;
}

int PhugoidLevel(double damping_ratio, double time_to_double_s) {
  if (damping_ratio >= 0.04) return 1;
  if (damping_ratio >= 0) return 2;
  return time_to_double_s >= 55 ? 3 : 4;
}

int DutchRollLevel(double damping_ratio, double frequency_rad_s) {
  const double product = damping_ratio * frequency_rad_s;
  if (damping_ratio >= 0.19 && product >= 0.35 && frequency_rad_s >= 1) return 1;
  if (damping_ratio >= 0.02 && product >= 0.05 && frequency_rad_s >= 0.4) return 2;
  return damping_ratio >= 0 && frequency_rad_s >= 0.4 ? 3 : 4;
}

int RollModeLevel(double time_constant_s) {
  if (time_constant_s <= 1) return 1;
  if (time_constant_s <= 1.4) return 2;
  return time_constant_s <= 10 ? 3 : 4;
}

int SpiralLevel(double time_to_double_s) {
  if (time_to_double_s >= 12) return 1;
  if (time_to_double_s >= 8) return 2;
  return time_to_double_s >= 4 ? 3 : 4;
}

int RollPerformanceLevel(double bank_90_s) {
  if (bank_90_s <= 1.3) return 1;
  if (bank_90_s <= 1.7) return 2;
  return bank_90_s <= 2.6 ? 3 : 4;
}

FlyingQualities AssessFlyingQualities(const Plant& plant, const TrimPoint& trim) {
  constexpr double kPitchStick = 0.1, kRollStick = 0.2, kPitchSeconds = 3, kRollSeconds = 2;
  FlyingQualities qualities;
  AssessPitch(plant, trim, &qualities);
  AssessLateral(plant, trim, &qualities);
  const TrialFlight pitch = FlyTrial(plant, trim, kPitchSeconds, Held(kPitchStick, 0, 0));
  const double level = plant.Evaluate(trim.state, trim.controls).nz;
  qualities.pitch_step = MeasureStep(pitch.nz, level, kPitchStick);
  const TrialFlight roll = FlyTrial(plant, trim, kRollSeconds, Held(0, kRollStick, 0));
  qualities.roll_step = MeasureStep(roll.p, 0, kRollStick);
  for (const auto& [where, name] : kLoopBreaks) {
    qualities.loops.push_back(
        {where, FindLoopMargins(BreakLoop(plant, trim, where, kTrialInterval))});
  }
  return qualities;
}

}  // namespace skein
