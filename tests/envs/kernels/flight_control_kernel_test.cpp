// SPDX-License-Identifier: Apache-2.0
#include "envs/kernels/flight_control_kernel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "envs/aircraft/engine.h"
#include "envs/aircraft/registry.h"
#include "envs/reference/actuator.h"
#include "envs/state/attitude.h"
#include "simd/random.h"
#include "tests/envs/every_aircraft.h"
#include "tests/envs/test_tile.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr double kInterval = 0.02;
constexpr AtmosphereModel kAtmosphere = AtmosphereModel::kStevensLewis;

// Of a column's scale.
constexpr Tolerance kStep{3e-6, "a few float32 roundings"};
constexpr Tolerance kSequence{2e-4, "float32 roundings that the integrators add up"};

/// What errors of a column are measured against: the largest values that occur in it.
double Scale(int column) {
  switch (column) {
    case kPowerCommand:
    case kRollRateFilter:
    case kRollCommandFilter:
      return 300;
    case kPitchRateFilter:
    case kPitchRateWashout:
    case kYawRateFilter:
    case kYawWashout:
    case kYawLeadFilter:
    case kPitchLeadFilter:
      return 100;
    default:
      return 30;
  }
}

struct Commands {
  std::vector<float> throttle, pitch, roll, yaw;

  explicit Commands(int count)
      : throttle(TileStride(count)), pitch(throttle), roll(throttle), yaw(throttle) {}

  PilotColumns columns() const { return {throttle.data(), pitch.data(), roll.data(), yaw.data()}; }
  void Draw(int i, simd::RandomStream* random) {
    const auto index = static_cast<std::size_t>(i);
    throttle[index] = static_cast<float>(random->Uniform());
    for (std::vector<float>* stick : {&pitch, &roll, &yaw}) {
      (*stick)[index] = static_cast<float>(random->Uniform(-1, 1));
    }
  }
  PilotCommands of(int i) const {
    const auto index = static_cast<std::size_t>(i);
    return {throttle[index], pitch[index], roll[index], yaw[index]};
  }
};

/// A random flight condition: air-relative velocity, rates, altitude and accelerations.
/// `speed_unit_ft_s` is that of the aircraft.
void DrawFlight(double speed_unit_ft_s, TestTile* tile, int i, simd::RandomStream* random) {
  const double speed = speed_unit_ft_s * random->Uniform(0.22, 1.6);
  const double alpha = random->Uniform(-15, 40) / kDegPerRad;
  const double beta = random->Uniform(-15, 15) / kDegPerRad;
  tile->at(kU, i) = static_cast<float>(speed * std::cos(alpha) * std::cos(beta));
  tile->at(kV, i) = static_cast<float>(speed * std::sin(beta));
  tile->at(kW, i) = static_cast<float>(speed * std::sin(alpha) * std::cos(beta));
  for (const int rate : {kP, kQ, kR}) {
    tile->at(rate, i) = static_cast<float>(random->Uniform(-1, 1));
  }
  tile->at(kDown, i) = static_cast<float>(-random->Uniform(1000, 45000));
  tile->at(kNz, i) = static_cast<float>(random->Uniform(-3, 8));
  tile->at(kNy, i) = static_cast<float>(random->Uniform(-1, 1));
}

FlightSensors SensorsOf(TestTile* tile, int i) {
  const double u = tile->at(kU, i), v = tile->at(kV, i), w = tile->at(kW, i);
  const Air air = AirAt(kAtmosphere, -static_cast<double>(tile->at(kDown, i)));
  FlightSensors sensors;
  sensors.alpha_deg = std::atan2(w, u) * kDegPerRad;
  sensors.roll_rate_deg_s = tile->at(kP, i) * kDegPerRad;
  sensors.pitch_rate_deg_s = tile->at(kQ, i) * kDegPerRad;
  sensors.yaw_rate_deg_s = tile->at(kR, i) * kDegPerRad;
  sensors.nz = tile->at(kNz, i);
  sensors.ny = tile->at(kNy, i);
  sensors.dynamic_pressure_psf = 0.5 * air.density_slug_ft3 * (u * u + v * v + w * w);
  sensors.static_pressure_psf = air.pressure_lbf_ft2;
  return sensors;
}

/// The double-precision columns that a control step changes.
struct Specification {
  FlightControlState filters{};
  std::array<double, 4> surfaces{};
  double power_command = 0;

