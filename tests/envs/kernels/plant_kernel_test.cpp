// SPDX-License-Identifier: Apache-2.0
#include "envs/kernels/plant_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "envs/aircraft/engine.h"
#include "envs/aircraft/f16.h"
#include "envs/aircraft/registry.h"
#include "envs/reference/plant.h"
#include "envs/state/attitude.h"
#include "gtest/gtest.h"
#include "simd/target.h"
#include "tests/envs/every_aircraft.h"
#include "tests/envs/golden.h"
#include "tests/envs/plant/drawn_aircraft.h"
#include "tests/envs/test_tile.h"
#include "tests/extremes.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using Json = nlohmann::json;

constexpr int kNumControls = 5;  // thrust, elevator, aileron, rudder, leading-edge flap
constexpr int kNumCoefficients = 6;

/// Given controls of a tile.
struct TestControls {
  explicit TestControls(int count) : values(count, kNumControls) {}
  ControlColumns columns() {
    const Tile t = values.tile();
    return {t[0], t[1], t[2], t[3], t[4]};
  }
  TestTile values;
};

/// Rates and coefficients of a tile.
struct TestRates {
  explicit TestRates(int count)
      : rates(count, kNumRigidBody), coefficients(count, kNumCoefficients) {}
  TestTile rates, coefficients;
};

TestRates Evaluate(const KernelAircraft& aircraft, TestTile* states, TestControls* controls) {
  TestRates out(states->count());
  EvaluateTile(aircraft, states->tile(), controls->columns(), out.rates.tile().base,
               out.coefficients.tile().base);
  return out;
}

RigidBodyState StateIn(TestTile* tile, int i) {
  RigidBodyState state;
  for (int column = 0; column < kNumRigidBody; ++column) state[column] = tile->at(column, i);
  return state;
}

Controls ControlsIn(TestControls* controls, int i) {
  const auto at = [&](int column) { return static_cast<double>(controls->values.at(column, i)); };
  return {at(0), at(1), at(2), at(3), at(4)};
}

/// Random states in and beyond the flight envelope: every table cell; the F-16 at speeds of 150 to
/// 1500 ft/s, others in proportion to their unit of speed.
class RandomFlight {
 public:
  RandomFlight(const Aircraft& aircraft, unsigned seed)
      : actuators_(aircraft.actuators),
        speed_unit_(aircraft.units.speed_ft_s),
        weight_(aircraft.airframe.mass_slug * kGravityFtS2),
        random_(seed) {}

  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  void Fill(TestTile* tile) {
    for (int i = 0; i < static_cast<int>(tile->stride()); ++i) {
      const double speed = speed_unit_ * Uniform(0.134, 1.345);
      const double alpha = Uniform(-30, 100) * kDegToRad, beta = Uniform(-40, 40) * kDegToRad;
      tile->at(kU, i) = static_cast<float>(speed * std::cos(alpha) * std::cos(beta));
      tile->at(kV, i) = static_cast<float>(speed * std::sin(beta));
      tile->at(kW, i) = static_cast<float>(speed * std::sin(alpha) * std::cos(beta));
      for (const int rate : {kP, kQ, kR}) tile->at(rate, i) = static_cast<float>(Uniform(-2, 2));
      tile->at(kNorth, i) = static_cast<float>(Uniform(-30000, 30000));
      tile->at(kEast, i) = static_cast<float>(Uniform(-30000, 30000));
      tile->at(kDown, i) = static_cast<float>(-Uniform(0, 60000));
      Eigen::Vector4d quaternion;
      for (int k = 0; k < 4; ++k) quaternion[k] = Uniform(-1, 1);
      quaternion.normalize();
      for (int k = 0; k < 4; ++k) tile->at(kQ0 + k, i) = static_cast<float>(quaternion[k]);
    }
  }

  void Fill(TestControls* controls) {
    for (int i = 0; i < static_cast<int>(controls->values.stride()); ++i) {
      const auto set = [&](int c, double value) {
        controls->values.at(c, i) = static_cast<float>(value);
      };
      set(0, weight_ * Uniform(-0.15, 1.4));
      set(1, 1.1 * Deflection(actuators_.elevator));
      set(2, Deflection(actuators_.aileron));
      set(3, Deflection(actuators_.rudder));
      set(4, Deflection(actuators_.leading_edge_flap));
    }
  }

