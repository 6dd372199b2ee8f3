// SPDX-License-Identifier: Apache-2.0
// The Aerosonde as it flies: against the check values that Beard and McLain publish with their
// book's simulation files (mavsim_python, chap4_check.py and chap5_check.py), and its flight
// control over its envelope.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "envs/air/atmosphere.h"
#include "envs/aircraft/registry.h"
#include "envs/aircraft/units.h"
#include "envs/reference/linearise.h"
#include "envs/reference/plant.h"
#include "envs/reference/trim.h"
#include "tests/envs/aerosonde_model.h"
#include "tests/envs/reference/test_flight.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr AtmosphereModel kAtmosphere = AtmosphereModel::kStandard1976;

/// The aircraft of the authors' files: without the parasitic drag that Skein's has.
Plant BookPlant() {
  DerivativeAircraft aircraft = AerosondeModel();
  aircraft.longitudinal.CD_parasitic = 0;
  return Plant(MakeAircraft(aircraft), kAtmosphere);
}

/// Where the air is as dense as the book's, 1.2682 kg/m^3: a thousand feet below the sea.
double BookAltitude() {
  double low = -3000, high = 0;
  while (high - low > 1e-6) {
    const double middle = (low + high) / 2;
    const double density = AirAt(kAtmosphere, middle).density_slug_ft3 * kKgM3PerSlugFt3;
    (density > 1.2682 ? low : high) = middle;
  }
  return low;
}

/// Body velocities in m/s, level.
RigidBodyState BookState(double u, double v, double w) {
  RigidBodyState state = RigidBodyState::Zero();
  state.segment<3>(kU) << u, v, w;
  state.segment<3>(kU) *= kFeetPerMetre;
  state[kDown] = -BookAltitude();
  state[kQ0] = 1;
  return state;
}

/// From the book's radians and signs.
Controls BookControls(double elevator, double aileron, double rudder) {
  Controls controls;
  controls.elevator_deg = elevator * kDegPerRad;
  controls.aileron_deg = -aileron * kDegPerRad;
  controls.rudder_deg = rudder * kDegPerRad;
  return controls;
}

// Trim at 25 m/s: alpha 0.0500 rad, elevator -0.1248 rad; thrust as of their throttle 0.6768.
TEST(Aerosonde, TrimsWhereTheBookDoes) {
  constexpr Tolerance kGravity{2e-4, "gravity: 32.17 ft/s^2, there 9.81 m/s^2"};
  constexpr Tolerance kGravityInElevator{5e-4, "gravity: 32.17 ft/s^2, there 9.81 m/s^2"};
  constexpr Tolerance kSymmetry{1e-9, "residual of the trim"};
  constexpr Tolerance kBetweenNodesThrust{0.15, "drag between the nodes of alpha, 7e-4 of 218 N"};
  TrimRequest request;
  request.altitude_ft = BookAltitude();
  request.true_airspeed_ft_s = 25 * kFeetPerMetre;
  const TrimPoint trim = Trim(BookPlant(), request);
  EXPECT_NEAR(trim.alpha_rad, 0.0500110, kGravity);
  EXPECT_NEAR(trim.controls.elevator_deg / kDegPerRad, -0.124778, kGravityInElevator);
  // Theirs holds the propeller's torque: 0.1 deg of aileron.
  EXPECT_NEAR(trim.controls.aileron_deg, 0, kSymmetry);
  EXPECT_NEAR(trim.controls.rudder_deg, 0, kSymmetry);
  const DerivativeAircraft aircraft = AerosondeModel();
  const Propeller& propeller = std::get<ElectricPropulsion>(aircraft.propulsion).propeller;
  EXPECT_NEAR(trim.controls.thrust_lbf * kNewtonsPerLbf,
              PropellerThrust(propeller, 0.676752, 25, 1.2682), kBetweenNodesThrust);
}

