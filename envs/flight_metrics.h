// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace skein {

/// How an episode was flown, by the states after every control step of it: first the paper's Table
/// 6 but for the time to the target, which is an episode's length, and the Mach number, each a mean
/// over the states (smoothness is of such a mean), then peaks, each the extreme of the states.
/// Formulas and what they assume: docs/reference/metrics.md.
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
  kPeakLoadFactor,    ///< highest nz, g
  kLowestLoadFactor,  ///< lowest nz, g
  kPeakAlpha,         ///< highest alpha, deg, signed
  kPeakAbsBeta,       ///< deg
  kPeakAbsP,          ///< deg/s
  kNumFlightMetrics
};
/// Where the means end and the peaks begin.
inline constexpr int kFirstPeak = kPeakLoadFactor;

/// What a metric is called.
struct FlightMetricName {
  const char* key;      ///< in files, with its unit
  const char* symbol;   ///< as in the paper's Table 6; of peaks empty
  const char* meaning;  ///< for people, with its unit
};

/// By FlightMetric.
extern const std::array<FlightMetricName, kNumFlightMetrics> kFlightMetricNames;

}  // namespace skein
