// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "envs/control_step.h"
#include "envs/env_config.h"
#include "train/measures/body_angles.h"
#include "train/measures/command_smoothness.h"
#include "train/measures/flight_measures.h"
#include "train/measures/hold_metrics.h"

namespace skein {

/// Measures the first episodes of consecutive aircraft, all of them of one tile.
class FlightMeasurer : public ControlStepObserver {
 public:
  explicit FlightMeasurer(const EnvConfig& env);

  /// Forgets what it measured: episodes of `count` aircraft begin. To measure one tile after
  /// another with the same memory is faster than with fresh one.
  void Begin(int first_aircraft, int count);

  void See(const ControlStep& step) override;

  /// Of the `index`-th aircraft's episode, which has ended.
  FlightMeasures Report(int index) const;

 private:
  /// The episode of one aircraft.
  struct Flight {
    explicit Flight(double control_interval_s) : actions(control_interval_s) {}
    /// Keeps the counts alone.
    void ForgetSeries();
    void Restart();

    std::int32_t steps = 0, termination = 0;
    ActionSeries actions;
    HoldSums hold;
    std::int32_t reached_step = 0, targets_reached = 0, targets_missed = 0;
  };

  void Follow(const ControlStep& step, int i, Flight* flight);
  HeldState StateOf(const ControlStep& step, int i, bool is_within);

  double control_interval_s_, hold_s_;
  bool is_mission_;
  int first_aircraft_ = 0;
  std::vector<Flight> flights_;
  BodyAngles angles_;  // of the control step that is seen
  bool has_angles_ = false;
};

}  // namespace skein
