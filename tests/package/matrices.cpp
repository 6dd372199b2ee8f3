// SPDX-License-Identifier: Apache-2.0
// Takes matrices from the library and frees them.
#include <skein/envs/aircraft/engine.h>
#include <skein/envs/aircraft/registry.h>
#include <skein/envs/reference/closed_loop.h>
#include <skein/envs/reference/linear_flight.h>
#include <skein/envs/reference/plant.h>
#include <skein/envs/reference/trim.h>

#include <cstdio>

int main() {
  const skein::Plant plant(skein::LoadAircraft("f16"), skein::AtmosphereModel::kStevensLewis);
  skein::TrimRequest request;
  request.altitude_ft = 15000;
  request.true_airspeed_ft_s = 500;
  const skein::TrimPoint trim = skein::Trim(plant, request);
  skein::ClosedLoop loop(plant, trim, skein::FlightControlMode::kFull, 0.02);
  loop.set_memory(loop.memory());
  const skein::LinearFlight flight = skein::LineariseFlight(plant, trim, skein::FlapMotion::kFixed);
  std::printf("%d numbers, %d rates\n", static_cast<int>(loop.memory().size()),
              static_cast<int>(flight.A.rows()));
}
