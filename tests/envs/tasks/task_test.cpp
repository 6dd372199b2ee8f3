// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/task.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "envs/env_config.h"
#include "envs/task_registry.h"
#include "tests/envs/test_tile.h"
#include "tests/scoped_target.h"

namespace skein {
namespace {

constexpr int kAircraft = 21;

/// Flights somewhere on their way to targets, some of them near.
class TaskTest : public testing::TestWithParam<simd::Target> {
 protected:
  void Begin(const Task& task) {
    std::minstd_rand random(1);
    std::uniform_real_distribution<float> change(-1, 1);
    for (int i = 0; i < kAircraft; ++i) {
      const float size = i % 2 == 0 ? 1.0f : 0.01f;
      flight_.at(kDown, i) = -20000 + 300 * size * change(random);
      flight_.at(kU, i) = 1000 + 100 * size * change(random);
      flight_.at(kV, i) = 50 * size * change(random);
      flight_.at(kW, i) = 50 * size * change(random);
      flight_.at(kQ0, i) = 1;
      flight_.at(kQz, i) = 0.1f * size * change(random);
      simd::RandomStream target(
          {1, static_cast<std::uint32_t>(i), 0, 0, simd::RandomPurpose::kTarget});
      task.Reset({20000, 1000, 0, 0}, &target, targets_.tile(), i);
    }
  }

  const ScopedTarget target_{GetParam()};
  TestTile flight_{kAircraft};
  TestTile targets_{kAircraft, 16};
};

TEST_P(TaskTest, ARewardOfErrorsSaysThemAsTheyAreAndIsTheSame) {
  int told = 0;
  for (const std::string& name : TaskNames()) {
    EnvConfig config;
    config.task = name;
    const std::unique_ptr<Task> task = MakeTask(config);
    if (!task->rewards_by_errors()) continue;
    ++told;
    Begin(*task);
    const std::size_t stride = flight_.stride();
    const std::vector<std::int32_t> steps(stride, 1000);
    const auto rewarded = [&](float* errors) {
      std::vector<float> reward(stride);
      std::vector<std::int32_t> reached(stride);
      StepResult result{reward.data(), reached.data()};
      result.errors = errors;
      result.error_stride = stride;
      task->ComputeReward(flight_.tile(), targets_.tile(), steps.data(), result);
      reward.resize(kAircraft);
      reached.resize(kAircraft);
      return std::pair(reward, reached);
    };
    std::vector<float> expected(kNumTaskErrors * stride), told_errors(expected.size());
    task->Errors(flight_.tile(), targets_.tile(), expected.data(), stride);
    const auto asked = rewarded(told_errors.data());
    EXPECT_EQ(asked, rewarded(nullptr)) << name;
    for (std::size_t k = 0; k < kNumTaskErrors; ++k) {
      for (std::size_t i = 0; i < kAircraft; ++i) {
        EXPECT_EQ(told_errors[k * stride + i], expected[k * stride + i]) << name;
      }
    }
  }
  EXPECT_GT(told, 0);
}

INSTANTIATE_TEST_SUITE_P(Targets, TaskTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

}  // namespace
}  // namespace skein