  void FillEngineAndSurfaces(TestTile* tile) {
    for (int i = 0; i < static_cast<int>(tile->stride()); ++i) {
      tile->at(kPower, i) = static_cast<float>(Uniform(0, 100));
      tile->at(kPowerCommand, i) = static_cast<float>(Uniform(0, 100));
      tile->at(kElevator, i) = static_cast<float>(Deflection(actuators_.elevator));
      tile->at(kAileron, i) = static_cast<float>(Deflection(actuators_.aileron));
      tile->at(kRudder, i) = static_cast<float>(Deflection(actuators_.rudder));
      tile->at(kLeadingEdgeFlap, i) = static_cast<float>(Deflection(actuators_.leading_edge_flap));
    }
  }

  /// The columns of the air's velocity: for the F-16 up to 150 ft/s each way. And of its rates.
  void FillWind(TestTile* tile) {
    for (int i = 0; i < static_cast<int>(tile->stride()); ++i) {
      for (const int column : {kWindNorth, kWindEast, kWindDown}) {
        tile->at(column, i) = static_cast<float>(speed_unit_ * Uniform(-0.134, 0.134));
      }
      for (int k = 0; tile->tile().rotational_gusts && k < 3; ++k) {
        tile->at(kGustRollRate + k, i) = static_cast<float>(Uniform(-1, 1));
      }
    }
  }

 private:
  static constexpr double kDegToRad = 0.017453292519943295;

  double Deflection(const Actuator& actuator) {
    return Uniform(actuator.min_deg, actuator.max_deg);
  }

  Actuators actuators_;
  double speed_unit_, weight_;
  std::mt19937 random_;
};

/// Largest error of each quantity, over the larger of its value and kScaleShare of its largest
/// value.
class ErrorTable {
 public:
  static constexpr double kScaleShare = 1e-2;

  void Add(const std::string& quantity, double actual, double expected) {
    records_[quantity].push_back({actual, expected});
  }

  void ExpectWithin(double tolerance) const {
    for (const auto& [quantity, pairs] : records_) {
      double largest = 0, worst = 0;
      for (const auto& pair : pairs) largest = std::max(largest, std::abs(pair[1]));
      for (const auto& pair : pairs) {
        const double scale = std::max(std::abs(pair[1]), kScaleShare * largest);
        worst = Larger(worst, std::abs(pair[0] - pair[1]) / scale);
      }
      EXPECT_LE(worst, tolerance) << quantity;
    }
  }

 private:
  std::map<std::string, std::vector<std::array<double, 2>>> records_;
};

/// The F-16 against an independent implementation.
class PlantKernelGoldenTest : public testing::TestWithParam<simd::Target> {
 protected:
  ScopedTarget target_{GetParam()};
};

/// Every aircraft against the float64 plant.
class PlantKernelTest : public testing::TestWithParam<AircraftOnTarget> {
 protected:
  ScopedTarget target_{GetParam().target};
  Plant plant_{LoadAircraft(GetParam().aircraft), AtmosphereModel::kStevensLewis};
  std::shared_ptr<const KernelAircraft> kernel_ =
      MakeKernelAircraft(plant_.aircraft(), plant_.atmosphere());
};

constexpr Tolerance kFloat32Point{2e-4,
                                  "float32 states, fractions of cells and sums of a dozen terms"};

