// SPDX-License-Identifier: Apache-2.0
// The vectorised autopilot against its own laws in float64, and what it owes its callers.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "envs/actions.h"
#include "envs/autopilot/autopilot.h"
#include "envs/autopilot/laws-inl.h"
#include "envs/tasks/observation.h"
#include "gtest/gtest.h"
#include "simd/target.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace HWY_NAMESPACE {
namespace {

constexpr int kCount = 37;  // two vectors of sixteen and a rest
const char* const kTasks[] = {"heading", "control", "tracking"};

std::unique_ptr<Policy> Autopilot(const std::string& task, AutopilotVariant variant) {
  EnvConfig config;
  config.task = task;
  return MakeAutopilot(config, variant);
}

/// Smooth flights that nobody flies: every element of an observation wanders by itself.
class WanderingObservations {
 public:
  explicit WanderingObservations(int count) : rows_(Size(count)), rates_(Size(count)) {
    for (int i = 0; i < count; ++i) {
      Angle(i, 3, 0.6 * Uniform());
      for (int k = 0; k < 3; ++k) Row(i)[k] = 0.3f * Uniform();
      Row(i)[3] = 1.2f + 0.2f * Uniform();
      Angle(i, 4, 2 * Uniform());
      Angle(i, 6, 0.5 * Uniform());
      Row(i)[8] = 0.7f + 0.1f * Uniform();
      Angle(i, 9, 0.1 * Uniform());
      Angle(i, 11, 0.02 * Uniform());
      for (int k = 13; k < 16; ++k) Row(i)[k] = 0.1f * Uniform();
      Row(i)[21] = 1.35f + 0.02f * Uniform();
    }
    for (float& rate : rates_) rate = 0.002f * Uniform();
  }

  void Advance() {
    for (std::size_t k = 0; k < rows_.size(); ++k) rows_[k] += rates_[k];
  }
  const std::vector<float>& rows() const { return rows_; }

 private:
  static std::size_t Size(int count) { return static_cast<std::size_t>(count) * kObservationSize; }
  float* Row(int i) { return rows_.data() + Size(i); }
  void Angle(int i, int k, double angle) {
    Row(i)[k] = static_cast<float>(std::sin(angle));
    Row(i)[k + 1] = static_cast<float>(std::cos(angle));
  }
  float Uniform() { return std::uniform_real_distribution<float>(-1, 1)(random_); }

  std::mt19937 random_{7};
  std::vector<float> rows_, rates_;
};

/// The state and the actions of aircraft that observe what wanders.
struct Flown {
  Flown(const Policy& autopilot, int count)
      : state(static_cast<std::size_t>(count * autopilot.state_size())),
        action(static_cast<std::size_t>(count * autopilot.action_size())) {}
  std::vector<float> state, action;
};

Flown FlyFor(const Policy& autopilot, int steps) {
  WanderingObservations observed(kCount);
  Flown flown(autopilot, kCount);
  for (int step = 0; step < steps; ++step) {
    autopilot.Act(kCount, observed.rows().data(), flown.state.data(), flown.action.data());
    observed.Advance();
  }
  return flown;
}

/// The same in float64, aircraft by aircraft.
template <template <class> class Law>
std::vector<double> FlyInDouble(AutopilotVariant variant, int steps) {
  WanderingObservations observed(kCount);
  std::vector<typename Law<double>::Memory> memory(kCount);
  std::vector<double> action(kCount * kActionSize);
  const AutopilotGains gains = GainsFor(EnvConfig(), variant);
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < kCount; ++i) {
      double row[kObservationSize];
      std::copy_n(observed.rows().begin() + static_cast<std::ptrdiff_t>(i) * kObservationSize,
                  kObservationSize, row);
      Law<double>::Act(gains, AutopilotTiming(), row, memory[i], &action[i * kActionSize]);
    }
    observed.Advance();
  }
  return action;
}

std::vector<double> Expected(const std::string& task, AutopilotVariant variant, int steps) {
  if (task == "heading") return FlyInDouble<HeadingLaw>(variant, steps);
  if (task == "control") return FlyInDouble<ControlLaw>(variant, steps);
  return FlyInDouble<TrackingLaw>(variant, steps);
}

/// An aircraft at a switch may go the other way: none does here.
constexpr Tolerance kFloat32{2e-4, "float32 through 200 steps, times 20 from angle to full stick"};

class AutopilotKernel : public testing::TestWithParam<const char*> {};