  void Step(const Aircraft& aircraft, const FlightControl& flight_control,
            const PilotCommands& pilot, const FlightSensors& sensors) {
    const SurfaceAngles command = flight_control.Step(pilot, sensors, &filters);
    const Actuators& actuators = aircraft.actuators;
    surfaces = {StepActuator(actuators.elevator, surfaces[0], command.elevator_deg, kInterval),
                StepActuator(actuators.aileron, surfaces[1], command.aileron_deg, kInterval),
                StepActuator(actuators.rudder, surfaces[2], command.rudder_deg, kInterval),
                StepActuator(actuators.leading_edge_flap, surfaces[3],
                             command.leading_edge_flap_deg, kInterval)};
    power_command = PowerCommand(aircraft.throttle_gearing, pilot.throttle);
  }
  double of(int column) const {
    if (column == kPowerCommand) return power_command;
    if (column >= kAlphaFilter) return filters[static_cast<std::size_t>(column - kAlphaFilter)];
    return surfaces[static_cast<std::size_t>(column - kElevator)];
  }
};

std::vector<int> ControlledColumns() {
  std::vector<int> columns = {kPowerCommand, kElevator, kAileron, kRudder, kLeadingEdgeFlap};
  for (int column = kAlphaFilter; column < kNumColumns; ++column) columns.push_back(column);
  return columns;
}

class FlightControlKernelTest : public testing::TestWithParam<AircraftOnTarget> {
 protected:
  ScopedTarget target_{GetParam().target};
  Aircraft aircraft_ = LoadAircraft(GetParam().aircraft);
  double speed_unit_ = aircraft_.units.speed_ft_s;
  std::shared_ptr<const KernelAircraft> kernel_ = MakeKernelAircraft(aircraft_, kAtmosphere);
};

TEST_P(FlightControlKernelTest, OneStepAgreesWithTheSpecification) {
  constexpr int kCount = 5000;
  for (const FlightControlMode mode : {FlightControlMode::kFull, FlightControlMode::kDirect}) {
    const FlightControl flight_control(aircraft_, mode, kInterval);
    TestTile tile(kCount);
    Commands commands(kCount);
    std::vector<Specification> expected(kCount);
    for (int i = 0; i < kCount; ++i) {
      simd::RandomStream random(
          {1, static_cast<std::uint32_t>(i), 0, 0, simd::RandomPurpose::kInitialState});
      DrawFlight(speed_unit_, &tile, i, &random);
      commands.Draw(i, &random);
      // Filters at rest in one flight condition, then flown in another.
      TestTile other(1);
      DrawFlight(speed_unit_, &other, 0, &random);
      const SurfaceAngles surfaces{random.Uniform(-25, 25), random.Uniform(-21, 21),
                                   random.Uniform(-30, 30), random.Uniform(0, 25)};
      Specification& specification = expected[static_cast<std::size_t>(i)];
      const FlightControlState filters =
          flight_control.InitialState(SensorsOf(&other, 0), surfaces);
      for (int k = 0; k < kNumFlightControlStates; ++k) {
        tile.at(kAlphaFilter + k, i) = static_cast<float>(filters[static_cast<std::size_t>(k)]);
        specification.filters[static_cast<std::size_t>(k)] = tile.at(kAlphaFilter + k, i);
      }
      tile.at(kElevator, i) = static_cast<float>(surfaces.elevator_deg);
      tile.at(kAileron, i) = static_cast<float>(surfaces.aileron_deg);
      tile.at(kRudder, i) = static_cast<float>(surfaces.rudder_deg);
      tile.at(kLeadingEdgeFlap, i) = static_cast<float>(surfaces.leading_edge_flap_deg);
      for (int k = 0; k < 4; ++k) {
        specification.surfaces[static_cast<std::size_t>(k)] = tile.at(kElevator + k, i);
      }
      specification.Step(aircraft_, flight_control, commands.of(i), SensorsOf(&tile, i));
    }
    ControlTile(*kernel_, tile.tile(), commands.columns(), mode, kInterval);
    for (int i = 0; i < kCount; ++i) {
      for (const int column : ControlledColumns()) {
        ASSERT_NEAR(tile.at(column, i), expected[static_cast<std::size_t>(i)].of(column),
                    kStep * Scale(column))
            << "aircraft " << i << ", column " << column;
      }
    }
  }
}