void CompareWithGolden(const char* list) {
  const Json golden = ReadGolden();
  ErrorTable errors;
  for (const Json& point : golden.at(list)) {
    const Plant plant = PlantOf(point.at("params"));
    const auto kernel = MakeKernelAircraft(plant.aircraft(), plant.atmosphere());
    TestTile states(1, kNumRigidBody);
    TestControls controls(1);
    for (int c = 0; c < kNumRigidBody; ++c) {
      states.Fill(c, point.at("state").at(c).get<float>());
    }
    for (int c = 0; c < kNumControls; ++c) {
      controls.values.Fill(c, point.at("controls").at(c).get<float>());
    }
    TestRates out = Evaluate(*kernel, &states, &controls);
    for (int c = 0; c < kNumRigidBody; ++c) {
      errors.Add("xdot " + std::to_string(c), out.rates.at(c, 0), point.at("xdot").at(c));
    }
    for (int c = 0; c < kNumCoefficients; ++c) {
      errors.Add("coefficient " + std::to_string(c), out.coefficients.at(c, 0),
                 point.at("coeffs").at(c));
    }
  }
  errors.ExpectWithin(kFloat32Point);
}

TEST_P(PlantKernelGoldenTest, GoldenPoints) { CompareWithGolden("points"); }

TEST_P(PlantKernelGoldenTest, GoldenEdgePoints) { CompareWithGolden("edge_points"); }

void CompareWithPlant(const Plant& plant, int count, double tolerance) {
  const auto kernel = MakeKernelAircraft(plant.aircraft(), plant.atmosphere(), plant.gravity());
  RandomFlight random(plant.aircraft(), 7);
  TestTile states(count, kNumRigidBody);
  TestControls controls(count);
  random.Fill(&states);
  random.Fill(&controls);
  TestRates out = Evaluate(*kernel, &states, &controls);
  ErrorTable errors;
  for (int i = 0; i < count; ++i) {
    const PlantOutput exact = plant.Evaluate(StateIn(&states, i), ControlsIn(&controls, i));
    for (int c = 0; c < kNumRigidBody; ++c) {
      errors.Add("rate " + std::to_string(c), out.rates.at(c, i), exact.state_rate[c]);
    }
    for (int c = 0; c < kNumCoefficients; ++c) {
      errors.Add("coefficient " + std::to_string(c), out.coefficients.at(c, i),
                 exact.coefficients[c]);
    }
  }
  errors.ExpectWithin(tolerance);
}

TEST_P(PlantKernelTest, AgreesWithTheFloat64PlantOverRandomStates) {
  CompareWithPlant(plant_, 100000, kFloat32Point);
}

TEST_P(PlantKernelTest, AgreesForOtherMassEngineAndAtmosphere) {
  Aircraft aircraft = plant_.aircraft();
  aircraft.airframe.cg = 0.37;
  aircraft.airframe.engine_angular_momentum = 160.0 / 63100 * aircraft.airframe.Izz;
  aircraft.airframe.mass_slug *= 1.2;
  aircraft.airframe.Ixz *= -2;
  CompareWithPlant(Plant(aircraft, AtmosphereModel::kStandard1976), 20000, kFloat32Point);
}

TEST_P(PlantKernelTest, AgreesInOtherGravity) {
  for (const bool falls : {false, true}) {
    const Gravity gravity{20, falls};
    CompareWithPlant(Plant(plant_.aircraft(), plant_.atmosphere(), 1, gravity), 5000,
                     kFloat32Point);
  }
}

/// The float64 aircraft with engine: rigid body and power.
struct PoweredState {
  RigidBodyState body;
  double power = 0;
};

/// StepTile's specification in double precision. Returns nz and ny of the last stage.
std::pair<double, double> StepPowered(const Plant& plant, Controls surfaces, double power_command,
                                      const Eigen::Vector3d& wind, const Eigen::Vector3d& air_rates,
                                      double dt, PoweredState* state) {
  PlantOutput output;
  const auto rate = [&](const RigidBodyState& body, double power) {
    const AirData air = plant.AirAround(body, wind);
    surfaces.thrust_lbf = Thrust(plant.aircraft().engine, power, -body[kDown], air.mach);
    output = plant.Evaluate(body, surfaces, wind, air_rates);
    return PoweredState{output.state_rate,
                        PowerRate(plant.aircraft().power_lag, power, power_command)};
  };
  const auto at = [&](const PoweredState& k, double step) {
    return rate(state->body + step * k.body, state->power + step * k.power);
  };
  const PoweredState k1 = at({RigidBodyState::Zero(), 0}, 0);
  const PoweredState k2 = at(k1, dt / 2);
  const PoweredState k3 = at(k2, dt / 2);
  const PoweredState k4 = at(k3, dt);
  state->body += dt / 6 * (k1.body + 2 * k2.body + 2 * k3.body + k4.body);
  state->body.segment<4>(kQ0).normalize();
  state->power += dt / 6 * (k1.power + 2 * k2.power + 2 * k3.power + k4.power);
  return {output.nz, output.ny};
}

