// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/plant.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "envs/aircraft/f16.h"
#include "envs/state/attitude.h"
#include "envs/state/state.h"
#include "tests/envs/golden.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kSumOrder{1e-12, "two float64 implementations sum in another order"};
constexpr Tolerance kGrownDifference{1e-9, "differences grow with the modes over 500 steps"};
constexpr Tolerance kRounding{1e-12, "float64 rounding of quantities of about 1"};
constexpr Tolerance kPositionRounding{1e-9, "float64 rounding of 1e4 ft"};
constexpr Tolerance kDragRounding{1e-9, "float64 rounding of interpolated rises"};
constexpr Tolerance kAccelerationRounding{1e-6, "float64 rounding of forces of 1e4 lbf"};

void ExpectClose(double actual, double expected, double tolerance) {
  EXPECT_NEAR(actual, expected, tolerance * (1 + std::abs(expected)));
}

void CheckPoints(const nlohmann::json& points) {
  for (std::size_t n = 0; n < points.size(); ++n) {
    SCOPED_TRACE(n);
    const nlohmann::json& point = points[n];
    const PlantOutput output =
        PlantOf(point.at("params"))
            .Evaluate(StateOf(point.at("state")), ControlsOf(point.at("controls")));
    for (int i = 0; i < 6; ++i) {
      ExpectClose(output.coefficients[i], point.at("coeffs")[i].get<double>(), kSumOrder);
    }
    for (int i = 0; i < kNumRigidBody; ++i) {
      ExpectClose(output.state_rate[i], point.at("xdot")[i].get<double>(), kSumOrder);
    }
    ExpectClose(output.air.alpha_rad * kDegPerRad, point.at("alpha_deg").get<double>(), kSumOrder);
    ExpectClose(output.air.beta_rad * kDegPerRad, point.at("beta_deg").get<double>(), kSumOrder);
    ExpectClose(output.air.mach, point.at("mach").get<double>(), kSumOrder);
    ExpectClose(output.air.dynamic_pressure_psf, point.at("qbar_psf").get<double>(), kSumOrder);
  }
}

TEST(Plant, MatchesIndependentPoints) {
  const nlohmann::json golden = ReadGolden();
  ASSERT_EQ(golden.at("points").size(), 200u);
  CheckPoints(golden.at("points"));
}

TEST(Plant, MatchesIndependentPointsAtAndBeyondTheTablesEdges) {
  const nlohmann::json golden = ReadGolden();
  ASSERT_EQ(golden.at("edge_points").size(), 24u);
  CheckPoints(golden.at("edge_points"));
}

// Controls at the start of a step: the trim's plus the pulses then active.
Controls PulsedControls(const nlohmann::json& trajectory, double time) {
  nlohmann::json values = trajectory.at("trim_controls");
  for (const nlohmann::json& pulse : trajectory.at("pulses")) {
    if (time >= pulse.at("t_start").get<double>() && time < pulse.at("t_end").get<double>()) {
      nlohmann::json& value = values[pulse.at("control_index").get<std::size_t>()];
      value = value.get<double>() + pulse.at("delta").get<double>();
    }
  }
  return ControlsOf(values);
}

TEST(Plant, MatchesIndependentTrajectories) {
  constexpr double kDt = 0.02;
  constexpr int kStepsPerRow = 5;
  const nlohmann::json golden = ReadGolden();
  for (const nlohmann::json& trajectory : golden.at("trajectories")) {
    SCOPED_TRACE(trajectory.at("name").get<std::string>());
    const Plant plant = PlantOf(trajectory.at("params"));
    const nlohmann::json& rows = trajectory.at("states_dt0_02");
    RigidBodyState state = StateOf(trajectory.at("initial_state"));
    for (std::size_t row = 1; row < rows.size(); ++row) {
      for (int i = 0; i < kStepsPerRow; ++i) {
        const double step = static_cast<double>((row - 1) * kStepsPerRow + i);
        state = plant.StepRk4(state, PulsedControls(trajectory, step * kDt), kDt);
      }
      const RigidBodyState expected = StateOf(rows[row]);
      for (int i = 0; i < kNumRigidBody; ++i) {
        ASSERT_NEAR(state[i], expected[i], kGrownDifference) << "row " << row << " state " << i;
      }
    }
  }
}