// "Case with wind" of their chapter 4: forces and moments at airspeed 27.39 m/s, alpha 0.0526 and
// beta 0.0228 rad, with rates and all surfaces deflected; their thrust, weight and propeller torque
// taken off.
TEST(Aerosonde, GivesTheBooksForcesAndMoments) {
  constexpr Tolerance kBetweenNodes{0.2, "between the nodes of alpha, 1e-3 of 218 N"};
  constexpr Tolerance kDigits{1e-5, "eight digits given"};
  const double speed = 27.39323489287441, alpha = 0.05259649205640062, beta = 0.022801214339060967;
  RigidBodyState state = BookState(speed * std::cos(alpha) * std::cos(beta), speed * std::sin(beta),
                                   speed * std::sin(alpha) * std::cos(beta));
  state.segment<3>(kP) << 4.98772167e-03, 1.68736005e-01, 1.71797313e-01;
  const PlantOutput output =
      BookPlant().Evaluate(state, BookControls(-0.15705144, 0.01788999, 0.01084654));
  const double qbar_S = 0.5 * 1.2682 * speed * speed * 0.55;
  const double e0 = 0.938688796, e1 = 0.247421558, e2 = 0.0656821468, e3 = 0.23093673;
  const double weight = 11 * 9.81;
  const double thrust = 31.31315544701058, torque = 1.58778287798956;
  EXPECT_NEAR(qbar_S * output.coefficients[0],
              36.22803068339798 - thrust - weight * 2 * (e1 * e3 - e2 * e0), kBetweenNodes);
  EXPECT_NEAR(qbar_S * output.coefficients[1], 48.44092504137796 - weight * 2 * (e2 * e3 + e1 * e0),
              kDigits);
  EXPECT_NEAR(qbar_S * output.coefficients[2],
              -39.39246596662818 - weight * (e3 * e3 + e0 * e0 - e1 * e1 - e2 * e2), kBetweenNodes);
  EXPECT_NEAR(qbar_S * 2.8956 * output.coefficients[3], 0.10867448074086083 + torque, kDigits);
  EXPECT_NEAR(qbar_S * 0.18994 * output.coefficients[4], 0.1249623335264915, kDigits);
  EXPECT_NEAR(qbar_S * 2.8956 * output.coefficients[5], -0.09481002421995177, kDigits);
}

// The state-space models of their chapter 5, at their trim.
TEST(Aerosonde, LinearisesToTheBooksModels) {
  // Between nodes of alpha, slopes are the cell's: of Cx up to 0.12 per rad off its own.
  constexpr Tolerance kCellSlope{0.01, "slopes are those of alpha's cells"};
  constexpr Tolerance kCellSlopeOfCx{0.1, "slopes are those of alpha's cells"};
  constexpr Tolerance kLateral{1e-3, "conversion of the book's angles"};
  const double theta = 0.05001119;
  RigidBodyState state = BookState(24.968743, 0, 1.249755);
  state[kQ0] = std::cos(theta / 2);
  state[kQy] = std::sin(theta / 2);
  const LinearModel model =
      Linearise(BookPlant(), state, BookControls(-0.124778, 0.001836, -0.000303));
  // Their thrust falls by 2.35 N per m/s, here it is held; along u and w:
  const double per_speed = 2.3521982958853327 / 11;
  const double u_share = 24.968743 / 25, w_share = 1.249755 / 25;
  // A length in the row or the column.
  const double ft = kFeetPerMetre;
  const struct {
    int row, column;
    double expected, tolerance;
  } entries[] = {
      {kU, kU, -0.20676658 + per_speed * u_share, kCellSlope},
      {kU, kW, 0.50039026 + per_speed * w_share, kCellSlopeOfCx},
      {kU, kQ, -1.21983882 * ft, kCellSlope * ft},
      {kW, kU, -0.56064206, 2 * kCellSlope},
      {kW, kW, -4.46393561, 2 * kCellSlope},
      {kW, kQ, 24.37105023 * ft, kCellSlope * ft},
      {kQ, kU, 0.19993539 / ft, kCellSlope / ft},
      {kQ, kW, -3.99297865 / ft, kCellSlope / ft},
      {kQ, kQ, -5.29473836, kCellSlope / 2},
      {kV, kV, -0.776772629, kLateral},
      {kV, kP, 1.24975500 * ft, kLateral * ft},
      {kV, kR, -24.9687430 * ft, kLateral * ft},
      {kP, kV, -3.86671935 / ft, kLateral / ft},
      {kP, kP, -22.6288510, kLateral},
      {kP, kR, 10.9050409, kLateral},
      {kR, kV, 0.783077145 / ft, kLateral / ft},
      {kR, kP, -0.115091678, kLateral},
      {kR, kR, -1.22765475, kLateral},
  };
  for (const auto& entry : entries) {
    EXPECT_NEAR(model.A(entry.row, entry.column), entry.expected, entry.tolerance)
        << "A(" << entry.row << ", " << entry.column << ")";
  }
  enum Input { kElevatorInput = 1, kAileronInput, kRudderInput };
  const struct {
    int row, input;
    double expected, tolerance;
  } inputs[] = {
      {kU, kElevatorInput, -0.13840016 * ft, kCellSlope * ft},
      {kW, kElevatorInput, -2.58618345 * ft, kCellSlope * ft},
      {kQ, kElevatorInput, -36.11239041, kCellSlope},
      {kV, kAileronInput, -1.48617191 * ft, kLateral * ft},
      {kP, kAileronInput, -130.88368125, 10 * kLateral},
      {kR, kAileronInput, -5.01173513, kLateral},
      {kV, kRudderInput, 3.76496884 * ft, kLateral * ft},
      {kP, kRudderInput, -1.79637441, kLateral},
      {kR, kRudderInput, -24.88134191, kLateral},
  };
  for (const auto& input : inputs) {
    EXPECT_NEAR(model.B(input.row, input.input) * kDegPerRad, input.expected, input.tolerance)
        << "B(" << input.row << ", " << input.input << ")";
  }
}

