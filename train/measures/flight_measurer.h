// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "envs/actions.h"
#include "envs/control_step.h"
#include "envs/env_config.h"
#include "train/measures/command_smoothness.h"
#include "train/measures/flight_measures.h"
#include "train/measures/hold_metrics.h"

namespace skein {

/// The stick actions of one flight, from control step to control step.
class ActionSeries {
 public:
  explicit ActionSeries(double control_interval_s);

  /// kActionSize of them, not clipped.
  void Add(const float* action);
  ActionSmoothness Report();

 private:
  void MeasureWaiting();

  std::vector<CommandSeries> commands_;
  /// Not measured yet: to go from aircraft to aircraft with every single step would cost as much as
  /// flying it.
  std::vector<std::array<float, kActionSize>> waiting_;
};

/// Measures the first episodes of consecutive aircraft, all of them of one tile.
class FlightMeasurer : public ControlStepObserver {
 public:
  FlightMeasurer(const EnvConfig& env, int first_aircraft, int count);

  void See(const ControlStep& step) override;

  /// Of the `index`-th aircraft's episode, which has ended.
  FlightMeasures Report(int index);

 private:
  /// The episode of one aircraft.
  struct Flight {
    explicit Flight(double control_interval_s);
    /// Keeps the counts alone.
    void ForgetSeries(double control_interval_s);

    std::int32_t steps = 0, termination = 0;
    ActionSeries actions, hold_actions;
    HoldSums hold;
    std::int32_t reached_step = 0, targets_reached = 0, targets_missed = 0;
  };

  void Follow(const ControlStep& step, int i, Flight* flight) const;

  double control_interval_s_, hold_s_;
  bool is_mission_;
  int first_aircraft_;
  std::vector<Flight> flights_;
};

}  // namespace skein
