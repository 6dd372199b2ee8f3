// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/handling.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "envs/tuning/closed_loop_model.h"
#include "envs/tuning/trial_flight.h"

namespace skein {
namespace {

/// 1/s. Slower modes are judged by their time to double, the others by their damping ratio.
constexpr double kSlowest = 0.5;

double LeastDamping(const ClosedLoopModel& model) {
  double least = 1;
  for (const std::complex<double>& mode : model.Modes()) {
    if (std::abs(mode) >= kSlowest) least = std::min(least, DampingRatio(mode));
  }
  return least;
}

double LeastTimeToDouble(const ClosedLoopModel& model) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::complex<double>& mode : model.Modes()) {
    if (std::abs(mode) < kSlowest) least = std::min(least, TimeToDouble(mode));
  }
  return least;
}

void AssessLinear(const Plant& plant, const TrimPoint& trim, Handling* handling) {
  const auto model = [&](LoopAxis axis, bool delayed) {
    return LineariseClosedLoop(plant, trim, axis, kTrialInterval, delayed);
  };
  const ClosedLoopModel pitch = model(LoopAxis::kLongitudinal, false);
  const ClosedLoopModel lateral = model(LoopAxis::kLateral, false);
  handling->pitch_damping = LeastDamping(pitch);
  handling->lateral_damping = LeastDamping(lateral);
  handling->delayed_damping = std::min(LeastDamping(model(LoopAxis::kLongitudinal, true)),
                                       LeastDamping(model(LoopAxis::kLateral, true)));
  handling->time_to_double_s = std::min(LeastTimeToDouble(pitch), LeastTimeToDouble(lateral));
}

void AssessPitchStep(const Plant& plant, const TrimPoint& trim, Handling* handling) {
  constexpr double kRisen = 0.632;
  const TrialFlight flight = FlyTrial(plant, trim, 3, Held(0.1, 0, 0));
  const double start = flight.nz.front(), reached = flight.nz.back() - start;
  // Where limiters act, there is no step to measure.
  const double asked = 0.1 * plant.aircraft().flight_control.max_load_factor_command;
  if (!(reached > 0.5 * asked)) {
    handling->pitch_rise_s = handling->pitch_overshoot = std::nan("");
    return;
  }
  const auto risen = std::find_if(flight.nz.begin(), flight.nz.end(),
                                  [&](double nz) { return (nz - start) / reached >= kRisen; });
  handling->pitch_rise_s = kTrialInterval * static_cast<double>(risen - flight.nz.begin());
  const double most = *std::max_element(flight.nz.begin(), flight.nz.end()) - start;
  handling->pitch_overshoot = most / reached - 1;
}

bool Settles(const TrialFlight& flight) {
  constexpr double kSettledBy = 5, kRinging_deg_s = 0.5, kRollRinging_deg_s = 1, kBankDeg = 3;
  return !flight.Departed() && Ringing(flight, flight.q, kSettledBy) < kRinging_deg_s &&
         Ringing(flight, flight.r, kSettledBy) < kRinging_deg_s &&
         Ringing(flight, flight.p, kSettledBy) < kRollRinging_deg_s &&
         std::abs(flight.bank.back()) < kBankDeg;
}

void AssessFullSticks(const Plant& plant, const TrimPoint& trim, Handling* handling) {
  constexpr double kSeconds = 4;
  handling->max_load_factor_g = handling->min_load_factor_g = 1;
  for (const Sticks& sticks : FullSticks()) {
    const TrialFlight flight = FlyTrial(plant, trim, kSeconds, sticks);
    const auto [low, high] = std::minmax_element(flight.nz.begin(), flight.nz.end());
    handling->min_load_factor_g = std::min(handling->min_load_factor_g, *low);
    handling->max_load_factor_g = std::max(handling->max_load_factor_g, *high);
    handling->max_alpha_deg = std::max(handling->max_alpha_deg,
                                       *std::max_element(flight.alpha.begin(), flight.alpha.end()));
    handling->max_sideslip_deg = std::max(handling->max_sideslip_deg, Peak(flight.beta));
    handling->departs = handling->departs || flight.Departed();
  }
}

}  // namespace

Handling AssessHandling(const Plant& plant, const TrimPoint& trim) {
  constexpr double kPush = 4;
  Handling handling;
  AssessLinear(plant, trim, &handling);
  AssessPitchStep(plant, trim, &handling);
  handling.roll_rate_deg_s = FlyTrial(plant, trim, 1, Held(0, 1, 0)).p.back();
  handling.settles = Settles(FlyTrial(plant, trim, 7, HandsOff(), {kPush, false, 1}));
  AssessFullSticks(plant, trim, &handling);
  return handling;
}

}  // namespace skein
