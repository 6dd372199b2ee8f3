// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/linearise.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <complex>

#include "envs/aircraft/f16.h"
#include "envs/reference/trim.h"
#include "envs/state/state.h"
#include "tests/envs/f16_at.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

struct Condition {
  double cg, altitude_ft, speed_ft_s;
};

struct Modes {
  explicit Modes(const Condition& condition) {
    const Plant plant = F16At(condition.cg);
    TrimRequest request;
    request.altitude_ft = condition.altitude_ft;
    request.true_airspeed_ft_s = condition.speed_ft_s;
    const TrimPoint trim = Trim(plant, request);
    eigenvalues = Linearise(plant, trim.state, trim.controls).A.eigenvalues();
  }
  double DistanceTo(std::complex<double> mode) const {
    return (eigenvalues.array() - mode).abs().minCoeff();
  }

  Eigen::VectorXcd eigenvalues;
};

constexpr Tolerance kDigits{2e-3, "three decimals known, and steps near the tables' kinks"};
constexpr Tolerance kSecondOrder{1e-3, "of the change: its square"};

TEST(Linearise, FindsTheKnownModes) {
  const struct {
    Condition condition;
    std::complex<double> mode;
  } known[] = {
      // Short period.
      {{0.30, 15000, 500}, {-0.781, 0.727}},
      {{0.30, 5000, 700}, {-1.463, 0.951}},
      {{0.30, 30000, 800}, {-0.731, 0.760}},
      {{0.25, 15000, 500}, {-0.883, 1.621}},
      // The unstable aircraft: one real mode to the right.
      {{0.35, 15000, 500}, {0.595, 0}},
      {{0.35, 5000, 700}, {0.825, 0}},
      {{0.35, 30000, 800}, {0.992, 0}},
      // Dutch roll, roll and spiral.
      {{0.30, 15000, 500}, {-0.315, 2.523}},
      {{0.30, 15000, 500}, {-2.09, 0}},
      {{0.30, 15000, 500}, {-0.017, 0}},
  };
  for (const auto& each : known) {
    EXPECT_LT(Modes(each.condition).DistanceTo(each.mode), kDigits)
        << each.condition.cg << " " << each.condition.altitude_ft << " " << each.mode;
  }
}

TEST(Linearise, PredictsSmallDepartures) {
  const Plant plant(F16(), AtmosphereModel::kStevensLewis);
  TrimRequest request;
  request.altitude_ft = 15000;
  request.true_airspeed_ft_s = 500;
  const TrimPoint trim = Trim(plant, request);
  const LinearModel model = Linearise(plant, trim.state, trim.controls);
  RigidBodyState change;
  change << 0.05, 0.03, -0.04, 1e-3, -2e-3, 1e-3, 3, 2, 1, 1e-5, 2e-5, -1e-5, 3e-5;
  Controls controls = trim.controls;
  controls.thrust_lbf += 3;
  controls.elevator_deg += 0.01;
  controls.aileron_deg -= 0.02;
  controls.rudder_deg += 0.02;
  controls.leading_edge_flap_deg -= 0.01;
  Eigen::Matrix<double, 5, 1> input;
  input << 3, 0.01, -0.02, 0.02, -0.01;
  const RigidBodyState actual = plant.Evaluate(trim.state + change, controls).state_rate -
                                plant.Evaluate(trim.state, trim.controls).state_rate;
  const RigidBodyState predicted = model.A * change + model.B * input;
  EXPECT_LT((actual - predicted).norm(), kSecondOrder * actual.norm());
  EXPECT_GT(actual.norm(), 0.1);
}

}  // namespace
}  // namespace skein
