// SPDX-License-Identifier: Apache-2.0
#include "train/measures/flight_measurer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "envs/state/attitude.h"
#include "envs/tasks/termination.h"

namespace skein {
namespace {

bool Is(std::int32_t termination, Termination which) {
  return termination == static_cast<std::int32_t>(which);
}

HeldState StateOf(const ControlStep& step, int i, bool is_within) {
  const Tile& tile = step.state;
  Eigen::Vector4d attitude;
  for (int k = 0; k < 4; ++k) attitude[k] = tile[kQ0 + k][i];
  const int air = tile.air_velocity();
  HeldState state;
  state.is_within = is_within;
  for (std::size_t k = 0; k < kNumTaskErrors; ++k) {
    state.errors[k] = step.errors[k * step.error_stride + static_cast<std::size_t>(i)];
  }
  state.p_rad_s = tile[kP][i];
  state.q_rad_s = tile[kQ][i];
  state.r_rad_s = tile[kR][i];
  state.load_factor = tile[kNz][i];
  state.sideslip_rad = std::atan2(tile[air + 1][i], std::hypot(tile[air][i], tile[air + 2][i]));
  state.roll_rad = EulerFromQuaternion(attitude).roll;
  return state;
}

}  // namespace

ActionSeries::ActionSeries(double control_interval_s)
    : commands_(kActionSize, CommandSeries(control_interval_s)) {}

void ActionSeries::Add(const float* action) {
  constexpr std::size_t kMostWaiting = 256;
  std::array<float, kActionSize>& clipped = waiting_.emplace_back();
  for (std::size_t k = 0; k < kActionSize; ++k) clipped[k] = std::clamp(action[k], -1.0f, 1.0f);
  if (waiting_.size() == kMostWaiting) MeasureWaiting();
}

void ActionSeries::MeasureWaiting() {
  for (std::size_t k = 0; k < kActionSize; ++k) {
    for (const auto& action : waiting_) commands_[k].Add(action[k]);
  }
  waiting_.clear();
}

ActionSmoothness ActionSeries::Report() {
  MeasureWaiting();
  ActionSmoothness smoothness;
  for (std::size_t k = 0; k < kActionSize; ++k) smoothness[k] = commands_[k].Report();
  return smoothness;
}

FlightMeasurer::Flight::Flight(double control_interval_s)
    : actions(control_interval_s), hold_actions(control_interval_s) {}

void FlightMeasurer::Flight::ForgetSeries(double control_interval_s) {
  Flight empty(control_interval_s);
  std::swap(actions, empty.actions);
  std::swap(hold_actions, empty.hold_actions);
  hold = empty.hold;
}

FlightMeasurer::FlightMeasurer(const EnvConfig& env, int first_aircraft, int count)
    : control_interval_s_(env.control_interval_s),
      hold_s_(env.hold_s),
      is_mission_(env.mission.enabled()),
      first_aircraft_(first_aircraft),
      flights_(static_cast<std::size_t>(count), Flight(env.control_interval_s)) {}

void FlightMeasurer::See(const ControlStep& step) {
  for (int i = 0; i < step.state.count; ++i) {
    Flight& flight = flights_[static_cast<std::size_t>(step.first_aircraft - first_aircraft_ + i)];
    // What comes after the end of the episode belongs to none.
    if (!Is(flight.termination, Termination::kNone)) continue;
    flight.termination = step.termination[i];
    ++flight.steps;
    if (Is(flight.termination, Termination::kNonFinite)) {
      flight.ForgetSeries(control_interval_s_);
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

void FlightMeasurer::Follow(const ControlStep& step, int i, Flight* flight) const {
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
    flight->hold_actions.Add(step.action + i * kActionSize);
    return;
  }
  // What fails in the very step has not reached it.
  const bool goes_on = Is(flight->termination, Termination::kNone) ||
                       Is(flight->termination, Termination::kTargetReached);
  if (goes_on) flight->reached_step = progress.reached_step[i];
}

FlightMeasures FlightMeasurer::Report(int index) {
  Flight& flight = flights_[static_cast<std::size_t>(index)];
  const bool is_held = hold_s_ > 0 && flight.reached_step > 0;
  const double asked_s = is_mission_ ? flight.steps * control_interval_s_ : is_held ? hold_s_ : 0;
  return {flight.actions.Report(),
          flight.hold_actions.Report(),
          flight.hold.Report(control_interval_s_, asked_s),
          flight.reached_step,
          flight.targets_reached,
          flight.targets_missed};
}

}  // namespace skein