RigidBodyState RandomState(std::mt19937_64* random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  RigidBodyState state;
  state << 600 + 300 * unit(*random), 80 * unit(*random), 150 * unit(*random), unit(*random),
      unit(*random), unit(*random), 1e4 * unit(*random), 1e4 * unit(*random),
      -20000 + 15000 * unit(*random), unit(*random), unit(*random), unit(*random), unit(*random);
  state.segment<4>(kQ0).normalize();
  return state;
}

// The flight does not depend on where north is, nor on how far one has flown.
TEST(Plant, IsIndependentOfHeadingAndPosition) {
  std::mt19937_64 random(1);
  const Plant plant(F16(), AtmosphereModel::kStandard1976);
  const Eigen::Vector4d turn = QuaternionFromEuler({0, 0, 1.234});
  for (int n = 0; n < 100; ++n) {
    const RigidBodyState state = RandomState(&random);
    RigidBodyState moved = state;
    moved[kNorth] += 5e4;
    moved[kEast] -= 3e4;
    const Eigen::Quaterniond q(state[kQ0], state[kQx], state[kQy], state[kQz]);
    const Eigen::Quaterniond turned = Eigen::Quaterniond(turn[0], turn[1], turn[2], turn[3]) * q;
    moved.segment<4>(kQ0) << turned.w(), turned.x(), turned.y(), turned.z();
    const Controls controls{5000, -3, 4, -5, 10};
    const RigidBodyState a = plant.Evaluate(state, controls).state_rate;
    const RigidBodyState b = plant.Evaluate(moved, controls).state_rate;
    EXPECT_LT((a.head<6>() - b.head<6>()).norm(), kRounding * (1 + a.head<6>().norm()));
    EXPECT_NEAR(a.segment<2>(kNorth).norm(), b.segment<2>(kNorth).norm(), kPositionRounding);
    EXPECT_NEAR(a[kDown], b[kDown], kPositionRounding);
  }
}

// The attitude's rate turns the quaternion without stretching it.
TEST(Plant, AttitudeRateIsNormal) {
  std::mt19937_64 random(2);
  const Plant plant(F16(), AtmosphereModel::kStevensLewis);
  for (int n = 0; n < 100; ++n) {
    const RigidBodyState state = RandomState(&random);
    const RigidBodyState rate = plant.Evaluate(state, Controls{}).state_rate;
    EXPECT_NEAR(state.segment<4>(kQ0).dot(rate.segment<4>(kQ0)), 0, kRounding);
    EXPECT_NEAR(rate.segment<4>(kQ0).norm(), state.segment<3>(kP).norm() / 2, kRounding);
  }
}

// Rotational energy changes by the work of the aerodynamic moments alone: inertia terms and the
// engine's angular momentum do none.
TEST(Plant, InertiaDoesNoWork) {
  std::mt19937_64 random(3);
  Aircraft aircraft = F16();
  aircraft.airframe.engine_angular_momentum = 160;
  const Airframe& a = aircraft.airframe;
  const Plant plant(aircraft, AtmosphereModel::kStevensLewis);
  Eigen::Matrix3d inertia;
  inertia << a.Ixx, 0, -a.Ixz, 0, a.Iyy, 0, -a.Ixz, 0, a.Izz;
  for (int n = 0; n < 100; ++n) {
    const RigidBodyState state = RandomState(&random);
    const PlantOutput output = plant.Evaluate(state, Controls{4000, -5, 3, 2, 12});
    const Eigen::Vector3d rates = state.segment<3>(kP);
    const double qbar_S = output.air.dynamic_pressure_psf * a.wing_area_ft2;
    const Eigen::Vector3d moments = qbar_S * Eigen::Vector3d(a.span_ft, a.chord_ft, a.span_ft)
                                                 .cwiseProduct(output.coefficients.tail<3>());
    const double power = rates.dot(inertia * output.state_rate.segment<3>(kP));
    EXPECT_NEAR(power, rates.dot(moments),
                kRounding * (moments.norm() + inertia.norm()) * (1 + rates.squaredNorm()));
  }
}