TEST_P(AutopilotKernel, EqualsTheLawsInFloat64OnEveryTarget) {
  constexpr int kSteps = 200;
  for (const AutopilotVariant variant :
       {AutopilotVariant::kTraditional, AutopilotVariant::kAggressive}) {
    const std::vector<double> expected = Expected(GetParam(), variant, kSteps);
    const auto autopilot = Autopilot(GetParam(), variant);
    for (const simd::Target target : simd::SupportedTargets()) {
      const ScopedTarget scoped(target);
      const Flown flown = FlyFor(*autopilot, kSteps);
      for (std::size_t k = 0; k < expected.size(); ++k) {
        ASSERT_NEAR(flown.action[k], expected[k], kFloat32)
            << simd::Name(target) << " aircraft " << k / kActionSize << " command "
            << k % kActionSize;
      }
    }
  }
}

TEST_P(AutopilotKernel, NoAircraftDependsOnOthers) {
  const auto autopilot = Autopilot(GetParam(), AutopilotVariant::kAggressive);
  const Flown together = FlyFor(*autopilot, 50);
  WanderingObservations observed(kCount);
  Flown apart(*autopilot, kCount);
  for (int step = 0; step < 50; ++step) {
    for (int first = 0; first < kCount;) {
      const int count = std::min(1 + (first + step) % 19, kCount - first);
      autopilot->Act(count, observed.rows().data() + first * kObservationSize,
                     apart.state.data() + first * autopilot->state_size(),
                     apart.action.data() + first * kActionSize);
      first += count;
    }
    observed.Advance();
  }
  EXPECT_EQ(together.action, apart.action);
  EXPECT_EQ(together.state, apart.state);
}

TEST_P(AutopilotKernel, WhatIsNotFiniteStaysWithItsAircraft) {
  const auto autopilot = Autopilot(GetParam(), AutopilotVariant::kAggressive);
  WanderingObservations observed(kCount);
  Flown well(*autopilot, kCount), sick(*autopilot, kCount);
  std::vector<float> rows = observed.rows();
  std::fill_n(rows.begin() + 5 * kObservationSize, kObservationSize,
              std::numeric_limits<float>::quiet_NaN());
  for (int step = 0; step < 10; ++step) {
    autopilot->Act(kCount, observed.rows().data(), well.state.data(), well.action.data());
    autopilot->Act(kCount, rows.data(), sick.state.data(), sick.action.data());
  }
  for (std::size_t k = 0; k < well.action.size(); ++k) {
    if (k / kActionSize == 5) continue;
    EXPECT_EQ(well.action[k], sick.action[k]) << k;
  }
}

/// Left and right: mirrored observations give mirrored actions, bit-exactly.
TEST_P(AutopilotKernel, IsSymmetric) {
  for (const AutopilotVariant variant :
       {AutopilotVariant::kTraditional, AutopilotVariant::kAggressive}) {
    const auto autopilot = Autopilot(GetParam(), variant);
    WanderingObservations observed(kCount);
    Flown right(*autopilot, kCount), left(*autopilot, kCount);
    for (int step = 0; step < 100; ++step) {
      std::vector<float> mirrored = observed.rows();
      for (std::size_t i = 0; i < kCount; ++i) {
        // The error in yaw or to the right; roll, sideslip, roll rate and yaw rate.
        for (const std::size_t k : {1, 4, 11, 13, 15}) mirrored[i * kObservationSize + k] *= -1;
      }
      autopilot->Act(kCount, observed.rows().data(), right.state.data(), right.action.data());
      autopilot->Act(kCount, mirrored.data(), left.state.data(), left.action.data());
      for (std::size_t k = 0; k < right.action.size(); ++k) {
        const float sign = k % kActionSize == 2 ? -1 : 1;
        ASSERT_EQ(right.action[k], sign * left.action[k]) << step << " " << k;
      }
      observed.Advance();
    }
  }
}

TEST_P(AutopilotKernel, ActionsStayWithinOne) {
  const auto autopilot = Autopilot(GetParam(), AutopilotVariant::kAggressive);
  for (const float action : FlyFor(*autopilot, 300).action) EXPECT_LE(std::abs(action), 1);
}

TEST_P(AutopilotKernel, OuterLoopsRunInEveryFifthStep) {
  const auto autopilot = Autopilot(GetParam(), AutopilotVariant::kTraditional);
  WanderingObservations observed(kCount);
  Flown flown(*autopilot, kCount);
  std::vector<float> throttle;
  for (int step = 0; step < 21; ++step) {
    autopilot->Act(kCount, observed.rows().data(), flown.state.data(), flown.action.data());
    observed.Advance();
    std::vector<float> now;
    for (std::size_t i = 0; i < kCount; ++i) now.push_back(flown.action[i * kActionSize]);
    if (step > 0) {
      EXPECT_EQ(now != throttle, step % 5 == 0) << step;
    }
    throttle = now;
  }
}

INSTANTIATE_TEST_SUITE_P(Tasks, AutopilotKernel, testing::ValuesIn(kTasks));

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
