// SPDX-License-Identifier: Apache-2.0
// Each randomised quantity of the aircraft and its air acts as it is called, in flights of the
// environment.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "envs/aircraft/engine.h"
#include "envs/aircraft/f16.h"
#include "envs/reference/closed_loop.h"
#include "envs/vec_env.h"
#include "tests/envs/plant/drawn_aircraft.h"
#include "tests/envs/plant/one_flight.h"
#include "tests/envs/step_buffers.h"
#include "tests/tolerance.h"

namespace skein::one_flight {
namespace {

/// Rates of change over one short control step with the sticks at `action`, and nz and ny.
struct Response {
  std::array<double, kNumColumns> rate{}, end{};
};

constexpr double kShort = 1e-3;  // s

Response Respond(EnvConfig config, const Action& action = {0, 0, 0, 0}, std::uint64_t seed = 1) {
  config.control_interval_s = kShort;
  VecEnv env(config, 1, seed);
  std::array<double, kNumColumns> start{};
  for (int c = 0; c < kNumColumns; ++c) start[static_cast<std::size_t>(c)] = env.StateOf(0, c);
  StepBuffers buffers(1);
  std::copy(action.begin(), action.end(), buffers.action.begin());
  env.Step(0, buffers.action.data(), buffers.output());
  Response response;
  for (std::size_t c = 0; c < kNumColumns; ++c) {
    response.end[c] = env.StateOf(0, static_cast<int>(c));
    response.rate[c] = (response.end[c] - start[c]) / kShort;
  }
  return response;
}

EnvConfig With(Range PlantConfig::*quantity, double value) {
  EnvConfig config = OneDrawnFlight();
  config.plant.*quantity = {value, value};
  return config;
}

constexpr Tolerance kRelative{2e-3, "a short step: the state moves on; float32"};

TEST(DrawnFlight, EveryAircraftAndEpisodeHasItsOwnPlant) {
  EnvConfig config = OneFlight();
  config.plant.mass = {0.5, 1.5};
  config.time_limit_steps = config.heading.earliest_success_step = 1;
  VecEnv env(config, 2, 1);
  const auto masses = [&env] {
    const std::vector<std::string> names = env.privileged_names();
    const auto mass = std::find(names.begin(), names.end(), "plant_inverse_mass") - names.begin();
    std::vector<float> rows(2 * names.size());
    env.ObservePrivileged(0, rows.data());
    return std::array<float, 2>{rows[static_cast<std::size_t>(mass)],
                                rows[names.size() + static_cast<std::size_t>(mass)]};
  };
  const auto first = masses();
  StepBuffers buffers(2);
  env.Step(0, buffers.action.data(), buffers.output());
  const auto second = masses();
  EXPECT_NE(first[0], first[1]);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NE(first[i], second[i]);
}

TEST(DrawnFlight, MassDividesTheSpecificForce) {
  const Response nominal = Respond(OneFlight());
  const Response heavy = Respond(With(&PlantConfig::mass, 2));
  EXPECT_NEAR(heavy.end[kNz], nominal.end[kNz] / 2, kRelative);
}

TEST(DrawnFlight, ACgFurtherAftPitchesUpByTheForcesThere) {
  const Airframe airframe = F16().airframe;
  constexpr double kShift = 0.04;
  const Response nominal = Respond(OneFlight());
  const Response aft = Respond(With(&PlantConfig::cg_shift, kShift));
  // The lift m g nz pulls at a lever of kShift chords more.
  const double lift = airframe.mass_slug * kGravityFtS2 * nominal.end[kNz];
  const double expected = lift * kShift * airframe.chord_ft / airframe.Iyy;
  EXPECT_NEAR(aft.rate[kQ] - nominal.rate[kQ], expected, 0.01 * expected);
  EXPECT_NEAR(aft.end[kNz], nominal.end[kNz], kRelative);
}

/// What the stick does to the rates beyond hands-off flight.
double RollAcceleration(const EnvConfig& config) {
  const Action roll = {0, 0, 1, 0};
  return Respond(config, roll).rate[kP] - Respond(config).rate[kP];
}

TEST(DrawnFlight, InertiaDividesAngularAccelerations) {
  const double nominal = RollAcceleration(OneFlight());
  EXPECT_NEAR(RollAcceleration(With(&PlantConfig::inertia, 2)), nominal / 2, 0.01 * nominal);
}

/// Changes of the accelerations u', v', w', p', q', r' by a factor of 1.5, from 1.
std::array<double, 6> ChangeOfAccelerations(Range PlantConfig::*quantity) {
  const Response nominal = Respond(OneFlight()), changed = Respond(With(quantity, 1.5));
  std::array<double, 6> change{};
  for (std::size_t c = 0; c < 6; ++c) change[c] = changed.rate[c] - nominal.rate[c];
  return change;
}

constexpr Tolerance kNoAcceleration{0.15, "float32 of 900 ft/s over a millisecond"};
constexpr Tolerance kNoRotation{2e-3, "a short step: the flight control answers"};

TEST(DrawnFlight, AxialForceActsAlongX) {
  const auto change = ChangeOfAccelerations(&PlantConfig::axial_force);
  EXPECT_LT(change[0], -1);  // it is drag
  for (const std::size_t c : {1u, 2u}) EXPECT_NEAR(change[c], 0, kNoAcceleration) << c;
  for (const std::size_t c : {3u, 4u, 5u}) EXPECT_NEAR(change[c], 0, kNoRotation) << c;
}

TEST(DrawnFlight, NormalForceMultipliesTheLoadFactor) {
  const Response nominal = Respond(OneFlight());
  const Response more = Respond(With(&PlantConfig::normal_force, 1.5));
  EXPECT_NEAR(more.end[kNz], 1.5 * nominal.end[kNz], kRelative);
  EXPECT_NEAR(more.rate[kU], nominal.rate[kU], kNoAcceleration);
}

TEST(DrawnFlight, PitchingMomentPitchesAlone) {
  const auto change = ChangeOfAccelerations(&PlantConfig::pitching_moment);
  EXPECT_GT(std::abs(change[4]), 10 * kNoRotation);
  for (const std::size_t c : {0u, 1u, 2u}) EXPECT_NEAR(change[c], 0, kNoAcceleration) << c;
  for (const std::size_t c : {3u, 5u}) EXPECT_NEAR(change[c], 0, kNoRotation) << c;
}

TEST(DrawnFlight, LateralMultipliesSideForceAndLeavesThePlaneOfSymmetry) {
  EnvConfig slipping = OneFlight();
  slipping.wind.speed_fps = {60, 60};
  slipping.wind.from_deg = {90, 90};
  EnvConfig more = slipping;
  more.plant.lateral = {1.5, 1.5};
  const Response nominal = Respond(slipping), changed = Respond(more);
  EXPECT_NEAR(changed.end[kNy], 1.5 * nominal.end[kNy], kRelative);
  EXPECT_NEAR(changed.rate[kQ], nominal.rate[kQ], kNoRotation);
  EXPECT_NEAR(changed.end[kNz], nominal.end[kNz], kRelative);
}

/// By the direct law, surfaces centred: a stick of 0.1 is a deflection, half the effect half of it.
EnvConfig OneDirectFlight() {
  EnvConfig config = OneFlight();
  config.flight_control = FlightControlMode::kDirect;
  config.initial.trimmed = false;
  return config;
}

TEST(DrawnFlight, TheWeakSurfaceIsTheOneThatIsDrawn) {
  const EnvConfig config = OneDirectFlight();
  EnvConfig drawn = config;
  drawn.plant.weak_surface = {0.5, 0.5};
  const std::size_t rates[] = {kQ, kP, kR};  // by elevator, aileron and rudder
  std::array<int, 3> weak{};
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    simd::RandomStream random({seed, 0, 0, 0, simd::RandomPurpose::kPlant});
    const PlantDraw draw = DrawPlant(drawn.plant, &random);
    const double effects[] = {draw.elevator, draw.aileron, draw.rudder};
    for (std::size_t surface = 0; surface < 3; ++surface) {
      weak[surface] += effects[surface] < 1;
      Action stick{}, nominal_stick{};
      stick[surface + 1] = 0.1f;
      nominal_stick[surface + 1] = static_cast<float>(0.1 * effects[surface]);
      const double expected = Respond(config, nominal_stick).rate[rates[surface]];
      const double effect = expected - Respond(config).rate[rates[surface]];
      EXPECT_NEAR(Respond(drawn, stick, seed).rate[rates[surface]], expected,
                  0.02 * std::abs(effect))
          << seed << ", " << surface;
    }
  }
  for (const int count : weak) EXPECT_GT(count, 0);
}

TEST(DrawnFlight, ASurfaceAtHalfEffectIsOneDeflectedHalf) {
  const EnvConfig config = OneDirectFlight();
  EnvConfig weak = config;
  weak.plant.control = {0.5, 0.5};
  const Response half = Respond(config, {0, 0.05f, 0.05f, 0.05f});
  const Response halved = Respond(weak, {0, 0.1f, 0.1f, 0.1f});
  const Response none = Respond(config);
  for (const int c : {kP, kQ, kR}) {
    const auto column = static_cast<std::size_t>(c);
    const double effect = half.rate[column] - none.rate[column];
    EXPECT_GT(std::abs(effect), 0.002) << c;
    EXPECT_NEAR(halved.rate[column], half.rate[column], 0.02 * std::abs(effect)) << c;
  }
}

TEST(DrawnFlight, DampingActsByTheRates) {
  const auto at_rest = ChangeOfAccelerations(&PlantConfig::damping);
  for (const std::size_t c : {3u, 4u, 5u}) EXPECT_NEAR(at_rest[c], 0, kNoRotation) << c;
  // Rolling for half a second with the same stick, the better damped aircraft is slower.
  EnvConfig direct = OneFlight();
  direct.flight_control = FlightControlMode::kDirect;
  EnvConfig damped = direct;
  damped.plant.damping = {2, 2};
  const auto roll_rate = [](const EnvConfig& config) {
    const auto roll = [](int) { return Action{0, 0, 0.2f, 0}; };
    return Fly(config, roll, 25)[24 * kNumColumns + kP];
  };
  EXPECT_LT(roll_rate(damped), 0.7 * roll_rate(direct));
  EXPECT_GT(roll_rate(damped), 0.4 * roll_rate(direct));
}

TEST(DrawnFlight, ThrustAcceleratesForward) {
  const Aircraft f16 = F16();
  const double mach = 900 / AirAt(OneFlight().atmosphere, 20000).sound_speed_ft_s;
  const Response nominal = Respond(OneFlight());
  const double thrust = Thrust(f16.engine, nominal.end[kPower], 20000, mach);
  const double change = Respond(With(&PlantConfig::thrust, 1.5)).rate[kU] - nominal.rate[kU];
  EXPECT_NEAR(change, 0.5 * thrust / f16.airframe.mass_slug, kNoAcceleration);
}

TEST(DrawnFlight, ThrustLagIsTimeOfThePower) {
  const Action full = {1, 0, 0, 0};
  const double nominal = Respond(OneFlight(), full).rate[kPower];
  EXPECT_NEAR(Respond(With(&PlantConfig::thrust_lag, 2), full).rate[kPower], nominal / 2,
              0.01 * nominal);
}

TEST(DrawnFlight, EngineMomentumPitchesAYawingAircraftByItsInertia) {
  // q' = -h r / Iyy, without flight control that answers.
  constexpr double kMomentum = 20000;
  constexpr int kSteps = 6;
  const auto fly = [](double momentum, double inertia) {
    EnvConfig config = With(&PlantConfig::engine_momentum, momentum);
    config.plant.inertia = {inertia, inertia};
    config.flight_control = FlightControlMode::kDirect;
    return Fly(
        config,
        [](int) {
          return Action{0, 0, 0, 0.5f};
        },
        kSteps);
  };
  for (const double inertia : {1.0, 2.0}) {
    const auto usual = fly(0, inertia), turning = fly(kMomentum, inertia);
    double angle = 0;  // yawed before the last step, and half of what it adds
    for (int step = 0; step < kSteps; ++step) {
      const double r = usual[static_cast<std::size_t>(step * kNumColumns + kR)];
      angle += (step + 1 < kSteps ? 1 : 0.5) * r * kInterval;
    }
    const double expected = -kMomentum * angle / (inertia * F16().airframe.Iyy);
    const auto last = static_cast<std::size_t>((kSteps - 1) * kNumColumns + kQ);
    EXPECT_NEAR(turning[last] - usual[last], expected, 0.1 * std::abs(expected)) << inertia;
  }
}

TEST(DrawnFlight, DensityMultipliesForcesAndIsObservedInTheEquivalentAirspeed) {
  const Response nominal = Respond(OneFlight());
  EXPECT_NEAR(Respond(With(&PlantConfig::density, 1.2)).end[kNz], 1.2 * nominal.end[kNz],
              kRelative);
  const auto observed = [](const EnvConfig& config) {
    std::array<float, kObservationSize> observation{};
    VecEnv(config, 1, 1).Observe(0, observation.data());
    return observation;
  };
  const auto usual = observed(OneFlight()), dense = observed(With(&PlantConfig::density, 1.44));
  constexpr Tolerance kFloat32{1e-5, "float32"};
  EXPECT_NEAR(dense[8], 1.2 * usual[8], kFloat32);
  EXPECT_NEAR(dense[21], usual[21] / 1.2, kFloat32);
}

TEST(DrawnFlight, StickGainsMultiplyCommandsUpToTheirLimits) {
  struct Stick {
    Range PlantConfig::*gain;
    std::size_t action;
  };
  for (const Stick& stick :
       {Stick{&PlantConfig::pitch_stick, 1}, Stick{&PlantConfig::roll_stick, 2},
        Stick{&PlantConfig::yaw_stick, 3}}) {
    const auto hold = [&](float command) {
      return [=](int) {
        Action action{};
        action[stick.action] = command;
        return action;
      };
    };
    EXPECT_EQ(Fly(With(stick.gain, 0.5), hold(0.5f), 20), Fly(With(stick.gain, 1), hold(0.25f), 20))
        << stick.action;
    EXPECT_EQ(Fly(With(stick.gain, 2), hold(0.75f), 20), Fly(With(stick.gain, 1), hold(1), 20))
        << stick.action;
  }
}

TEST(DrawnFlight, BandwidthIsTheActuatorsTimeConstant) {
  // By the direct law the command is a step: 1 - exp(-b t) of the way after one control step.
  const Actuator aileron = F16().actuators.aileron;
  constexpr float kStick = 0.02f;  // below the rate limit
  const double command = -aileron.max_deg * kStick;
  for (const double factor : {0.5, 2.0}) {
    EnvConfig config = With(&PlantConfig::actuator_bandwidth, factor);
    config.flight_control = FlightControlMode::kDirect;
    config.initial.trimmed = false;
    const auto states = Fly(
        config,
        [](int) {
          return Action{0, 0, kStick, 0};
        },
        1);
    const double reached = 1 - std::exp(-factor * aileron.bandwidth_per_s * kInterval);
    EXPECT_NEAR(states[kAileron], reached * command, 1e-5 * std::abs(command));
  }
}

TEST(DrawnFlight, RateIsTheActuatorsLimit) {
  constexpr Tolerance kFloat32{1e-6, "float32 roundings of 0.8 degrees"};
  EnvConfig config = With(&PlantConfig::actuator_rate, 0.5);
  config.flight_control = FlightControlMode::kDirect;
  config.initial.trimmed = false;
  const auto states = Fly(
      config,
      [](int) {
        return Action{0, 0, 1, 0};
      },
      1);
  EXPECT_NEAR(states[kAileron], -0.5 * F16().actuators.aileron.rate_limit_deg_per_s * kInterval,
              kFloat32);
}

// All at once, against the float64 aircraft whose data are others.
TEST(DrawnFlight, FliesLikeTheClosedLoopInDoublePrecision) {
  constexpr Tolerance kVelocity{0.05, "float32 over two seconds, amplified by the pitch loop"};
  constexpr Tolerance kRate{5e-4, "float32 over two seconds, amplified by the pitch loop"};
  constexpr Tolerance kSurface{0.05, "float32 integrators, amplified by the pitch loop"};
  EnvConfig config = OneFlight();
  PlantConfig& ranges = config.plant;
  for (Range PlantConfig::*factor :
       {&PlantConfig::mass, &PlantConfig::inertia, &PlantConfig::axial_force,
        &PlantConfig::normal_force, &PlantConfig::pitching_moment, &PlantConfig::lateral,
        &PlantConfig::control, &PlantConfig::damping, &PlantConfig::thrust,
        &PlantConfig::thrust_lag, &PlantConfig::density, &PlantConfig::actuator_rate,
        &PlantConfig::actuator_bandwidth}) {
    ranges.*factor = {0.85, 1.15};
  }
  ranges.cg_shift = {-0.04, 0.04};
  ranges.engine_momentum = {0, 160};
  const Aircraft f16 = F16();
  const TrimPoint trim = Trim(Plant(f16, config.atmosphere), {20000, 900, 0, 0});
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    simd::RandomStream random({seed, 0, 0, 0, simd::RandomPurpose::kPlant});
    const PlantDraw draw = DrawPlant(ranges, &random);
    // Trimmed is the nominal plant; the flight then is another one's.
    Plant plant(f16, config.atmosphere);
    ClosedLoop expected(plant, trim, config.flight_control, config.control_interval_s);
    plant = Plant(DrawnAircraft(f16, draw), config.atmosphere, draw.density);
    VecEnv env(config, 1, seed);
    StepBuffers buffers(1);
    for (int step = 0; step < 100; ++step) {
      const Action action = Lively(step);
      std::copy(action.begin(), action.end(), buffers.action.begin());
      expected.Step({0.5 * (action[0] + 1), action[1], action[2], action[3]});
      env.Step(0, buffers.action.data(), buffers.output());
      for (const int c : {kU, kV, kW}) {
        ASSERT_NEAR(env.StateOf(0, c), expected.state()[c], kVelocity) << seed << ", " << step;
      }
      for (const int c : {kP, kQ, kR, kQ0, kQx, kQy, kQz}) {
        ASSERT_NEAR(env.StateOf(0, c), expected.state()[c], kRate) << seed << ", " << step;
      }
      ASSERT_NEAR(env.StateOf(0, kPower), expected.power(), kSurface);
      ASSERT_NEAR(env.StateOf(0, kElevator), expected.surfaces().elevator_deg, kSurface);
      ASSERT_NEAR(env.StateOf(0, kRudder), expected.surfaces().rudder_deg, kSurface);
    }
  }
}

}  // namespace
}  // namespace skein::one_flight