// Far above the air the aircraft is a stone: mechanical energy and angular momentum are kept, to
// the order of the integrator.
TEST(Plant, KeepsEnergyAndAngularMomentumWithoutAir) {
  constexpr double kDt = 0.02;
  constexpr Tolerance kIntegratorError{1e-9, "RK4 over 10 s at 1 rad/s, relative"};
  const Plant plant(F16(), AtmosphereModel::kStandard1976);
  const Airframe& a = plant.aircraft().airframe;
  Eigen::Matrix3d inertia;
  inertia << a.Ixx, 0, -a.Ixz, 0, a.Iyy, 0, -a.Ixz, 0, a.Izz;
  RigidBodyState state;
  state << 500, 20, -30, 0.8, -0.4, 0.5, 0, 0, -2.5e6, 1, 0, 0, 0;
  const auto energy = [&](const RigidBodyState& s) {
    return 0.5 * s.segment<3>(kU).squaredNorm() - kGravityFtS2 * s[kDown];
  };
  const auto angular_momentum = [&](const RigidBodyState& s) -> Eigen::Vector3d {
    return BodyFromNed(s.segment<4>(kQ0)).transpose() * inertia * s.segment<3>(kP);
  };
  const double energy_before = energy(state);
  const Eigen::Vector3d momentum_before = angular_momentum(state);
  for (int i = 0; i < 500; ++i) state = plant.StepRk4(state, Controls{}, kDt);
  EXPECT_NEAR(energy(state) / energy_before, 1, kIntegratorError);
  EXPECT_LT((angular_momentum(state) - momentum_before).norm(),
            kIntegratorError * momentum_before.norm());
}

// Moving the centre of gravity moves pitching and yawing moments by force times arm, nothing else.
TEST(Plant, CentreOfGravityMovesMomentsByForceTimesArm) {
  std::mt19937_64 random(4);
  constexpr double kShift = 0.05;
  Aircraft aft = F16();
  aft.airframe.cg += kShift;
  const Plant plant(F16(), AtmosphereModel::kStevensLewis);
  const Plant plant_aft(aft, AtmosphereModel::kStevensLewis);
  const double chord_over_span = aft.airframe.chord_ft / aft.airframe.span_ft;
  for (int n = 0; n < 100; ++n) {
    const RigidBodyState state = RandomState(&random);
    const Controls controls{4000, -5, 3, 2, 12};
    const auto at = plant.Evaluate(state, controls).coefficients;
    const auto moved = plant_aft.Evaluate(state, controls).coefficients;
    EXPECT_LT((at.head<4>() - moved.head<4>()).norm(), kRounding);
    EXPECT_NEAR(moved[4] - at[4], -kShift * at[2], kRounding);
    EXPECT_NEAR(moved[5] - at[5], kShift * at[1] * chord_over_span, kRounding);
  }
}

// Classic RK4 is of fourth order where the tables are smooth, that is inside their cells.
TEST(Plant, IntegratesToFourthOrderBetweenTheTablesKinks) {
  const Plant plant(F16(), AtmosphereModel::kStevensLewis);
  RigidBodyState start;
  start << 598.5, 3, 32, 0.02, 0.01, -0.01, 0, 0, -15000, 1, 0, 0, 0;  // alpha 3, beta 0.3 deg
  const Controls controls{3000, -2, 0.5, 0.5, 5};
  constexpr double kTime = 0.16;
  const auto fly = [&](int steps) {
    RigidBodyState state = start;
    for (int i = 0; i < steps; ++i) state = plant.StepRk4(state, controls, kTime / steps);
    return state;
  };
  const RigidBodyState exact = fly(256);
  const double coarse = (fly(2) - exact).norm();
  const double fine = (fly(4) - exact).norm();
  EXPECT_GT(coarse / fine, 12);  // 16 for fourth order, 8 for third
  EXPECT_LT(coarse / fine, 24);
}