/// The eigenvalue nearest to `guess`.
std::complex<double> Mode(const Eigen::VectorXcd& eigenvalues, std::complex<double> guess) {
  std::complex<double> nearest = eigenvalues[0];
  for (const std::complex<double>& value : eigenvalues) {
    if (std::abs(value - guess) < std::abs(nearest - guess)) nearest = value;
  }
  return nearest;
}

// Natural modes at 25 m/s against the reduced-order models of the book's section 5.6, from
// stability derivatives.
TEST(Aerosonde, HasTheModesOfItsDerivatives) {
  constexpr Tolerance kReducedOrder{0.05, "reduced order, relative"};
  constexpr Tolerance kWithoutAlpha{0.35, "the book's phugoid leaves out alpha's part"};
  constexpr Tolerance kWithoutRoll{0.25, "the book's Dutch roll leaves out the roll"};
  const Plant plant(LoadAircraft("aerosonde"), kAtmosphere);
  TrimRequest request;
  request.true_airspeed_ft_s = 25 * kFeetPerMetre;
  const TrimPoint trim = Trim(plant, request);
  const LinearModel model = Linearise(plant, trim.state, trim.controls);
  const Eigen::VectorXcd modes = Eigen::EigenSolver<Eigen::MatrixXd>(model.A).eigenvalues();
  const auto A = [&model](int row, int column) { return model.A(row, column); };
  const double u = trim.state[kU];
  const std::complex<double> i(0, 1);

  const double sum = A(kW, kW) + A(kQ, kQ);
  const double product = A(kW, kW) * A(kQ, kQ) - u * A(kQ, kW);
  const std::complex<double> short_period = sum / 2 + i * std::sqrt(product - sum * sum / 4);
  EXPECT_LT(std::abs(Mode(modes, short_period) - short_period),
            kReducedOrder * std::abs(short_period));

  const std::complex<double> phugoid =
      A(kU, kU) / 2 + i * std::sqrt(-A(kW, kU) * kGravityFtS2 / u - A(kU, kU) * A(kU, kU) / 4);
  EXPECT_LT(std::abs(Mode(modes, phugoid) - phugoid), kWithoutAlpha * std::abs(phugoid));

  EXPECT_NEAR(Mode(modes, A(kP, kP)).real(), A(kP, kP), kReducedOrder * std::abs(A(kP, kP)));

  const double yaw_sum = A(kV, kV) + A(kR, kR);
  const std::complex<double> dutch_roll =
      yaw_sum / 2 + i * std::sqrt(A(kV, kV) * A(kR, kR) + u * A(kR, kV) - yaw_sum * yaw_sum / 4);
  EXPECT_LT(std::abs(Mode(modes, dutch_roll) - dutch_roll), kWithoutRoll * std::abs(dutch_roll));

  // The spiral diverges, slowly.
  const double spiral = Mode(modes, 0.09).real();
  EXPECT_GT(spiral, 0.02);
  EXPECT_LT(spiral, 0.2);
}