TEST_P(FlightControlKernelTest, StaysWithTheSpecificationOverAFlight) {
  constexpr int kCount = 48, kSteps = 500;
  const FlightControl flight_control(aircraft_, FlightControlMode::kFull, kInterval);
  TestTile tile(kCount);
  Commands commands(kCount);
  std::vector<Specification> expected(kCount);
  std::vector<simd::RandomStream> random;
  for (int i = 0; i < kCount; ++i) {
    random.emplace_back(simd::RandomKey{2, static_cast<std::uint32_t>(i), 0, 0,
                                        simd::RandomPurpose::kInitialState});
    tile.at(kElevator, i) = -2;
    DrawFlight(speed_unit_, &tile, i, &random.back());
    Specification& specification = expected[static_cast<std::size_t>(i)];
    specification.filters = flight_control.InitialState(SensorsOf(&tile, i), {-2, 0, 0, 0});
    specification.surfaces = {-2, 0, 0, 0};
    for (int k = 0; k < kNumFlightControlStates; ++k) {
      tile.at(kAlphaFilter + k, i) =
          static_cast<float>(specification.filters[static_cast<std::size_t>(k)]);
    }
  }
  for (int step = 0; step < kSteps; ++step) {
    for (int i = 0; i < kCount; ++i) {
      simd::RandomStream& stream = random[static_cast<std::size_t>(i)];
      // New sensor readings and sticks now and then; each aircraft at its own time.
      if ((step + i) % 7 == 0) DrawFlight(speed_unit_, &tile, i, &stream);
      if ((step + i) % 25 == 0) commands.Draw(i, &stream);
      expected[static_cast<std::size_t>(i)].Step(aircraft_, flight_control, commands.of(i),
                                                 SensorsOf(&tile, i));
    }
    ControlTile(*kernel_, tile.tile(), commands.columns(), FlightControlMode::kFull, kInterval);
    for (int i = 0; i < kCount; ++i) {
      for (const int column : ControlledColumns()) {
        ASSERT_NEAR(tile.at(column, i), expected[static_cast<std::size_t>(i)].of(column),
                    kSequence * Scale(column))
            << "step " << step << ", aircraft " << i << ", column " << column;
      }
    }
  }
}

TEST_P(FlightControlKernelTest, ResultsDoNotDependOnTheLane) {
  constexpr int kCount = 61;
  TestTile tile(kCount), shifted(kCount);
  Commands commands(kCount), shifted_commands(kCount);
  for (int i = 0; i < kCount; ++i) {
    const int j = (i + 23) % kCount;
    for (const auto& [target, command, index] :
         {std::tuple{&tile, &commands, i}, std::tuple{&shifted, &shifted_commands, j}}) {
      simd::RandomStream random(
          {3, static_cast<std::uint32_t>(i), 0, 0, simd::RandomPurpose::kInitialState});
      DrawFlight(speed_unit_, target, index, &random);
      command->Draw(index, &random);
    }
  }
  for (int step = 0; step < 20; ++step) {
    ControlTile(*kernel_, tile.tile(), commands.columns(), FlightControlMode::kFull, kInterval);
    ControlTile(*kernel_, shifted.tile(), shifted_commands.columns(), FlightControlMode::kFull,
                kInterval);
  }
  for (int i = 0; i < kCount; ++i) {
    for (const int column : ControlledColumns()) {
      ASSERT_EQ(tile.at(column, i), shifted.at(column, (i + 23) % kCount));
    }
  }
}

TEST_P(FlightControlKernelTest, SticksAndThrottleAreLimited) {
  TestTile tile(2);
  Commands commands(2);
  for (int i = 0; i < 2; ++i) {
    tile.at(kU, i) = 600;
    tile.at(kDown, i) = -10000;
    commands.throttle[static_cast<std::size_t>(i)] = i == 0 ? 1 : 7;
    commands.pitch[static_cast<std::size_t>(i)] = i == 0 ? 1 : 5;
    commands.roll[static_cast<std::size_t>(i)] = i == 0 ? -1 : -3;
    commands.yaw[static_cast<std::size_t>(i)] = i == 0 ? 1 : 1e9f;
  }
  ControlTile(*kernel_, tile.tile(), commands.columns(), FlightControlMode::kFull, kInterval);
  for (const int column : ControlledColumns()) EXPECT_EQ(tile.at(column, 0), tile.at(column, 1));
  EXPECT_FLOAT_EQ(tile.at(kPowerCommand, 0), 100);
}

INSTANTIATE_TEST_SUITE_P(Targets, FlightControlKernelTest,
                         testing::ValuesIn(EveryAircraftOnEveryTarget()), AircraftOnTargetName);

}  // namespace
}  // namespace skein