TEST(Plant, OtherGainsChangeNeitherAirNorGravity) {
  Gravity gravity;
  gravity.at_sea_level_ft_s2 = 5.3;
  const Plant plant(F16(), AtmosphereModel::kStandard1976, 0.7, gravity);
  FlightControlGains gains = plant.aircraft().flight_control;
  gains.max_load_factor_command += 1;
  const Plant other = plant.WithFlightControl(gains);
  EXPECT_EQ(other.aircraft().flight_control.max_load_factor_command, gains.max_load_factor_command);
  RigidBodyState state = RigidBodyState::Zero();
  state.segment<3>(kU) << 600, 20, 40;
  state[kDown] = -15000;
  state[kQ0] = 1;
  const PlantOutput before = plant.Evaluate(state, {}), after = other.Evaluate(state, {});
  EXPECT_EQ(after.state_rate, before.state_rate);
  EXPECT_EQ(after.air.dynamic_pressure_psf, before.air.dynamic_pressure_psf);
}

TEST(Plant, DragRisesWithTheMachNumberIfAskedTo) {
  Aircraft aircraft = F16();
  const Plant level(aircraft, AtmosphereModel::kStevensLewis);
  aircraft.drag_rises = true;
  const Plant rising(aircraft, AtmosphereModel::kStevensLewis);
  const double sound = AirAt(AtmosphereModel::kStevensLewis, 20000).sound_speed_ft_s;
  // Mach number, and the increment of the axial force coefficient there.
  const std::pair<double, double> rises[] = {{0.8, 0}, {1.1, 0.023}, {1.45, 0.019}, {2, 0.015}};
  for (const auto& [mach, rise] : rises) {
    RigidBodyState state = RigidBodyState::Zero();
    state[kU] = mach * sound;
    state[kDown] = -20000;
    state[kQ0] = 1;
    const PlantOutput without = level.Evaluate(state, {}), with = rising.Evaluate(state, {});
    EXPECT_NEAR(without.coefficients[0] - with.coefficients[0], rise, kDragRounding) << mach;
    EXPECT_EQ(with.coefficients.tail<5>(), without.coefficients.tail<5>()) << mach;
    const double force = rise * with.air.dynamic_pressure_psf * aircraft.airframe.wing_area_ft2;
    EXPECT_NEAR(without.state_rate[kU] - with.state_rate[kU], force / aircraft.airframe.mass_slug,
                kAccelerationRounding)
        << mach;
  }
}

// Damping is by the rates relative to the air; inertia and attitude know only the aircraft's own.
TEST(Plant, AirThatTurnsWithTheAircraftDampsNothing) {
  const Plant plant(F16(), AtmosphereModel::kStevensLewis);
  RigidBodyState still = RigidBodyState::Zero();
  still.segment<3>(kU) << 600, 20, 40;
  still[kDown] = -15000;
  still.segment<4>(kQ0) = QuaternionFromEuler({0.3, 0.1, -1});
  const Eigen::Vector3d rates(0.4, -0.2, 0.1), none = Eigen::Vector3d::Zero();
  RigidBodyState turning = still;
  turning.segment<3>(kP) = rates;
  const PlantOutput at_rest = plant.Evaluate(still, {}), damped = plant.Evaluate(turning, {}),
                    carried = plant.Evaluate(turning, {}, none, rates);
  EXPECT_EQ(carried.coefficients, at_rest.coefficients);
  EXPECT_NE(carried.coefficients, damped.coefficients);
  EXPECT_EQ(carried.state_rate.tail<7>(), damped.state_rate.tail<7>());
  // Air that turns alone does to the moments what the aircraft's turning back would.
  EXPECT_EQ(plant.Evaluate(still, {}, none, -rates).coefficients, damped.coefficients);
}

}  // namespace
}  // namespace skein