/// Columns of tiles whose air moves, or moves and turns.
constexpr int kWindyAirs[] = {kNumWindyColumns, kNumRotationalGustColumns};

/// Of random flights of `count` aircraft, in air that does what tiles of `columns` have. `plants`
/// make what `kernel` flies `plant`.
void CompareSteps(const Plant& plant, const KernelAircraft& kernel, int columns,
                  const PlantTile& plants = {}, int count = 20000) {
  constexpr double kDt = 0.02;
  // A stage that crosses military power or a table's kink on one side only adds the most.
  constexpr Tolerance kFloat32Step{2e-5, "float32 states and rates of a step"};
  constexpr Tolerance kLoadFactor{2e-4, "float32 states, fractions of cells and sums"};
  RandomFlight random(plant.aircraft(), 11);
  TestTile tile(count, columns);
  const bool windy = tile.tile().windy;
  random.Fill(&tile);
  random.FillEngineAndSurfaces(&tile);
  if (windy) random.FillWind(&tile);
  TestTile before = tile;
  StepTile(kernel, tile.tile(), static_cast<float>(kDt), 1, {}, plants);
  ErrorTable states, load_factors;
  for (int i = 0; i < count; ++i) {
    PoweredState state{StateIn(&before, i), before.at(kPower, i)};
    Controls surfaces;
    surfaces.elevator_deg = before.at(kElevator, i);
    surfaces.aileron_deg = before.at(kAileron, i);
    surfaces.rudder_deg = before.at(kRudder, i);
    surfaces.leading_edge_flap_deg = before.at(kLeadingEdgeFlap, i);
    Eigen::Vector3d wind = Eigen::Vector3d::Zero(), rates = wind;
    for (int k = 0; windy && k < 3; ++k) wind[k] = before.at(kWindNorth + k, i);
    for (int k = 0; tile.tile().rotational_gusts && k < 3; ++k) {
      rates[k] = before.at(kGustRollRate + k, i);
    }
    const auto [nz, ny] = StepPowered(plant, surfaces, before.at(kPowerCommand, i), wind, rates,
                                      static_cast<float>(kDt), &state);
    for (int c = 0; c < kNumRigidBody; ++c) {
      states.Add("column " + std::to_string(c), tile.at(c, i), state.body[c]);
    }
    states.Add("power", tile.at(kPower, i), state.power);
    const Eigen::Vector3d air =
        state.body.segment<3>(kU) - BodyFromNed(state.body.segment<4>(kQ0)) * wind;
    for (int k = 0; windy && k < 3; ++k) {
      states.Add("air velocity " + std::to_string(k), tile.at(kAirU + k, i), air[k]);
    }
    load_factors.Add("nz", tile.at(kNz, i), nz);
    load_factors.Add("ny", tile.at(kNy, i), ny);
  }
  states.ExpectWithin(kFloat32Step);
  load_factors.ExpectWithin(kLoadFactor);
}

TEST_P(PlantKernelTest, AStepAgreesWithTheFloat64PlantAndEngine) {
  CompareSteps(plant_, *kernel_, kNumColumns);
}

TEST_P(PlantKernelTest, AStepInWindAgreesWithTheFloat64PlantAndEngine) {
  for (const int air : kWindyAirs) CompareSteps(plant_, *kernel_, air);
}

TEST_P(PlantKernelTest, AStepWithEffectsOfTheMachNumberAgreesWithTheFloat64PlantAndEngine) {
  Aircraft aircraft = plant_.aircraft();
  aircraft.drag_rises = !aircraft.drag_rise.mach.empty();
  aircraft.engine.grows = !aircraft.engine.growth.mach.empty();
  if (!aircraft.drag_rises && !aircraft.engine.grows) GTEST_SKIP() << "it has no such data";
  const Plant plant(aircraft, AtmosphereModel::kStevensLewis);
  CompareSteps(plant, *MakeKernelAircraft(aircraft, plant.atmosphere()), kNumColumns);
}

