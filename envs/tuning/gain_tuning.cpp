// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/gain_tuning.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "envs/aircraft/flight_control_file.h"
#include "envs/reference/linearise.h"
#include "envs/state/state.h"
#include "envs/tuning/closed_loop_model.h"
#include "envs/tuning/pattern_search.h"
#include "envs/tuning/trial_flight.h"

namespace skein {
namespace {

/// Flight conditions at which gains are judged.
struct Condition {
  TrimPoint trim;
  double qbar_psf = 0;
  /// What the closed loop shall have: natural frequency of its short period.
  double frequency_rad_s = 0;
};

enum Input { kElevatorInput = 1, kAileronInput, kRudderInput };

/// The frequency that the short period has, or if that is slower the one at which MIL-F-8785C's
/// control anticipation parameter, frequency squared over load factor per alpha, is in the middle
/// of level 1; within what the actuator can follow.
double DesiredFrequency(const Plant& plant, const TrimPoint& trim) {
  constexpr double kAnticipation = 0.5, kActuatorShare = 0.3, kSlowest = 1;
  const LinearModel model = Linearise(plant, trim.state, trim.controls);
  const double speed = trim.state.segment<3>(kU).norm();
  const double load_factor_per_rad = -model.A(kW, kW) * speed / kGravityFtS2;
  const double own = model.A(kW, kW) * model.A(kQ, kQ) - speed * model.A(kQ, kW);
  const double wanted = std::sqrt(std::max({own, kAnticipation * load_factor_per_rad, 0.0}));
  const double most = kActuatorShare * plant.aircraft().actuators.elevator.bandwidth_per_s;
  return std::max(kSlowest, std::min(wanted, most));
}

std::vector<Condition> ConditionsOf(const Plant& plant, const FlightEnvelope& envelope) {
  std::vector<Condition> conditions;
  for (const EnvelopeRow& row : envelope.rows) {
    for (const TrimPoint& trim : row.trims) {
      const double qbar = plant.Evaluate(trim.state, trim.controls).air.dynamic_pressure_psf;
      conditions.push_back({trim, qbar, DesiredFrequency(plant, trim)});
    }
  }
  if (conditions.empty()) {
    throw Error("aircraft " + plant.aircraft().name +
                ": there is no level flight, so there is nothing to tune for "
                "(`skein aircraft check` says why)");
  }
  return conditions;
}

/// What bad modes cost: growth, and damping below `damping` of those faster than `slowest` rad/s.
double CostOfModes(const ClosedLoopModel& model, double slowest, double damping) {
  double cost = 0;
  for (const std::complex<double>& mode : model.Modes()) {
    if (std::abs(mode) < slowest) continue;
    const double lacking = std::max(0.0, damping - DampingRatio(mode));
    cost += 30 * lacking * lacking + 10 * std::max(0.0, mode.real());
  }
  return cost;
}

/// The same of what must not break the loop: gains twice as high, and a step of delay.
template <class Double>
double CostOfMargins(const Plant& plant, const Condition& condition, LoopAxis axis,
                     const Double& doubled) {
  constexpr double kStable = 0, kDelayedDamping = 0.3;
  const double slowest = condition.frequency_rad_s;
  const auto model = [&](const Plant& flown, bool delayed) {
    return LineariseClosedLoop(flown, condition.trim, axis, kTrialInterval, delayed);
  };
  FlightControlGains gains = plant.aircraft().flight_control;
  doubled(&gains);
  return CostOfModes(model(plant.WithFlightControl(gains), false), slowest, kStable) +
         CostOfModes(model(plant, true), slowest, kDelayedDamping);
}

/// Mean square error of the load factor after a step of the pitch stick against a well damped
/// second order.
double CostOfPitchStep(const Plant& plant, const Condition& condition,
                       const ClosedLoopModel& model) {
  constexpr double kSeconds = 3, kDamping = 0.8;
  const double asked = plant.aircraft().flight_control.max_load_factor_command;
  double wanted = 0, rate = 0, sum = 0;
  const double frequency = condition.frequency_rad_s;
  const std::vector<double> response = model.StepResponse(0, kNormalAccelerationMemory, kSeconds);
  for (const double nz : response) {
    rate += model.dt * (frequency * frequency * (1 - wanted) - 2 * kDamping * frequency * rate);
    wanted += model.dt * rate;
    const double error = nz / asked - wanted;
    sum += error * error;
  }
  return sum / static_cast<double>(response.size());
}

double CostOfPitch(const Plant& plant, const std::vector<Condition>& conditions) {
  constexpr double kSlowShare = 0.3, kDamping = 0.6;
  double cost = 0;
  for (const Condition& condition : conditions) {
    const ClosedLoopModel model =
        LineariseClosedLoop(plant, condition.trim, LoopAxis::kLongitudinal, kTrialInterval, false);
    cost += CostOfModes(model, kSlowShare * condition.frequency_rad_s, kDamping) +
            CostOfMargins(plant, condition, LoopAxis::kLongitudinal,
                          [](FlightControlGains* g) { g->pitch_proportional_deg_per_g *= 2; }) +
            15 * CostOfPitchStep(plant, condition, model);
  }
  return cost;
}

/// Full roll stick and pedals of the linear model: how much of the roll rate asked for is reached,
/// sideslip on the way, overshoot of what the pedals bring.
double CostOfLateralSteps(const Plant& plant, const Condition& condition,
                          const ClosedLoopModel& model) {
  constexpr double kSeconds = 2, kWantedShare = 0.65, kPedalSeconds = 6;
  const double speed = condition.trim.state.segment<3>(kU).norm();
  const std::vector<double> p = model.StepResponse(0, kP, kSeconds);
  const double asked = plant.aircraft().flight_control.max_roll_rate_deg_s / kDegPerRad;
  const double share = p.back() / asked;
  double sideslip = 0;
  for (const double v : model.StepResponse(0, kV, kSeconds)) {
    sideslip = std::max(sideslip, std::abs(v) / speed);
  }
  const std::vector<double> pedal = model.StepResponse(1, kV, kPedalSeconds);
  double peak = 0;
  for (const double v : pedal) peak = std::max(peak, std::abs(v));
  const double overshoot = peak / std::max(std::abs(pedal.back()), 1e-3 * speed) - 1;
  const double lacking = std::max(0.0, kWantedShare - share);
  const double per_rate = sideslip / std::max(std::abs(p.back()), 1e-3);
  return 5 * lacking * lacking + 2 * per_rate * per_rate + 0.1 * std::min(overshoot, 2.0);
}

double CostOfLateral(const Plant& plant, const std::vector<Condition>& conditions) {
  constexpr double kSlowest = 0.4, kDamping = 0.6;
  double cost = 0;
  for (const Condition& condition : conditions) {
    const ClosedLoopModel model =
        LineariseClosedLoop(plant, condition.trim, LoopAxis::kLateral, kTrialInterval, false);
    cost += CostOfModes(model, kSlowest, kDamping) +
            CostOfMargins(plant, condition, LoopAxis::kLateral,
                          [](FlightControlGains* g) {
                            g->roll_rate_gain_s *= 2;
                            g->yaw_rate_gain_s *= 2;
                            g->lateral_acceleration_gain_deg_per_g *= 2;
                          }) +
            CostOfLateralSteps(plant, condition, model);
  }
  return cost;
}

/// Whether the rudder yaws. Where it does not there is none, and nothing for the gains of yaw to
/// move.
bool HasRudder(const Plant& plant, const TrimPoint& trim) {
  constexpr double kNothing = 1e-9;  // a yawing moment coefficient's rounding
  const auto yaw_at = [&](double rudder_deg) {
    Controls controls = trim.controls;
    controls.rudder_deg = rudder_deg;
    constexpr int kCn = 5;
    return plant.Evaluate(trim.state, controls).coefficients[kCn];
  };
  return std::abs(yaw_at(plant.aircraft().actuators.rudder.max_deg) - yaw_at(0)) > kNothing;
}

/// The rudder per aileron that takes away the yaw of ailerons and roll rate in a steady roll, the
/// most that any condition asks for; none without a rudder.
double MostInterconnect(const Plant& plant, const std::vector<Condition>& conditions) {
  constexpr double kMost = 1;
  if (!HasRudder(plant, conditions.front().trim)) return 0;
  double most = 0;
  for (const Condition& condition : conditions) {
    const LinearModel model = Linearise(plant, condition.trim.state, condition.trim.controls);
    const double roll_per_deg = -model.B(kP, kAileronInput) / model.A(kP, kP);
    const double yaw = model.B(kR, kAileronInput) + model.A(kR, kP) * roll_per_deg;
    most = std::max(most, -yaw / model.B(kR, kRudderInput));
  }
  return std::min(most, kMost);
}

/// What follows from the wing, the actuators and the limits alone. Structure and filters are the
/// F-16's (docs/explanation/flight-control.md), but for its leads, whose place the rate feedback
/// takes.
FlightControlGains GainsOfLimits(const Plant& plant, const TuningLimits& limits,
                                 const FlightEnvelope& envelope,
                                 const std::vector<Condition>& conditions) {
  constexpr double kLoadFactorShare = 0.8, kLowNegative = -0.7;
  const Actuators& actuators = plant.aircraft().actuators;
  const double zero = envelope.zero_lift_alpha_deg;
  const double range = envelope.greatest_lift.alpha_deg - zero;
  const auto by_pressure = [](const Condition& a, const Condition& b) {
    return a.qbar_psf < b.qbar_psf;
  };
  const auto [low, high] = std::minmax_element(conditions.begin(), conditions.end(), by_pressure);
  FlightControlGains g;
  g.alpha_min_deg = zero - 0.6 * range;
  g.alpha_max_deg = envelope.greatest_lift.alpha_deg + 5;
  g.pitch_gain_pressure_psf = g.roll_gain_pressure_psf = g.yaw_gain_pressure_psf = low->qbar_psf;
  g.max_load_factor_command = kLoadFactorShare * limits.max_load_factor_g - 1;
  g.max_load_factor_reduction = 0.3 * g.max_load_factor_command;
  const double most_negative =
      std::min(kLowNegative, kLoadFactorShare * limits.min_load_factor_g - 1);
  g.min_load_factor_command = {low->qbar_psf, kLowNegative,
                               std::max(high->qbar_psf, 1.01 * low->qbar_psf), most_negative};
  g.pitch_lead = {1, 12, 12};
  g.alpha_to_elevator = 0;
  g.limiter_rate_lead_s = 1 / low->frequency_rad_s;
  g.limiter_rate_fade = {low->qbar_psf, 1, g.min_load_factor_command.x_high,
                         std::sqrt(low->qbar_psf / high->qbar_psf)};
  // Full aft stick comes to rest at 0.85 of the way to the stall, half by each.
  g.alpha_onset_deg = zero + 0.65 * range;
  g.alpha_limit_deg = zero + 0.75 * range;
  g.alpha_onset_gain_g_per_deg = 0.5 * g.max_load_factor_command / (0.2 * range);
  g.alpha_limit_gain_g_per_deg = 0.5 * g.max_load_factor_command / (0.1 * range);
  g.pitch_integrator_limit_deg = std::max(-actuators.elevator.min_deg, actuators.elevator.max_deg);
  g.roll_rate_fade = {g.alpha_limit_deg, 1, envelope.greatest_lift.alpha_deg, 0.25};
  g.roll_integrator_fade = {g.alpha_onset_deg, 1, envelope.greatest_lift.alpha_deg, 0};
  g.roll_integrator_limit_deg = 0.2 * actuators.aileron.max_deg;
  g.yaw_washout = {1, 0, 1};
  g.yaw_lead = {1, 15, 15};
  g.pedal_fade = {g.alpha_limit_deg, 1, envelope.greatest_lift.alpha_deg, 0};
  g.interconnect_min = 0;
  g.interconnect_max = MostInterconnect(plant, conditions);
  return g;
}

/// Of an aircraft that is not stable by itself: alpha to the elevator, as if the centre of gravity
/// were where its static margin is 5 % at every condition.
double AlphaToElevator(const Plant& plant, const std::vector<Condition>& conditions) {
  constexpr double kMargin = 0.05;
  double gain = 0;
  for (const Condition& condition : conditions) {
    const LinearModel model = Linearise(plant, condition.trim.state, condition.trim.controls);
    const Airframe& a = plant.aircraft().airframe;
    // Lift per alpha acts on a lever of the margin.
    const double wanted = kMargin * a.chord_ft * a.mass_slug / a.Iyy * model.A(kW, kW);
    const double missing = model.A(kQ, kW) - wanted;
    const double speed = condition.trim.state.segment<3>(kU).norm();
    const double per_deg = model.B(kQ, kElevatorInput);
    gain = std::max(gain, -missing * speed / kDegPerRad / per_deg);
  }
  return gain;
}

/// First guesses for the searches, from the linear model at the slowest condition, where the loop
/// gains are not reduced. Those that are zero stay zero.
struct FirstGains {
  double pitch_proportional, pitch_integral, pitch_rate;
  double roll_rate, yaw_rate, side_acceleration, interconnect;
  double max_roll_rate_deg_s, max_pedal_deg;
};

FirstGains GuessGains(const Plant& plant, const Condition& slow) {
  const LinearModel model = Linearise(plant, slow.trim.state, slow.trim.controls);
  const auto A = [&](int row, int column) { return model.A(row, column); };
  const auto B = [&](int row, Input input) { return std::abs(model.B(row, input)) + 1e-9; };
  const double speed = slow.trim.state.segment<3>(kU).norm();
  const double frequency = slow.frequency_rad_s;
  const double load_factor_per_rad = std::max(-A(kW, kW) * speed / kGravityFtS2, 0.1);
  const Actuators& actuators = plant.aircraft().actuators;
  FirstGains first{};
  // Half of the deflection that holds 1 g more.
  first.pitch_proportional =
      0.5 * frequency * frequency / (load_factor_per_rad * B(kQ, kElevatorInput));
  first.pitch_integral = frequency;
  // A tenth of the load factor that goes with a pitch rate.
  first.pitch_rate = 0.1 * speed / kGravityFtS2 / kDegPerRad;
  const double roll_damping = std::max(-A(kP, kP), 0.5);
  first.roll_rate = roll_damping / (B(kP, kAileronInput) * kDegPerRad);
  const double yaw_stiffness = std::max(speed * A(kR, kV), 0.1);
  first.yaw_rate = 0.5 * std::sqrt(yaw_stiffness) / (B(kR, kRudderInput) * kDegPerRad);
  first.side_acceleration = 0.05 * actuators.rudder.max_deg / 0.1;
  first.interconnect = 0.02;
  // What nine tenths of the ailerons turn, of which 0.65 is reached; faster flight turns faster.
  const double aileron_deg = 0.9 * std::min(actuators.aileron.max_deg, -actuators.aileron.min_deg);
  constexpr double kReached = 0.65, kFastestRoll = 200, kFaster = 1.6;
  first.max_roll_rate_deg_s = std::min(kFastestRoll, kFaster * B(kP, kAileronInput) * aileron_deg /
                                                         roll_damping * kDegPerRad / kReached);
  if (!HasRudder(plant, slow.trim)) {
    first.yaw_rate = first.side_acceleration = first.interconnect = first.max_pedal_deg = 0;
    return first;
  }
  // Pedals that bring ten degrees of sideslip at rest.
  constexpr double kSideslipDeg = 10;
  const double rudder_per_sideslip = yaw_stiffness / (B(kR, kRudderInput) * kDegPerRad);
  first.max_pedal_deg =
      std::min(0.7 * actuators.rudder.max_deg, kSideslipDeg * rudder_per_sideslip);
  return first;
}

void SearchPitch(const Plant& plant, const FirstGains& first,
                 const std::vector<Condition>& conditions, FlightControlGains* gains) {
  const auto set = [&](const std::vector<double>& x) {
    gains->pitch_proportional_deg_per_g = x[0];
    gains->pitch_integral_per_s = x[1];
    gains->pitch_rate_gain_g_s_per_deg = x[2];
  };
  set(SearchPattern(
      [&](const std::vector<double>& x) {
        set(x);
        return CostOfPitch(plant.WithFlightControl(*gains), conditions);
      },
      {first.pitch_proportional, first.pitch_integral, first.pitch_rate}));
}

void SearchLateral(const Plant& plant, const FirstGains& first,
                   const std::vector<Condition>& conditions, FlightControlGains* gains) {
  gains->max_roll_rate_deg_s = first.max_roll_rate_deg_s;
  gains->max_pedal_rudder_deg = first.max_pedal_deg;
  const auto set = [&](const std::vector<double>& x) {
    gains->roll_rate_gain_s = x[0];
    gains->yaw_rate_gain_s = x[1];
    gains->lateral_acceleration_gain_deg_per_g = x[2];
    gains->aileron_rudder_interconnect_per_deg = x[3];
    gains->roll_gain_pressure_psf = x[4];
  };
  set(SearchPattern(
      [&](const std::vector<double>& x) {
        set(x);
        return CostOfLateral(plant.WithFlightControl(*gains), conditions);
      },
      {first.roll_rate, first.yaw_rate, first.side_acceleration, first.interconnect,
       gains->roll_gain_pressure_psf}));
}

/// The worst of full sticks over the envelope.
struct Abuse {
  double max_alpha_deg = -90, max_nz = -90, min_nz = 90;
};

Abuse FlyFullSticks(const Plant& plant, const std::vector<Condition>& conditions) {
  constexpr double kSeconds = 4;
  Abuse abuse;
  for (const Condition& condition : conditions) {
    for (const Sticks& sticks : FullSticks()) {
      const TrialFlight flight = FlyTrial(plant, condition.trim, kSeconds, sticks);
      const auto [low, high] = std::minmax_element(flight.nz.begin(), flight.nz.end());
      abuse.max_nz = std::max(abuse.max_nz, *high);
      abuse.min_nz = std::min(abuse.min_nz, *low);
      abuse.max_alpha_deg = std::max(abuse.max_alpha_deg,
                                     *std::max_element(flight.alpha.begin(), flight.alpha.end()));
    }
  }
  return abuse;
}

/// What a round of drawing in leaves of a load factor.
constexpr double kLess = 0.92;

/// Lowers alpha's limit by `step_deg`, with its onset no higher, but not below `least_deg`.
void LowerAlphaLimit(double step_deg, double least_deg, FlightControlGains* gains) {
  const double lower = std::max(gains->alpha_limit_deg - step_deg, least_deg);
  if (!(lower < gains->alpha_limit_deg)) return;
  gains->alpha_limit_deg = lower;
  gains->alpha_limit_gain_g_per_deg /= kLess;
  gains->alpha_onset_deg = std::min(gains->alpha_onset_deg, lower);
}

/// Draws the limiters in as far as full sticks go beyond stall or load factors in flight. Alpha's
/// stays above all level flight, which it would else push out of its trim; where that is not low
/// enough, only the load factor's command is reduced.
void KeepWithinLimits(const Plant& plant, const TuningLimits& limits, double stall_alpha_deg,
                      const std::vector<Condition>& conditions, FlightControlGains* gains) {
  constexpr int kMostRounds = 12;
  constexpr double kAlphaMarginDeg = 1, kTrimMarginDeg = 0.5;
  const auto by_alpha = [](const Condition& a, const Condition& b) {
    return a.trim.alpha_rad < b.trim.alpha_rad;
  };
  const Condition& steepest = *std::max_element(conditions.begin(), conditions.end(), by_alpha);
  const double least_limit_deg = steepest.trim.alpha_rad * kDegPerRad + kTrimMarginDeg;
  for (int round = 0; round < kMostRounds; ++round) {
    const Abuse abuse = FlyFullSticks(plant.WithFlightControl(*gains), conditions);
    const bool stalls = !(abuse.max_alpha_deg <= stall_alpha_deg - kAlphaMarginDeg);
    const bool pulls = !(abuse.max_nz <= limits.max_load_factor_g);
    const bool pushes = !(abuse.min_nz >= limits.min_load_factor_g);
    if (!stalls && !pulls && !pushes) return;
    if (pulls) gains->max_load_factor_command *= kLess;
    if (pushes) gains->min_load_factor_command.y_high *= kLess;
    if (stalls) {
      LowerAlphaLimit(kAlphaMarginDeg, least_limit_deg, gains);
      gains->max_load_factor_command *= kLess;
    }
  }
}

/// To three digits. What the search has all but switched off is zero, which halving never reaches.
double Rounded(double value) {
  constexpr int kDigits = 3;
  constexpr double kNothing = 1e-6;  // of degrees, g and seconds: no surface moves by it
  if (std::abs(value) < kNothing) return 0;
  const double unit = std::pow(10, kDigits - 1 - std::floor(std::log10(std::abs(value))));
  return std::round(value * unit) / unit;
}

/// Gains as people write them.
void Round(double* value) { *value = Rounded(*value); }
void Round(FirstOrder* law) { *law = {Rounded(law->b1), Rounded(law->b0), Rounded(law->a0)}; }
void Round(Ramp* ramp) {
  *ramp = {Rounded(ramp->x_low), Rounded(ramp->y_low), Rounded(ramp->x_high),
           Rounded(ramp->y_high)};
}

}  // namespace

FlightControlGains TuneFlightControl(const Plant& plant, const TuningLimits& limits) {
  constexpr int kAltitudes = 2, kSpeeds = 3;
  const FlightEnvelope envelope = FindEnvelope(plant, limits.envelope, kAltitudes, kSpeeds);
  const std::vector<Condition> conditions = ConditionsOf(plant, envelope);
  FlightControlGains gains = GainsOfLimits(plant, limits, envelope, conditions);
  gains.alpha_to_elevator = AlphaToElevator(plant, conditions);
  const FirstGains first = GuessGains(
      plant, *std::min_element(
                 conditions.begin(), conditions.end(),
                 [](const Condition& a, const Condition& b) { return a.qbar_psf < b.qbar_psf; }));
  SearchPitch(plant, first, conditions, &gains);
  SearchLateral(plant, first, conditions, &gains);
  KeepWithinLimits(plant, limits, envelope.greatest_lift.alpha_deg, conditions, &gains);
  VisitFlightControlGains(gains, [](const char*, auto* value) { Round(value); });
  return gains;
}

}  // namespace skein
