// SPDX-License-Identifier: Apache-2.0
#include "train/measures/flight_measurer.h"

#include "envs/actions.h"
#include "envs/state/state.h"
#include "envs/tasks/termination.h"

namespace skein {
namespace {

bool Is(std::int32_t termination, Termination which) {
  return termination == static_cast<std::int32_t>(which);
}

}  // namespace

void FlightMeasurer::Flight::ForgetSeries() {
  actions.Clear();
  hold = HoldSums();
}

void FlightMeasurer::Flight::Restart() {
  ForgetSeries();
  steps = termination = 0;
  reached_step = targets_reached = targets_missed = 0;
}

FlightMeasurer::FlightMeasurer(const EnvConfig& env)
    : control_interval_s_(env.control_interval_s),
      hold_s_(env.hold_s),
      is_mission_(env.mission.enabled()) {}

void FlightMeasurer::Begin(int first_aircraft, int count) {
  first_aircraft_ = first_aircraft;
  flights_.resize(static_cast<std::size_t>(count), Flight(control_interval_s_));
  for (Flight& flight : flights_) flight.Restart();
}

void FlightMeasurer::See(const ControlStep& step) {
  has_angles_ = false;
  for (int i = 0; i < step.state.count; ++i) {
    Flight& flight = flights_[static_cast<std::size_t>(step.first_aircraft - first_aircraft_ + i)];
    // What comes after the end of the episode belongs to none.
    if (!Is(flight.termination, Termination::kNone)) continue;
    flight.termination = step.termination[i];
    ++flight.steps;
    if (Is(flight.termination, Termination::kNonFinite)) {
      flight.ForgetSeries();
      continue;
    }
    flight.actions.Add(step.action + i * kActionSize);
    if (step.progress.steps_within != nullptr) {
      Follow(step, i, &flight);
    } else if (Is(flight.termination, Termination::kTargetReached)) {
      flight.reached_step = flight.steps;
    }
  }
}

void FlightMeasurer::Follow(const ControlStep& step, int i, Flight* flight) {
  const EpisodeProgress& progress = step.progress;
  // The target that was held until now has given way to the next.
  const bool has_held = progress.targets_reached[i] > flight->targets_reached;
  const bool is_within = progress.steps_within[i] > 0 || has_held;
  flight->targets_reached = progress.targets_reached[i];
  flight->targets_missed = progress.targets_missed[i];
  if (is_mission_) {
    if (is_within) flight->hold.Add(StateOf(step, i, true));
    if (!is_within || has_held) flight->hold.Break();
    return;
  }
  if (flight->reached_step > 0) {
    flight->hold.Add(StateOf(step, i, is_within));
    return;
  }
  // What fails in the very step has not reached it.
  const bool goes_on = Is(flight->termination, Termination::kNone) ||
                       Is(flight->termination, Termination::kTargetReached);
  if (!goes_on || progress.reached_step[i] == 0) return;
  flight->reached_step = progress.reached_step[i];
  flight->actions.BeginHold();
}

HeldState FlightMeasurer::StateOf(const ControlStep& step, int i, bool is_within) {
  const Tile& tile = step.state;
  if (!has_angles_) MeasureAngles(tile, &angles_);
  has_angles_ = true;
  const auto index = static_cast<std::size_t>(i);
  HeldState state;
  state.is_within = is_within;
  for (std::size_t k = 0; k < kNumTaskErrors; ++k) {
    state.errors[k] = step.errors[k * step.error_stride + index];
  }
  state.p_rad_s = tile[kP][i];
  state.q_rad_s = tile[kQ][i];
  state.r_rad_s = tile[kR][i];
  state.load_factor = tile[kNz][i];
  state.sideslip_rad = angles_.sideslip[index];
  state.roll_rad = angles_.roll[index];
  return state;
}

FlightMeasures FlightMeasurer::Report(int index) const {
  const Flight& flight = flights_[static_cast<std::size_t>(index)];
  const bool is_held = hold_s_ > 0 && flight.reached_step > 0;
  const double asked_s = is_mission_ ? flight.steps * control_interval_s_ : is_held ? hold_s_ : 0;
  return {flight.actions.Report(),
          flight.actions.ReportHold(),
          flight.hold.Report(control_interval_s_, asked_s),
          flight.reached_step,
          flight.targets_reached,
          flight.targets_missed};
}

}  // namespace skein