TEST_P(PlantKernelTest, AStepOfADrawnPlantAgreesWithTheFloat64Plant) {
  constexpr int kCount = 2000, kPlants = 4;
  PlantConfig ranges;
  for (Range* factor :
       {&ranges.mass, &ranges.inertia, &ranges.axial_force, &ranges.normal_force,
        &ranges.pitching_moment, &ranges.lateral, &ranges.control, &ranges.weak_surface,
        &ranges.damping, &ranges.thrust, &ranges.thrust_lag, &ranges.density}) {
    *factor = {0.6, 1.5};
  }
  ranges.cg_shift = {-0.1, 0.1};
  const double momentum = 300.0 / 63100 * plant_.aircraft().airframe.Izz;
  ranges.engine_momentum = {-momentum, momentum};
  for (int k = 0; k < kPlants; ++k) {
    simd::RandomStream random(
        {3, static_cast<std::uint32_t>(k), 0, 0, simd::RandomPurpose::kPlant});
    const PlantDraw draw = DrawPlant(ranges, &random);
    TestTile columns(kCount, kNumPlantColumns);
    const PlantTile plants{columns.tile()};
    SetPlant(draw, plant_.aircraft(), 0.02, plants, 0);
    for (int column = 0; column < kNumPlantColumns; ++column) {
      columns.Fill(column, columns.at(column, 0));
    }
    const Plant drawn(DrawnAircraft(plant_.aircraft(), draw), plant_.atmosphere(), draw.density);
    CompareSteps(drawn, *kernel_, kNumColumns, plants, kCount);
    for (const int air : kWindyAirs) CompareSteps(drawn, *kernel_, air, plants, kCount);
  }
}

// Both are code of their own, but a velocity less nothing is the same velocity.
TEST_P(PlantKernelTest, AWindOfZeroIsStillAir) {
  constexpr int kCount = 1000;
  RandomFlight random(plant_.aircraft(), 31);
  TestTile still(kCount);
  random.Fill(&still);
  random.FillEngineAndSurfaces(&still);
  TestTile windy(kCount, kNumWindyColumns);
  for (int column = 0; column < kNumColumns; ++column) {
    std::copy_n(still.tile()[column], still.stride(), windy.tile()[column]);
  }
  StepTile(*kernel_, still.tile(), 0.02f, 1);
  StepTile(*kernel_, windy.tile(), 0.02f, 1);
  for (int column = 0; column < kNumColumns; ++column) {
    for (int i = 0; i < kCount; ++i) ASSERT_EQ(windy.at(column, i), still.at(column, i)) << column;
  }
}

TEST_P(PlantKernelGoldenTest, GoldenTrajectories) {
  constexpr Tolerance kTrajectory{2e-3, "float32 rounding of ten seconds at 50 Hz"};
  const Json golden = ReadGolden();
  ASSERT_FALSE(golden.at("trajectories").empty());
  for (const Json& trajectory : golden.at("trajectories")) {
    SCOPED_TRACE(trajectory.at("name").get<std::string>());
    const Plant plant = PlantOf(trajectory.at("params"));
    const auto kernel = MakeKernelAircraft(plant.aircraft(), plant.atmosphere());
    TestTile states(1, kNumRigidBody);
    TestControls controls(1);
    for (int c = 0; c < kNumRigidBody; ++c) {
      states.Fill(c, trajectory.at("initial_state").at(c).get<float>());
    }
    const Json& expected = trajectory.at("states_dt0_02");
    ErrorTable errors;
    constexpr int kStepsPerSample = 5;
    for (int step = 0; step < kStepsPerSample * (static_cast<int>(expected.size()) - 1); ++step) {
      const double time = 0.02 * (step + 1e-6);
      for (int c = 0; c < kNumControls; ++c) {
        double value = trajectory.at("trim_controls").at(c);
        for (const Json& pulse : trajectory.at("pulses")) {
          if (pulse.at("control_index") == c && pulse.at("t_start") <= time &&
              time < pulse.at("t_end")) {
            value += pulse.at("delta").get<double>();
          }
        }
        controls.values.Fill(c, static_cast<float>(value));
      }
      StepTileOpenLoop(*kernel, states.tile(), controls.columns(), 0.02f, 1);
      if ((step + 1) % kStepsPerSample != 0) continue;
      for (int c = 0; c < kNumRigidBody; ++c) {
        errors.Add("column " + std::to_string(c), states.at(c, 0),
                   expected.at((step + 1) / kStepsPerSample).at(c));
      }
    }
    errors.ExpectWithin(kTrajectory);
  }
}

