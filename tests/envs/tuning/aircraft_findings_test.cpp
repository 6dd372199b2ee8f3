// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/aircraft_findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "envs/aircraft/f16.h"
#include "envs/aircraft/units.h"
#include "tests/envs/aerosonde_model.h"

namespace skein {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr AtmosphereModel kAtmosphere = AtmosphereModel::kStandard1976;

std::string TextOf(const std::vector<Finding>& findings, Finding::Kind kind) {
  std::string text;
  for (const Finding& finding : findings) {
    if (finding.kind == kind) text += finding.text + "\n";
  }
  return text;
}

TEST(AircraftFindings, ThePublishedAircraftHasNone) {
  EXPECT_TRUE(CheckDerivatives(AerosondeModel()).empty());
}

TEST(AircraftFindings, EveryWrongSignOrRatioIsNamed) {
  const struct {
    std::function<void(DerivativeAircraft*)> spoil;
    Finding::Kind kind;
    const char* says;
  } cases[] = {
      {[](auto* a) { a->longitudinal.CL_alpha = -1; }, Finding::kError, "CL_alpha = -1"},
      {[](auto* a) { a->longitudinal.CL_alpha = 0.1; }, Finding::kWarning, "per degree?"},
      {[](auto* a) { a->longitudinal.CD_parasitic = 0; }, Finding::kError, "without drag"},
      {[](auto* a) { a->longitudinal.Cm_alpha = 0.3; }, Finding::kWarning, "static margin"},
      {[](auto* a) { a->longitudinal.Cm_q = 3; }, Finding::kError, "does not damp pitch"},
      {[](auto* a) { a->longitudinal.Cm_elevator = 1; }, Finding::kError, "Cm_elevator"},
      {[](auto* a) { a->lateral.Cl_p = 0.5; }, Finding::kError, "does not damp roll"},
      {[](auto* a) { a->lateral.Cn_r = 0.1; }, Finding::kError, "does not damp yaw"},
      {[](auto* a) { a->lateral.Cl_aileron = -0.1; }, Finding::kError, "roll right"},
      {[](auto* a) { a->lateral.Cn_rudder = 0.1; }, Finding::kError, "yaws left"},
      {[](auto* a) { a->lateral.Cn_beta = -0.1; }, Finding::kWarning, "weathercock"},
      {[](auto* a) { a->lateral.Cl_beta = 0.1; }, Finding::kWarning, "into the wind"},
      {[](auto* a) { a->lateral.CY_beta = 0.1; }, Finding::kWarning, "side force"},
      {[](auto* a) { a->lateral.Cn_aileron = 0.1; }, Finding::kWarning, "into the roll"},
      {[](auto* a) { a->Ixx_kg_m2 *= 20; }, Finding::kWarning, "radius of gyration"},
      {[](auto* a) { a->Izz_kg_m2 *= 2; }, Finding::kError, "Izz_kg_m2 = 3.518 is above the sum"},
      {[](auto* a) { a->Ixx_kg_m2 = 3; }, Finding::kError, "Ixx_kg_m2 = 3 is above the sum"},
      {[](auto* a) { a->Iyy_kg_m2 = 2.7; }, Finding::kError, "Iyy_kg_m2 = 2.7 is above the sum"},
      {[](auto* a) { a->Ixz_kg_m2 = 0.6; }, Finding::kError, "Ixz_kg_m2 = 0.6 makes principal"},
      {[](auto* a) { a->Ixz_kg_m2 = -0.6; }, Finding::kError, "Ixz_kg_m2 = -0.6 makes principal"},
      {[](auto* a) { a->chord_m *= 3; }, Finding::kWarning, "chord_m"},
      {[](auto* a) { a->mass_kg = 0.1; }, Finding::kWarning, "wing loading"},
      {[](auto* a) { a->longitudinal.Cm_elevator /= kDegPerRad; }, Finding::kWarning,
       "longitudinal.Cm_elevator = -0.0172788 per radian"},
      {[](auto* a) { a->lateral.CY_beta /= kDegPerRad; }, Finding::kWarning, "lateral.CY_beta"},
      {[](auto* a) { a->lateral.Cl_p /= kDegPerRad; }, Finding::kWarning, "lateral.Cl_p"},
      {[](auto* a) { a->lateral.Cl_aileron /= kDegPerRad; }, Finding::kWarning,
       "lateral.Cl_aileron = 0.00296706 per radian"},
      {[](auto* a) { a->elevator.min_deg /= kDegPerRad, a->elevator.max_deg /= kDegPerRad; },
       Finding::kWarning, "actuators.elevator goes from -0.436332 to 0.436332 deg"},
      {[](auto* a) { a->rudder.rate_limit_deg_per_s /= kDegPerRad; }, Finding::kWarning,
       "actuators.rudder.rate_limit_deg_per_s"},
  };
  for (const auto& one : cases) {
    DerivativeAircraft aircraft = AerosondeModel();
    one.spoil(&aircraft);
    EXPECT_THAT(TextOf(CheckDerivatives(aircraft), one.kind), HasSubstr(one.says));
  }
}

TEST(AircraftFindings, AnAircraftMayHaveNoRudder) {
  DerivativeAircraft wing = AerosondeModel();
  wing.lateral.Cn_rudder = 0;
  wing.rudder.min_deg = -1;
  wing.rudder.max_deg = 1;
  const std::vector<Finding> findings = CheckDerivatives(wing);
  EXPECT_EQ(TextOf(findings, Finding::kError), "");
  EXPECT_THAT(TextOf(findings, Finding::kWarning), HasSubstr("there is no rudder"));
  EXPECT_THAT(TextOf(findings, Finding::kWarning), Not(HasSubstr("actuators.rudder")));
}

TEST(AircraftFindings, TablesInAnotherUnitStandOut) {
  const Airframe f16 = F16().airframe;
  EXPECT_TRUE(CheckAirframe(f16).empty());
  const struct {
    std::function<void(Airframe*)> spoil;
    const char* says;
  } cases[] = {
      {[](auto* a) { a->mass_slug *= kKgPerSlug; }, "airframe.mass_slug, wing_area_ft2"},
      {[](auto* a) { a->wing_area_ft2 *= kMetresPerFoot * kMetresPerFoot; }, "wing loading"},
      {[](auto* a) { a->chord_ft *= kMetresPerFoot; }, "airframe.chord_ft = 3.45"},
      {[](auto* a) { a->Ixx *= 10; }, "airframe.Ixx_slug_ft2"},
  };
  for (const auto& one : cases) {
    Airframe airframe = f16;
    one.spoil(&airframe);
    EXPECT_THAT(TextOf(CheckAirframe(airframe), Finding::kWarning), HasSubstr(one.says));
  }
}

TEST(AircraftFindings, NoPropellerGivesMoreThanItTakes) {
  DerivativeAircraft aircraft = AerosondeModel();
  PistonPropulsion piston;
  piston.engine.advance_ratio = {0, 0.7};
  piston.engine.CT = {0.1, 0.09};
  piston.engine.CP = {0.06, 0.05};
  aircraft.propulsion = piston;
  EXPECT_THAT(TextOf(CheckDerivatives(aircraft), Finding::kError),
              HasSubstr("at the advance ratio 0.7 its efficiency is 1.26"));
}

TEST(AircraftFindings, NoPropellerOfAMotorGivesMoreThanItTakes) {
  DerivativeAircraft aircraft = AerosondeModel();
  double& CQ_0 = std::get<ElectricPropulsion>(aircraft.propulsion).propeller.CQ_0;
  const auto errors = [&] { return TextOf(CheckDerivatives(aircraft), Finding::kError); };
  CQ_0 = 0.0047;
  EXPECT_THAT(errors(), HasSubstr("at the advance ratio 0.61 its efficiency is 1.04"));
  CQ_0 = 0.004;
  EXPECT_THAT(errors(), HasSubstr("at the advance ratio 0.67 the propeller gives thrust (CT = "
                                  "0.00464) and takes no torque"));
  CQ_0 = 0.0049;
  EXPECT_EQ(errors(), "");
  EXPECT_THAT(TextOf(CheckDerivatives(aircraft), Finding::kWarning),
              HasSubstr("propellers reach 0.9"));
}

TEST(AircraftFindings, DragIsNotNegativeAtATrim) {
  EnvelopeLimits limits;
  limits.max_speed_ft_s = 1000;
  const auto check = [&](const DerivativeAircraft& aircraft) {
    const Plant plant(MakeAircraft(aircraft), kAtmosphere);
    const FlightEnvelope envelope = FindEnvelope(plant, limits, 1, 3);
    EXPECT_FALSE(envelope.AllTrims().empty());
    return TextOf(CheckDrag(plant, envelope, " (longitudinal.CD_elevator?)"), Finding::kError);
  };
  DerivativeAircraft aircraft = AerosondeModel();
  EXPECT_EQ(check(aircraft), "");
  aircraft.longitudinal.CD_elevator = 1;  // times an elevator that is negative in level flight
  const std::string error = check(aircraft);
  EXPECT_THAT(error, HasSubstr("m/s drag is negative, CD = -"));
  EXPECT_THAT(error, HasSubstr("(longitudinal.CD_elevator?)"));
}

TEST(AircraftFindings, SaysWhyThereIsNoLevelFlight) {
  DerivativeAircraft heavy = AerosondeModel();
  heavy.longitudinal.CD_parasitic = 0.5;
  const Plant plant(MakeAircraft(heavy), kAtmosphere);
  TuningLimits limits;
  limits.envelope.max_speed_ft_s = 1000;
  const FlightEnvelope envelope = FindEnvelope(plant, limits.envelope, 1, 3);
  EXPECT_TRUE(envelope.AllTrims().empty());
  EXPECT_THAT(TextOf(CheckEnvelope(plant, limits, envelope), Finding::kError),
              HasSubstr("needs a thrust of"));
}

TEST(AircraftFindings, NamesTheModeThatDiverges) {
  DerivativeAircraft unstable = AerosondeModel();
  unstable.longitudinal.Cm_alpha = 0.3;
  const Plant plant(MakeAircraft(unstable), kAtmosphere);
  TuningLimits limits;
  limits.envelope.max_speed_ft_s = 1000;
  const FlightEnvelope envelope = FindEnvelope(plant, limits.envelope, 1, 3);
  EXPECT_THAT(TextOf(CheckModes(plant, envelope), Finding::kWarning),
              HasSubstr("has a time to double of"));
}

TEST(AircraftFindings, GainsThatBreakTheLoopAreAnError) {
  DerivativeAircraft wild = AerosondeModel();
  wild.flight_control.pitch_proportional_deg_per_g *= 6;
  const Plant plant(MakeAircraft(wild), kAtmosphere);
  TuningLimits limits;
  limits.envelope.max_speed_ft_s = 1000;
  const FlightEnvelope envelope = FindEnvelope(plant, limits.envelope, 1, 3);
  const TrimPoint trim = envelope.AllTrims().back();
  EXPECT_THAT(TextOf(CheckHandling(limits, envelope.greatest_lift.alpha_deg, trim,
                                   AssessHandling(plant, trim)),
                     Finding::kError),
              AllOf(HasSubstr("unstable"), Not(HasSubstr("diverges"))))
      << "the mode is fast, and named once";
}

}  // namespace
}  // namespace skein
