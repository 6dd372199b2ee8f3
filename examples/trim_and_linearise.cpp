// SPDX-License-Identifier: Apache-2.0
// Trims the F-16 at 15000 ft and 500 ft/s, linearises it there and prints its natural modes: short
// period, phugoid, Dutch roll, roll and spiral.
#include <skein/base/error.h>
#include <skein/envs/aircraft/registry.h>
#include <skein/envs/reference/linearise.h>
#include <skein/envs/reference/plant.h>
#include <skein/envs/reference/trim.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <cstdio>
#include <exception>

namespace {

void PrintModes() {
  const skein::Plant plant(skein::LoadAircraft("f16"), skein::AtmosphereModel::kStevensLewis);
  skein::TrimRequest request;
  request.altitude_ft = 15000;
  request.true_airspeed_ft_s = 500;
  const skein::TrimPoint trim = skein::Trim(plant, request);
  std::printf("trim: alpha %.3f deg, elevator %.3f deg, thrust %.0f lbf\n",
              trim.alpha_rad * skein::kDegPerRad, trim.controls.elevator_deg,
              trim.controls.thrust_lbf);

  const skein::LinearModel model = skein::Linearise(plant, trim.state, trim.controls);
  constexpr double kSlowestPerSecond = 1e-3;  // slower ones are position, heading and altitude
  std::printf("modes:\n");
  for (const std::complex<double>& mode : model.A.eigenvalues()) {
    const double frequency = std::abs(mode);
    if (frequency < kSlowestPerSecond || mode.imag() < 0) continue;
    std::printf("  %7.3f %+7.3fi 1/s   natural frequency %.3f rad/s, damping ratio %.3f\n",
                mode.real(), mode.imag(), frequency, -mode.real() / frequency);
  }
}

}  // namespace

int main() {
  try {
    PrintModes();
  } catch (const std::exception& error) {  // skein::Error says what is wrong in one line
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