TEST_P(PlantKernelTest, AnAircraftDoesNotDependOnItsTile) {
  constexpr int kCount = 300;
  RandomFlight random(plant_.aircraft(), 13);
  TestTile together(kCount);
  random.Fill(&together);
  random.FillEngineAndSurfaces(&together);
  TestTile before = together;
  for (int step = 0; step < 5; ++step) StepTile(*kernel_, together.tile(), 0.02f, 2);
  for (const int size : {1, 17, 32, 77}) {
    for (int first = 0; first < kCount; first += size) {
      const int count = std::min(size, kCount - first);
      TestTile part(count);
      for (int c = 0; c < kNumColumns; ++c) {
        part.Fill(c, before.at(c, first));  // the padding flies too
        for (int i = 0; i < count; ++i) part.at(c, i) = before.at(c, first + i);
      }
      for (int step = 0; step < 5; ++step) StepTile(*kernel_, part.tile(), 0.02f, 2);
      for (int c = 0; c < kNumColumns; ++c) {
        for (int i = 0; i < count; ++i) {
          ASSERT_EQ(part.at(c, i), together.at(c, first + i)) << size << ", column " << c;
        }
      }
    }
  }
}

TEST_P(PlantKernelTest, SubstepsAreShorterSteps) {
  constexpr int kCount = 100;
  RandomFlight random(plant_.aircraft(), 17);
  TestTile once(kCount);
  random.Fill(&once);
  random.FillEngineAndSurfaces(&once);
  TestTile twice = once;
  StepTile(*kernel_, once.tile(), 0.02f, 2);
  StepTile(*kernel_, twice.tile(), 0.01f, 1);
  StepTile(*kernel_, twice.tile(), 0.01f, 1);
  EXPECT_TRUE(once == twice);
}

TEST_P(PlantKernelTest, NonFiniteAircraftLeaveTheOthersAlone) {
  constexpr int kCount = 64;
  const float poisons[] = {std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity(),
                           -std::numeric_limits<float>::infinity(), 1e30f, -1e30f};
  RandomFlight random(plant_.aircraft(), 19);
  TestTile start(kCount);
  random.Fill(&start);
  random.FillEngineAndSurfaces(&start);
  TestTile clean = start;
  StepTile(*kernel_, clean.tile(), 0.02f, 1);
  constexpr int kPoisoned = 21;
  for (int column = 0; column <= kLeadingEdgeFlap; ++column) {
    for (const float poison : poisons) {
      TestTile tile = start;
      tile.at(column, kPoisoned) = poison;
      StepTile(*kernel_, tile.tile(), 0.02f, 1);
      for (int c = 0; c < kNumColumns; ++c) {
        for (int i = 0; i < kCount; ++i) {
          if (i == kPoisoned) continue;
          ASSERT_EQ(tile.at(c, i), clean.at(c, i)) << column << ": " << poison;
        }
      }
    }
  }
}

TEST_P(PlantKernelTest, ANaNInTheStateStaysVisible) {
  RandomFlight random(plant_.aircraft(), 23);
  TestTile start(32);
  random.Fill(&start);
  random.FillEngineAndSurfaces(&start);
  for (int column = 0; column <= kPower; ++column) {
    TestTile tile = start;
    tile.at(column, 3) = std::numeric_limits<float>::quiet_NaN();
    StepTile(*kernel_, tile.tile(), 0.02f, 1);
    EXPECT_TRUE(std::isnan(tile.at(column, 3))) << column;
  }
}

