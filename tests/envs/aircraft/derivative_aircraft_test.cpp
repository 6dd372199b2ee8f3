// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/derivative_aircraft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "envs/reference/aerodynamics.h"
#include "tests/envs/aerosonde_model.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kRounding{1e-12, "float64 rounding"};
constexpr Tolerance kSameSums{1e-15, "float64 rounding of the same sums"};
constexpr Tolerance kStallBlend{1e-8, "what the smooth stall leaves at 0.1 rad"};
constexpr Tolerance kDigits{1e-6, "six decimals known"};

class DerivativeAircraftTest : public ::testing::Test {
 protected:
  const DerivativeAircraft source_ = AerosondeModel();
  const double aspect_ratio_ = source_.span_m * source_.span_m / source_.wing_area_m2;
  const Aircraft aircraft_ = MakeAircraft(source_);
};

/// The book's formulas without tables: Beard and McLain, chapter 4, in Skein's signs.
AerodynamicCoefficients Formulas(const DerivativeAircraft& source, double aspect_ratio,
                                 const AerodynamicCondition& c) {
  const LongitudinalDerivatives& k = source.longitudinal;
  const LateralDerivatives& l = source.lateral;
  const double alpha = c.alpha_deg / kDegPerRad, beta = c.beta_deg / kDegPerRad;
  const double elevator = c.elevator_deg / kDegPerRad, rudder = c.rudder_deg / kDegPerRad;
  const double aileron = -c.aileron_deg / kDegPerRad;
  const double CL = LiftCoefficient(k, alpha) + k.CL_q * c.q_hat + k.CL_elevator * elevator;
  const double CD =
      DragCoefficient(k, aspect_ratio, alpha) + k.CD_q * c.q_hat + k.CD_elevator * elevator;
  AerodynamicCoefficients C;
  C << -CD * std::cos(alpha) + CL * std::sin(alpha),
      l.CY_beta * beta + l.CY_p * c.p_hat + l.CY_r * c.r_hat + l.CY_aileron * aileron +
          l.CY_rudder * rudder,
      -CD * std::sin(alpha) - CL * std::cos(alpha),
      l.Cl_beta * beta + l.Cl_p * c.p_hat + l.Cl_r * c.r_hat + l.Cl_aileron * aileron +
          l.Cl_rudder * rudder,
      k.Cm_0 + k.Cm_alpha * alpha + k.Cm_q * c.q_hat + k.Cm_elevator * elevator,
      l.Cn_beta * beta + l.Cn_p * c.p_hat + l.Cn_r * c.r_hat + l.Cn_aileron * aileron +
          l.Cn_rudder * rudder;
  return C;
}

TEST_F(DerivativeAircraftTest, TablesHoldTheDerivatives) {
  // An eighth of the cell's square times the second derivative, at most 2 CL_alpha of Cx. Lift
  // stalls from 20 deg on.
  constexpr Tolerance kBetweenNodes{8e-4, "cells of 1.25 deg of alpha"};
  std::mt19937 random(3);
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 2000; ++i) {
    AerodynamicCondition c;
    c.alpha_deg = uniform(-5, 20);
    c.beta_deg = uniform(-30, 30);
    c.elevator_deg = uniform(-25, 25);
    c.aileron_deg = uniform(-25, 25);
    c.rudder_deg = uniform(-25, 25);
    c.p_hat = uniform(-0.1, 0.1);
    c.q_hat = uniform(-0.02, 0.02);
    c.r_hat = uniform(-0.1, 0.1);
    const AerodynamicCoefficients tables = EvaluateAerodynamics(aircraft_, c);
    const AerodynamicCoefficients exact = Formulas(source_, aspect_ratio_, c);
    EXPECT_NEAR(tables[0], exact[0], kBetweenNodes) << c.alpha_deg;
    EXPECT_NEAR(tables[2], exact[2], kBetweenNodes) << c.alpha_deg;
    for (const int linear : {1, 3, 4, 5}) EXPECT_NEAR(tables[linear], exact[linear], kRounding);
  }
}

TEST_F(DerivativeAircraftTest, TablesAreExactAtTheirNodesThroughTheStall) {
  for (const double alpha_deg : aircraft_.aerodynamics.alpha_deg) {
    AerodynamicCondition c;
    c.alpha_deg = alpha_deg;
    c.elevator_deg = 12.5;
    c.q_hat = 0.01;
    const AerodynamicCoefficients error =
        EvaluateAerodynamics(aircraft_, c) - Formulas(source_, aspect_ratio_, c);
    EXPECT_LT(error.cwiseAbs().maxCoeff(), kRounding) << alpha_deg;
  }
}

TEST_F(DerivativeAircraftTest, TheFlapThatIsNotThereDoesNothing) {
  AerodynamicCondition up, down;
  up.alpha_deg = down.alpha_deg = 6.3;
  up.beta_deg = down.beta_deg = 4;
  up.aileron_deg = down.aileron_deg = 7;
  down.leading_edge_flap_deg = 1;
  EXPECT_LT((EvaluateAerodynamics(aircraft_, up) - EvaluateAerodynamics(aircraft_, down))
                .cwiseAbs()
                .maxCoeff(),
            kSameSums);
}

TEST_F(DerivativeAircraftTest, LiftIsLinearBelowTheStallAndAFlatPlatesAbove) {
  const LongitudinalDerivatives& k = source_.longitudinal;
  EXPECT_NEAR(LiftCoefficient(k, 0.1), k.CL_0 + k.CL_alpha * 0.1, kStallBlend);
  EXPECT_NEAR(LiftCoefficient(k, -0.1), k.CL_0 - k.CL_alpha * 0.1, kStallBlend);
  const double steep = 1.2;
  const double plate = 2 * std::sin(steep) * std::sin(steep) * std::cos(steep);
  EXPECT_NEAR(LiftCoefficient(k, steep), plate, kRounding);
  EXPECT_NEAR(LiftCoefficient(k, -steep), -plate, kRounding);
  EXPECT_GT(LiftCoefficient(k, 0.42), LiftCoefficient(k, 0.55));
}

TEST_F(DerivativeAircraftTest, MassAndGeometryAreThoseOfTheBookInFootAndSlug) {
  const Airframe& a = aircraft_.airframe;
  EXPECT_NEAR(a.mass_slug, 0.753739, kDigits);  // 24.25 lb
  EXPECT_NEAR(a.wing_area_ft2, 5.920151, kDigits);
  EXPECT_NEAR(a.span_ft, 9.5, kRounding);
  EXPECT_NEAR(a.chord_ft, 0.623163, kDigits);
  EXPECT_NEAR(a.Iyy, 0.837133, kDigits);
  EXPECT_NEAR(a.Ixz / a.Ixx, 0.1204 / 0.8244, kRounding);
}

}  // namespace
}  // namespace skein
