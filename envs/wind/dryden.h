// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "envs/state/state.h"

namespace skein {

// Continuous random turbulence in the Dryden form of MIL-F-8785C, section 3.7: gusts along body x,
// y and z whose power spectral densities over spatial frequency W [rad/ft] are
//   forward       sd^2 (2 L / pi) / (1 + (L W)^2)
//   right, down   sd^2 (L / pi) (1 + 3 (L W)^2) / (1 + (L W)^2)^2
// (one-sided: their integrals from 0 are sd^2), met at the true airspeed.
//
// Rotational gusts are angular rates of the air about body x, y and z, by which a gust varies over
// an aircraft of span b, with the spectra
//   roll          sd^2 / L 0.8 (pi L / 4 b)^(1/3) / (1 + (4 b W / pi)^2)    sd and L of down
//   pitch         W^2 / (1 + (4 b W / pi)^2) times that of down
//   yaw           W^2 / (1 + (3 b W / pi)^2) times that of right
// Roll is independent of all others. Pitch and yaw follow the gusts that are met, with the signs of
// air that turns as a rigid body does: pitch -dw/dx and yaw dv/dx, x being ahead, of the gusts w
// down and v to the right. An aircraft's damping takes its own rates less these.

/// Standard deviations of a gust by severity, ft/s: MIL-F-8785C, figure 7, at 20,000 ft, for the
/// probabilities of exceedance 1e-2, 1e-3 and 1e-5 (light, moderate, severe).
struct TurbulenceSeverity {
  const char* name = nullptr;
  double standard_deviation_fps = 0;
};
inline constexpr std::array<TurbulenceSeverity, 4> kTurbulenceSeverities = {
    {{"calm", 0}, {"light", 3.7}, {"moderate", 7.3}, {"severe", 21}}};

/// Standard deviation of a gust at an altitude, ft/s, where that at 20,000 ft is `at_20000_ft`:
/// MIL-F-8785C, figure 7. Between the severities of the figure it is interpolated, below the least
/// and above the greatest in proportion; below 500 ft and above 80,000 ft it is that there.
double TurbulenceAt(double at_20000_ft, double altitude_ft);

/// How long gusts are, and how much stronger horizontal ones are than vertical ones.
struct DrydenScales {
  double horizontal_ft = 0, vertical_ft = 0;  ///< L of forward and right, and of down
  double horizontal_ratio = 1;                ///< standard deviation over the vertical gust's
};

/// MIL-F-8785C, sections 3.7.2 and 3.7.3: above 2000 ft isotropic, 1750 ft; from 10 to 1000 ft by
/// altitude; linear in between. The altitude is that above the ground, which is at 0 ft.
DrydenScales DrydenScalesAt(double altitude_ft);

/// Whose gusts, and when: the keys of the random streams that drive them.
struct GustKeys {
  std::uint64_t seed = 0;
  std::uint32_t first_aircraft = 0;  ///< global index of the tile's first aircraft
  const std::int32_t* episode = nullptr;
  const std::int32_t* step = nullptr;  ///< control steps flown in the episode
};

/// Whether gusts are as strong as kTurbulenceStdDev everywhere, or at 20,000 ft and elsewhere as
/// TurbulenceAt says.
enum class TurbulenceLaw { kUniform, kByAltitude };

struct Turbulence {
  TurbulenceLaw law = TurbulenceLaw::kUniform;
  double span_ft = 0;  ///< of the aircraft, above 0; read where tiles have rotational gusts
};

/// Draws the gusts of aircraft `index` of a windy tile, whose flight and kTurbulenceStdDev are set,
/// from their stationary distribution, and sets its wind and, where the tile has them, its
/// rotational gusts.
void StartGusts(Tile tile, int index, const GustKeys& keys, const Turbulence& turbulence = {});

/// Moves the gusts of a windy tile's aircraft on by `dt` seconds, exactly as the filters of the
/// spectra above respond to white noise over that time, and sets the wind: the steady one and the
/// gusts, turned to north, east, down by the present attitude. A gust is never shorter than the
/// way through the air in `dt`, and the lengths that a wing smooths, 4 b / pi and 3 b / pi, never
/// shorter than a quarter of that. Linear gusts are the same with and without rotational ones.
/// Reads the columns of the velocity relative to the air and brings them up to date.
void AdvanceGusts(Tile tile, float dt, const GustKeys& keys, const Turbulence& turbulence = {});

}  // namespace skein