TEST_P(PlantKernelTest, QuaternionsStayNormal) {
  constexpr Tolerance kFloat32{1e-6, "float32 rounding"};
  constexpr int kCount = 256;
  RandomFlight random(plant_.aircraft(), 29);
  TestTile tile(kCount);
  random.Fill(&tile);
  random.FillEngineAndSurfaces(&tile);
  for (int step = 0; step < 100; ++step) StepTile(*kernel_, tile.tile(), 0.02f, 1);
  for (int i = 0; i < kCount; ++i) {
    double square = 0;
    for (int k = kQ0; k <= kQz; ++k) square += std::pow(static_cast<double>(tile.at(k, i)), 2);
    EXPECT_NEAR(square, 1, kFloat32);
  }
}

// Above 137,000 ft the kernels hold the density at 2e-9 slug/ft^3; slow, a body is in free fall
// there: dynamic pressure 2e-6 psf.
TEST_P(PlantKernelTest, EnergyAndAngularMomentumAreKeptInVacuum) {
  constexpr int kSteps = 250;
  constexpr Tolerance kRelative{1e-5, "1000 roundings of 6e-8, mostly cancelling"};
  // Altitude rounds by up to 0.008 ft at each of 250 steps, a random walk of 0.07 ft: 2.3 ft^2/s^2.
  constexpr Tolerance kAltitudeWalk{5, "float32 rounding of the altitude, ft^2/s^2"};
  TestTile states(1, kNumRigidBody);
  TestControls controls(1);
  RigidBodyState start;
  start << 40, 3, -10, 0.8, 0.3, -0.5, 0, 0, -145000, 0.5, -0.5, 0.5, 0.5;
  for (int c = 0; c < kNumRigidBody; ++c) states.Fill(c, static_cast<float>(start[c]));
  for (int c = 0; c < kNumControls; ++c) controls.values.Fill(c, 0);
  const Airframe& a = plant_.aircraft().airframe;
  const auto energy = [&](const RigidBodyState& s) {
    return 0.5 * s.segment<3>(kU).squaredNorm() - kGravityFtS2 * (s[kDown] - start[kDown]);
  };
  const auto momentum = [&](const RigidBodyState& s) {
    return Eigen::Vector3d(a.Ixx * s[kP] - a.Ixz * s[kR], a.Iyy * s[kQ],
                           a.Izz * s[kR] - a.Ixz * s[kP])
        .norm();
  };
  const auto rotation = [&](const RigidBodyState& s) {
    return 0.5 * (a.Ixx * s[kP] * s[kP] + a.Iyy * s[kQ] * s[kQ] + a.Izz * s[kR] * s[kR]) -
           a.Ixz * s[kP] * s[kR];
  };
  for (int step = 0; step < kSteps; ++step) {
    StepTileOpenLoop(*kernel_, states.tile(), controls.columns(), 0.02f, 1);
  }
  const RigidBodyState end = StateIn(&states, 0);
  // What the air that is left does to a light aircraft: its moments, of coefficients up to 0.1,
  // over the time of the flight, beside angular rates of about 1 rad/s.
  const double pressure = 0.5 * 2e-9 * start.segment<3>(kU).squaredNorm();
  const double push = kSteps * 0.02 * pressure * a.wing_area_ft2 * a.span_ft * 0.1 / a.Ixx;
  EXPECT_NEAR(energy(end), energy(start), kAltitudeWalk);
  EXPECT_NEAR(momentum(end) / momentum(start), 1, kRelative + push);
  // Energy goes with the square of the rates.
  EXPECT_NEAR(rotation(end) / rotation(start), 1, kRelative + 2 * push);
}

INSTANTIATE_TEST_SUITE_P(EveryTarget, PlantKernelGoldenTest,
                         testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return simd::Name(test.param); });
INSTANTIATE_TEST_SUITE_P(EveryAircraft, PlantKernelTest,
                         testing::ValuesIn(EveryAircraftOnEveryTarget()), AircraftOnTargetName);

}  // namespace
}  // namespace skein
