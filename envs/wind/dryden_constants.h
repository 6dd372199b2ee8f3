// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein::dryden {

/// Scales and strengths of gusts by altitude: MIL-F-8785C, sections 3.7.2.1 and 3.7.3.2. From
/// kLowestFt to kLowFt a horizontal gust's standard deviation over a vertical one's is
/// (kRatioBase + kRatioSlopePerFt h)^kRatioExponent, and its scale is h times that ratio's cube.
inline constexpr double kHighScaleFt = 1750;
inline constexpr double kLowestFt = 10, kLowFt = 1000, kHighFt = 2000;
inline constexpr double kRatioBase = 0.177, kRatioSlopePerFt = 0.000823, kRatioExponent = -0.4;
/// Of every scale by altitude between kLowFt and kHighFt.
inline constexpr double kScaleSlope = (kHighScaleFt - kLowFt) / (kHighFt - kLowFt);

/// A transverse gust is kFirst x1 + kSecond x2, where x1 lags white noise by the time L / V and x2
/// lags x1 by as much. x1 has the variance 1/2, x2 has 1/4, their covariance is 1/4: the gust's
/// variance is 1 and its spectrum MIL-F-8785C's.
inline constexpr double kFirst = 1.7320508075688772;  // sqrt(3)
inline constexpr double kSecond = 1 - kFirst;
inline constexpr double kFirstDeviation = 0.7071067811865476;
inline constexpr double kSecondVariance = 0.25, kCovariance = 0.25;

/// Rotational gusts: MIL-F-8785C, section 3.7. A wing of span b smooths what is short beside a
/// length: 4 b / pi for roll and pitch, 3 b / pi for yaw.
inline constexpr double kRollLengthPerSpan = 1.2732395447351628;
inline constexpr double kYawLengthPerSpan = 0.954929658551372;
/// Standard deviation of the roll rate over that of the vertical gust, times L^(1/3) (4 b /
/// pi)^(2/3): the square root of 0.8 pi / 2, the spectrum's integral.
inline constexpr double kRollStrength = 1.1209982432795858;
/// Of a transverse gust and one of its states, x1 and x2.
inline constexpr double kGustWithFirst = (1 + kFirst) / 4, kGustWithSecond = 0.25;

/// MIL-F-8785C, figure 7, as JSBSim reads it: standard deviations by altitude, ft/s, that are
/// exceeded with the probabilities of light, moderate and severe turbulence.
struct TurbulenceRow {
  double altitude_ft, light, moderate, severe;
};
inline constexpr TurbulenceRow kTurbulenceByAltitude[] = {
    {500, 6.6, 8.6, 15.6},   {1750, 6.9, 9.6, 17.6},  {3750, 7.4, 10.6, 23.0},
    {7500, 6.7, 10.1, 23.6}, {15000, 4.6, 8.0, 22.1}, {25000, 2.7, 6.6, 20.0},
    {35000, 0.4, 5.0, 16.0}, {45000, 0.0, 4.2, 15.1}, {55000, 0.0, 2.7, 12.1},
    {65000, 0.0, 0.0, 7.9},  {75000, 0.0, 0.0, 6.2},  {80000, 0.0, 0.0, 5.1},
};

}  // namespace skein::dryden
