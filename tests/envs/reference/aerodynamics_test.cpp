// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/aerodynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "envs/aircraft/f16.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kRounding{1e-12, "float64 rounding"};

class Aerodynamics : public ::testing::Test {
 protected:
  AerodynamicCondition RandomCondition() {
    std::uniform_real_distribution<double> unit(-1, 1);
    AerodynamicCondition c;
    c.alpha_deg = 12 + 32 * unit(random_);
    c.beta_deg = 29 * unit(random_);
    c.elevator_deg = 24 * unit(random_);
    c.aileron_deg = 21 * unit(random_);
    c.rudder_deg = 29 * unit(random_);
    c.leading_edge_flap_deg = 12.5 + 12.5 * unit(random_);
    c.p_hat = 0.05 * unit(random_);
    c.q_hat = 0.02 * unit(random_);
    c.r_hat = 0.05 * unit(random_);
    return c;
  }
  AerodynamicCoefficients At(const AerodynamicCondition& c) const {
    return EvaluateAerodynamics(aircraft_, c);
  }

  Aircraft aircraft_ = F16();
  std::mt19937_64 random_{1};
};

TEST_F(Aerodynamics, IsAffineInAileronRudderFlapAndRates) {
  for (int n = 0; n < 100; ++n) {
    const AerodynamicCondition c = RandomCondition();
    for (double AerodynamicCondition::*input :
         {&AerodynamicCondition::aileron_deg, &AerodynamicCondition::rudder_deg,
          &AerodynamicCondition::leading_edge_flap_deg, &AerodynamicCondition::p_hat,
          &AerodynamicCondition::q_hat, &AerodynamicCondition::r_hat}) {
      AerodynamicCondition less = c, more = c;
      less.*input -= 0.01;
      more.*input += 0.01;
      EXPECT_LT((At(less) + At(more) - 2 * At(c)).norm(), kRounding);
    }
  }
}

// Beyond an axis nothing changes: the tables say no more there.
TEST_F(Aerodynamics, IsConstantBeyondTheTables) {
  for (int n = 0; n < 100; ++n) {
    AerodynamicCondition at = RandomCondition();
    at.alpha_deg = n % 2 ? 90 : -20;
    at.beta_deg = n % 4 < 2 ? 30 : -30;
    at.elevator_deg = n % 8 < 4 ? 25 : -25;
    AerodynamicCondition beyond = at;
    beyond.alpha_deg *= 1.5;
    beyond.beta_deg *= 2;
    beyond.elevator_deg *= 3;
    EXPECT_LT((At(at) - At(beyond)).norm(), kRounding);
  }
}

// The flap's increments end at alpha 45: above it they keep the value they have there.
TEST_F(Aerodynamics, FlapIncrementsAreHeldAboveTheirRange) {
  for (int n = 0; n < 100; ++n) {
    AerodynamicCondition c = RandomCondition();
    const auto increment = [&](double alpha_deg) {
      c.alpha_deg = alpha_deg;
      c.leading_edge_flap_deg = 0;
      const AerodynamicCoefficients up = At(c);
      c.leading_edge_flap_deg = 25;
      return AerodynamicCoefficients(up - At(c));
    };
    EXPECT_LT((increment(45) - increment(63)).norm(), kRounding);
  }
}

TEST_F(Aerodynamics, SurfacesActInTheDirectionsOfTheConventions) {
  for (double alpha : {-5.0, 0.0, 5.0, 10.0, 20.0}) {
    AerodynamicCondition c;
    c.alpha_deg = alpha;
    const AerodynamicCoefficients centred = At(c);
    c.elevator_deg = 10;
    EXPECT_LT(At(c)[4], centred[4]) << "elevator down pitches the nose down, alpha " << alpha;
    c.elevator_deg = 0;
    c.aileron_deg = 10;
    EXPECT_LT(At(c)[3], centred[3]) << "aileron + rolls left, alpha " << alpha;
    c.aileron_deg = 0;
    c.rudder_deg = 10;
    EXPECT_LT(At(c)[5], centred[5]) << "rudder + yaws left, alpha " << alpha;
  }
}

TEST_F(Aerodynamics, RatesAreDampedInNormalFlight) {
  for (double alpha : {0.0, 5.0, 10.0, 20.0}) {
    AerodynamicCondition c;
    c.alpha_deg = alpha;
    const AerodynamicCoefficients still = At(c);
    c.p_hat = 0.01;
    EXPECT_LT(At(c)[3], still[3]);
    c.p_hat = 0;
    c.q_hat = 0.01;
    EXPECT_LT(At(c)[4], still[4]);
    c.q_hat = 0;
    c.r_hat = 0.01;
    EXPECT_LT(At(c)[5], still[5]);
  }
}

// Left and right differ by what the wind tunnel measured, and no more.
TEST_F(Aerodynamics, IsNearlySymmetric) {
  constexpr double kMeasuredAsymmetry = 0.021;
  for (double alpha = -20; alpha <= 20; alpha += 1) {
    for (double beta = 0; beta <= 30; beta += 1) {
      AerodynamicCondition right, left;
      right.alpha_deg = left.alpha_deg = alpha;
      right.beta_deg = beta;
      left.beta_deg = -beta;
      EXPECT_LT(std::abs(At(right)[3] + At(left)[3]), kMeasuredAsymmetry) << alpha << " " << beta;
    }
  }
}

// The increment of Czq for the flap, not that of Cz, damps the normal force.
TEST_F(Aerodynamics, PitchDampingTakesTheFlapsOwnIncrement) {
  AerodynamicCondition c;
  c.alpha_deg = -10;  // a node, where dCzq_lef is 15.1 and Czq -23.9 per radian
  c.leading_edge_flap_deg = 0;
  const double still = At(c)[2];
  c.q_hat = 0.01;
  EXPECT_NEAR(At(c)[2] - still, 0.01 * (-23.9 + 15.1), kRounding);
}

}  // namespace
}  // namespace skein
