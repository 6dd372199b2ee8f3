// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"
#include "envs/state/state.h"

namespace skein {

struct KernelAircraft;  // envs/kernels/kernel_aircraft.h

/// How an episode was flown: the paper's Table 6 but for the time to the target, which is an
/// episode's length, and the Mach number. Each is the mean over the states after every control step
/// of the episode (smoothness is of such a mean); formulas and what they assume:
/// docs/reference/metrics.md.
enum FlightMetric : int {
  kMeanLoadFactor,    ///< G: nz, g, signed
  kMeanTrueAirspeed,  ///< TAS: |velocity relative to the air|, ft/s
  kMeanMach,          ///< true airspeed over the speed of sound
  kMeanClimbRate,     ///< RoC: -(velocity over the ground) along down, ft/s; climbs and descents
                      ///< cancel
  kMeanAbsClimbRate,  ///< of its absolute value, as the paper's code has it, ft/s
  kMeanAbsAlpha,      ///< deg
  kMeanAbsBeta,       ///< deg
  kMeanAbsP,          ///< rad/s
  kMeanAbsQ,          ///< rad/s
  kMeanAbsR,          ///< rad/s
  kAltitudeMargin,    ///< ASM
  kSpeedMargin,       ///< SSM
  kOverloadMargin,    ///< OSM
  kAlphaMargin,       ///< AOASM
  kBetaMargin,        ///< AOSSM
  kSmoothness,        ///< FSM, in (0, 1]
  kNumFlightMetrics
};

struct FlightMetricName {
  const char* key;      ///< in files, with its unit
  const char* symbol;   ///< as in the paper's Table 6
  const char* meaning;  ///< for people, with its unit
};

/// By FlightMetric.
extern const std::array<FlightMetricName, kNumFlightMetrics> kFlightMetricNames;

/// Sums over the control steps of the episodes under way in one block of aircraft, from which
/// their metrics are made when they end. Takes memory from the first Add on.
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
  AlignedVector<float> columns_;  ///< empty until Add
  std::size_t stride_ = 0;
};

}  // namespace skein
