// SPDX-License-Identifier: Apache-2.0
// Every kernel that measures the air takes the velocity relative to it: what it does in wind is, to
// the bit, what it does in still air with that velocity. StepTile is in plant_kernel_test.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "envs/aircraft/f16.h"
#include "envs/kernels/flight_control_kernel.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/state/attitude.h"
#include "envs/task_registry.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/reward_and_termination.h"
#include "simd/random.h"
#include "tests/envs/test_tile.h"
#include "tests/scoped_target.h"

namespace skein {
namespace {

constexpr int kCount = 400;
constexpr AtmosphereModel kAtmosphere = AtmosphereModel::kStevensLewis;

class AirVelocityTest : public testing::TestWithParam<simd::Target> {
 protected:
  AirVelocityTest() {
    for (int i = 0; i < kCount; ++i) {
      simd::RandomStream random(
          {5, static_cast<std::uint32_t>(i), 0, 0, simd::RandomPurpose::kInitialState});
      const auto draw = [&](int column, double low, double high) {
        still_.at(column, i) = static_cast<float>(random.Uniform(low, high));
      };
      const Eigen::Vector4d attitude = QuaternionFromEuler(
          {random.Uniform(-3, 3), random.Uniform(-1.2, 1.2), random.Uniform(-3, 3)});
      for (int k = 0; k < 4; ++k) still_.at(kQ0 + k, i) = static_cast<float>(attitude[k]);
      draw(kU, 500, 1500);
      draw(kV, -200, 200);
      draw(kW, -100, 300);
      draw(kDown, -40000, -4000);
      draw(kNz, 0, 3);
      for (int column = kAlphaFilter; column < kNumColumns; ++column) draw(column, -0.5, 0.5);
      for (int column = 0; column < kNumColumns; ++column) {
        windy_.at(column, i) = still_.at(column, i);
      }
      // Over ground it flies in another direction.
      for (int k = 0; k < 3; ++k) {
        windy_.at(kAirU + k, i) = still_.at(kU + k, i);
        windy_.at(kU + k, i) += static_cast<float>(random.Uniform(-200, 200));
      }
    }
  }

  ScopedTarget target_{GetParam()};
  std::shared_ptr<const KernelAircraft> kernel_ = MakeKernelAircraft(F16(), kAtmosphere);
  TestTile still_{kCount}, windy_{kCount, kNumWindyColumns};
};

TEST_P(AirVelocityTest, FlightControl) {
  const std::vector<float> command(still_.stride(), 0.2f);
  const PilotColumns pilot{command.data(), command.data(), command.data(), command.data()};
  ControlTile(*kernel_, still_.tile(), pilot, FlightControlMode::kFull, 0.02f);
  ControlTile(*kernel_, windy_.tile(), pilot, FlightControlMode::kFull, 0.02f);
  for (int i = 0; i < kCount; ++i) {
    for (int column = kPowerCommand; column < kNumColumns; ++column) {
      ASSERT_EQ(windy_.at(column, i), still_.at(column, i)) << column;
    }
  }
}

TEST_P(AirVelocityTest, Observation) {
  const std::vector<float> errors(3 * still_.stride());
  std::vector<float> still(kCount * kObservationSize), windy(still.size());
  ObserveTile(*kernel_, still_.tile(), {errors.data(), still_.stride()}, {}, still.data());
  ObserveTile(*kernel_, windy_.tile(), {errors.data(), still_.stride()}, {}, windy.data());
  EXPECT_EQ(windy, still);
}

TEST_P(AirVelocityTest, Terminations) {
  EnvConfig config;
  // Limits that half of the flights are beyond.
  config.termination.alpha_deg = {-2, 10};
  config.termination.beta_deg = {-6, 6};
  config.termination.max_mach = 1;
  const auto terminations = [&](TestTile* flight) {
    std::vector<float> reward(flight->stride()), policy_step(reward), total(reward);
    std::vector<std::int32_t> reached(flight->stride()), step(reached), termination(reached);
    ComputeRewardAndTermination(
        *kernel_, TerminationLimits(config.termination, config.episode()), flight->tile(),
        {reward.data(), reached.data()},
        {step.data(), termination.data(), policy_step.data(), total.data()});
    termination.resize(kCount);
    return termination;
  };
  const std::vector<std::int32_t> still = terminations(&still_);
  EXPECT_EQ(terminations(&windy_), still);
  for (const Termination expected :
       {Termination::kNone, Termination::kExtremeState, Termination::kHighSpeed}) {
    EXPECT_NE(std::count(still.begin(), still.end(), static_cast<std::int32_t>(expected)), 0);
  }
}

TEST_P(AirVelocityTest, TargetsOfTrueAirspeed) {
  for (const char* name : {"heading", "control"}) {
    EnvConfig config;
    config.task = name;
    const std::unique_ptr<Task> task = MakeTask(config);
    TestTile columns(kCount, task->num_columns());
    for (int i = 0; i < kCount; ++i) {
      simd::RandomStream random(
          {6, static_cast<std::uint32_t>(i), 0, 0, simd::RandomPurpose::kTarget});
      task->Reset({20000, 1000, 0, 0}, &random, columns.tile(), i);
    }
    std::vector<float> still(3 * still_.stride()), windy(still);
    task->Errors(still_.tile(), columns.tile(), still.data(), still_.stride());
    task->Errors(windy_.tile(), columns.tile(), windy.data(), still_.stride());
    EXPECT_EQ(windy, still) << name;

    std::vector<float> reward(still_.stride()), windy_reward(reward);
    std::vector<std::int32_t> reached(still_.stride()), windy_reached(reached), steps(reached);
    task->ComputeReward(still_.tile(), columns.tile(), steps.data(),
                        {reward.data(), reached.data()});
    task->ComputeReward(windy_.tile(), columns.tile(), steps.data(),
                        {windy_reward.data(), windy_reached.data()});
    EXPECT_EQ(windy_reward, reward) << name;
    EXPECT_EQ(windy_reached, reached) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, AirVelocityTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

}  // namespace
}  // namespace skein