/// Trimmed flight at 19 to 33 m/s, from the most elevator to full throttle.
std::vector<TrimPoint> Envelope(const Plant& plant) {
  std::vector<TrimPoint> envelope;
  for (const double altitude_ft : {0.0, 1500.0, 4000.0}) {
    for (double speed = 19; speed <= 33; speed += 2) {
      TrimRequest request;
      request.altitude_ft = altitude_ft;
      request.true_airspeed_ft_s = speed * kFeetPerMetre;
      envelope.push_back(Trim(plant, request));
    }
  }
  return envelope;
}

class AerosondeEnvelope : public ::testing::Test {
 protected:
  static std::string Where(const TrimPoint& trim) {
    return std::to_string(-trim.state[kDown]) + " ft, " +
           std::to_string(trim.state.segment<3>(kU).norm() / kFeetPerMetre) + " m/s";
  }

  const Plant plant_{LoadAircraft("aerosonde"), kAtmosphere};
  const std::vector<TrimPoint> envelope_ = Envelope(plant_);
};

TEST_F(AerosondeEnvelope, FliesHandsOff) {
  for (const Setting& setting : {Setting{4, false, 1}, Setting{4, true, 1}, Setting{4, false, 4}}) {
    for (const TrimPoint& trim : envelope_) {
      SCOPED_TRACE(Where(trim));
      const Flight flight = Fly(plant_, trim, 7, kHandsOff, setting);
      EXPECT_FALSE(flight.Departed());
      EXPECT_LT(Ringing(flight, flight.q, 5), 0.3);
      EXPECT_LT(Ringing(flight, flight.r, 5), 0.3);
      EXPECT_LT(Ringing(flight, flight.p, 5), 1);
      EXPECT_LT(std::abs(flight.bank.back()), 1);
    }
  }
}

// Full sticks, held for 4 s or reversed each second, neither stall nor overload it.
TEST_F(AerosondeEnvelope, SurvivesFullSticks) {
  const auto square = [](double time) { return std::fmod(time, 2) < 1 ? 1.0 : -1.0; };
  const Sticks abuses[] = {
      Held(1, 0, 0),
      Held(-1, 0, 0),
      Held(0, 1, 0),
      Held(1, 1, 0),
      Held(0, 0, 1),
      [&](double time, PilotCommands* pilot) { pilot->pitch = square(time); },
      [&](double time, PilotCommands* pilot) { pilot->roll = square(time); },
      [&](double time, PilotCommands* pilot) { pilot->yaw = square(time); },
  };
  for (std::size_t i = 0; i < std::size(abuses); ++i) {
    for (const TrimPoint& trim : envelope_) {
      SCOPED_TRACE(Where(trim) + ", abuse " + std::to_string(i));
      const Flight flight = Fly(plant_, trim, 4, abuses[i]);
      EXPECT_FALSE(flight.Departed());
      EXPECT_LT(Peak(flight.alpha), 20);
      EXPECT_LT(Peak(flight.nz), 4);
    }
  }
}

TEST_F(AerosondeEnvelope, AnswersSteps) {
  for (const TrimPoint& trim : envelope_) {
    SCOPED_TRACE(Where(trim));
    // 60 deg/s of roll asked for: the loop is proportional.
    const Flight roll = Fly(plant_, trim, 1, Held(0, 0.4, 0));
    EXPECT_GT(roll.p.back(), 25);
    EXPECT_LT(Peak(roll.p), 45);
    EXPECT_LT(Peak(roll.beta), 4);
    // 0.2 g asked for, where alpha leaves room.
    if (trim.alpha_rad * kDegPerRad > 6) continue;
    const Flight pitch = Fly(plant_, trim, 1.5, Held(0.1, 0, 0));
    EXPECT_GT(pitch.nz.back(), 1.1);
    EXPECT_LT(Peak(pitch.nz), 1.25);
  }
}

}  // namespace
}  // namespace skein
