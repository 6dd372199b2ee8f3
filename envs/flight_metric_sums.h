// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/aligned_vector.h"
#include "envs/flight_metrics.h"
#include "envs/state/state.h"

namespace skein {

struct KernelAircraft;  // envs/kernels/kernel_aircraft.h

/// Sums and peaks over the control steps of the episodes under way in one block of aircraft, from
/// which their metrics are made when they end. Takes memory from the first Add on.
class FlightMetricSums {
 public:
  /// Adds the states that a control step has led to, of the aircraft whose `termination` is still
  /// 0 (padded as Tile says). The block is the same every time.
  void Add(const KernelAircraft& aircraft, Tile flight, const std::int32_t* termination);

  /// Writes the kNumFlightMetrics of the `index`-th aircraft's episode, which took `episode_steps`
  /// control steps of `control_interval_s`. NaN throughout unless just these were added: if adding
  /// began in the middle of the episode, say, or its clock did not begin at 0.
  void Report(int index, std::int32_t episode_steps, double control_interval_s,
              float* metrics) const;

  /// The `index`-th aircraft begins an episode.
  void Begin(int index);

 private:
  std::int32_t StepsOf(int index) const;

  AlignedVector<float> columns_;  ///< empty until Add
  std::size_t stride_ = 0;
};

}  // namespace skein
