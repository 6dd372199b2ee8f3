// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/tracking.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "envs/state/attitude.h"
#include "envs/task_registry.h"
#include "tests/envs/test_tile.h"
#include "tests/extremes.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr double kUnit = 1000 / 0.3048;  // 1 km in ft
constexpr Tolerance kFloat32{5e-6, "float32 rounding of 40,000 ft in km, and of its rotation"};
constexpr Tolerance kEnds{1e-5, "float32 rounding at the ends of a range"};

using Position = std::array<double, 3>;  ///< north, east, altitude, ft

class TrackingTest : public testing::TestWithParam<simd::Target> {
 protected:
  static EnvConfig Config() {
    EnvConfig config;
    config.task = "tracking";
    return config;
  }

  void SetAttitude(int i, const EulerAngles& attitude) {
    const Eigen::Vector4d q = QuaternionFromEuler(attitude);
    for (int k = 0; k < 4; ++k) flight_.at(kQ0 + k, i) = static_cast<float>(q[k]);
  }
  void SetPosition(int i, const Position& position) {
    flight_.at(kNorth, i) = static_cast<float>(position[0]);
    flight_.at(kEast, i) = static_cast<float>(position[1]);
    flight_.at(kDown, i) = static_cast<float>(-position[2]);
  }
  void SetTarget(int i, const Position& position, double tolerance_ft = 100) {
    targets_.at(kTrackingTolerance, i) = static_cast<float>(tolerance_ft);
    for (int k = 0; k < 3; ++k) {
      targets_.at(kTrackingNorth + k, i) =
          static_cast<float>(position[static_cast<std::size_t>(k)]);
    }
  }
  void ComputeReward(const Task& task) {
    task.ComputeReward(flight_.tile(), targets_.tile(), steps_.data(),
                       {reward_.data(), reached_.data()});
  }
  /// Flies one control step from `begin` to `end`, both relative to the target.
  void Pass(int i, const Position& begin, const Position& end) {
    constexpr Position kTarget = {3000, -2000, 15000};
    SetTarget(i, kTarget);
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      targets_.at(kTrackingLastNorth + k, i) = static_cast<float>(kTarget[axis] + begin[axis]);
    }
    SetPosition(i, {kTarget[0] + end[0], kTarget[1] + end[1], kTarget[2] + end[2]});
  }

  static constexpr int kCount = 37;
  ScopedTarget target_{GetParam()};
  std::unique_ptr<Task> task_ = MakeTask(Config());
  TestTile flight_{kCount};
  TestTile targets_{kCount, kNumTrackingColumns};
  std::vector<float> reward_ = std::vector<float>(flight_.stride());
  std::vector<std::int32_t> reached_ = std::vector<std::int32_t>(flight_.stride());
  std::vector<std::int32_t> steps_ = std::vector<std::int32_t>(flight_.stride());
};

TEST_P(TrackingTest, ErrorsAreAheadRightAndUpOfTheHeading) {
  // A target 4 km away on the bearing of 70 degrees, 1 km above: whatever pitch and roll.
  const double bearing = 70 / kDegPerRad;
  for (int i = 0; i < kCount; ++i) {
    const double yaw = std::remainder(0.37 * i, 2 * M_PI);
    SetAttitude(i, {0.5 * i, 0.04 * i - 0.7, yaw});
    SetPosition(i, {1000, 2000, 20000});
    SetTarget(i, {1000 + 4 * kUnit * std::cos(bearing), 2000 + 4 * kUnit * std::sin(bearing),
                  20000 + kUnit});
  }
  std::vector<float> errors(kNumTaskErrors * flight_.stride());
  task_->Errors(flight_.tile(), targets_.tile(), errors.data(), flight_.stride());
  for (int i = 0; i < kCount; ++i) {
    const double to_the_right = bearing - 0.37 * i;
    const auto index = static_cast<std::size_t>(i);
    EXPECT_NEAR(errors[index], 4 * std::cos(to_the_right), kFloat32) << i;
    EXPECT_NEAR(errors[flight_.stride() + index], 4 * std::sin(to_the_right), kFloat32) << i;
    EXPECT_NEAR(errors[2 * flight_.stride() + index], 1, kFloat32) << i;
  }
  for (const TargetQuantity& quantity : task_->target_quantities()) {
    EXPECT_DOUBLE_EQ(quantity.error_unit, kUnit);
  }
}

TEST_P(TrackingTest, StraightUpNorthCountsAsTheHeading) {
  // The quaternion of pitch 90 degrees, exact in float32 but for its length.
  for (const int i : {0, 1}) {
    const float sign = i == 0 ? 1 : -1;
    flight_.at(kQ0, i) = std::sqrt(0.5f);
    flight_.at(kQy, i) = sign * std::sqrt(0.5f);
    SetPosition(i, {0, 0, 20000});
    SetTarget(i, {2 * kUnit, -3 * kUnit, 20000});
  }
  std::vector<float> errors(kNumTaskErrors * flight_.stride());
  task_->Errors(flight_.tile(), targets_.tile(), errors.data(), flight_.stride());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(errors[i], 2, kFloat32);
    EXPECT_NEAR(errors[flight_.stride() + i], -3, kFloat32);
  }
}

TEST_P(TrackingTest, ErrorsInPathAxesAreAlongRightOfAndAboveThePathOverGround) {
  // Whatever the attitude, with large angles of attack and sideslip between nose and path.
  EnvConfig config = Config();
  config.tracking.error_axes = TrackingAxes::kPath;
  const std::unique_ptr<Task> path = MakeTask(config);
  const Eigen::Vector3d position(1000, 2000, -20000), error(6, -1.5, 0.5);
  for (int i = 0; i < kCount; ++i) {
    const double course = std::remainder(0.37 * i, 2 * M_PI), climb = 0.08 * i - 1.4;
    const Eigen::Vector3d along(std::cos(climb) * std::cos(course),
                                std::cos(climb) * std::sin(course), -std::sin(climb));
    const Eigen::Vector3d right(-std::sin(course), std::cos(course), 0);
    const Eigen::Vector3d above = right.cross(along);
    const EulerAngles attitude{0.5 * i, climb + 0.4, course - 0.3};
    SetAttitude(i, attitude);
    const Eigen::Vector3d velocity = BodyFromNed(QuaternionFromEuler(attitude)) * (1100 * along);
    for (int k = 0; k < 3; ++k) flight_.at(kU + k, i) = static_cast<float>(velocity[k]);
    SetPosition(i, {position[0], position[1], -position[2]});
    const Eigen::Vector3d target =
        position + kUnit * (error[0] * along + error[1] * right + error[2] * above);
    SetTarget(i, {target[0], target[1], -target[2]});
  }
  std::vector<float> errors(kNumTaskErrors * flight_.stride());
  path->Errors(flight_.tile(), targets_.tile(), errors.data(), flight_.stride());
  for (std::size_t i = 0; i < kCount; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(errors[k * flight_.stride() + i], error[static_cast<int>(k)], 2 * kFloat32)
          << i << ", " << k;
    }
  }
}

TEST_P(TrackingTest, APathStraightUpCountsAsNorthboundAndNoPathAsLevel) {
  EnvConfig config = Config();
  config.tracking.error_axes = TrackingAxes::kPath;
  const std::unique_ptr<Task> path = MakeTask(config);
  // Level and northbound by attitude; up, down, at rest.
  const float down[] = {-800, 800, 0};
  const double expected[3][3] = {{5, -3, -2}, {-5, -3, 2}, {2, -3, 5}};
  for (int i = 0; i < 3; ++i) {
    SetAttitude(i, {0, 0, 0});
    flight_.at(kU, i) = flight_.at(kV, i) = 0;
    flight_.at(kW, i) = down[i];
    SetPosition(i, {0, 0, 20000});
    SetTarget(i, {2 * kUnit, -3 * kUnit, 20000 + 5 * kUnit});
  }
  std::vector<float> errors(kNumTaskErrors * flight_.stride());
  path->Errors(flight_.tile(), targets_.tile(), errors.data(), flight_.stride());
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(errors[k * flight_.stride() + i], expected[i][k], kFloat32) << i << ", " << k;
    }
  }
}

TEST_P(TrackingTest, ErrorsInEarthAxesTakeNoNoticeOfTheHeading) {
  EnvConfig config = Config();
  config.tracking.error_axes = TrackingAxes::kEarth;
  const std::unique_ptr<Task> earth = MakeTask(config);
  for (int i = 0; i < kCount; ++i) {
    SetAttitude(i, {0.1, 0.2, 0.3 * i});
    SetPosition(i, {100, 200, 20000});
    SetTarget(i, {100 - 5 * kUnit, 200 + 6 * kUnit, 20000 - 0.5 * kUnit});
  }
  std::vector<float> errors(kNumTaskErrors * flight_.stride());
  earth->Errors(flight_.tile(), targets_.tile(), errors.data(), flight_.stride());
  for (std::size_t i = 0; i < kCount; ++i) {
    EXPECT_NEAR(errors[i], -5, kFloat32);
    EXPECT_NEAR(errors[flight_.stride() + i], 6, kFloat32);
    EXPECT_NEAR(errors[2 * flight_.stride() + i], -0.5, kFloat32);
  }
}

TEST_P(TrackingTest, RewardIsMinusTheDistanceInKilometres) {
  const std::vector<Position> away = {
      {2, -3, 6}, {0, 0, 0}, {-4, 0, 0}, {0, 3, -4}, {0.01, 0.02, -0.02}};
  for (int i = 0; i < static_cast<int>(away.size()); ++i) {
    const Position& a = away[static_cast<std::size_t>(i)];
    SetPosition(i, {500, -700, 18000});
    SetTarget(i, {500 + a[0] * kUnit, -700 + a[1] * kUnit, 18000 + a[2] * kUnit});
  }
  ComputeReward(*task_);
  const double distance[] = {7, 0, 4, 5, 0.03};
  for (std::size_t i = 0; i < away.size(); ++i) EXPECT_NEAR(reward_[i], -distance[i], kFloat32);
}

TEST_P(TrackingTest, RewardOfTheApproachIsWhatTheDistanceBecameLessBy) {
  EnvConfig config = Config();
  config.tracking.distance_weight = 0;
  config.tracking.approach_weight = 3;
  const std::unique_ptr<Task> task = MakeTask(config);
  Pass(0, {-700, 0, 0}, {-200, 0, 0});
  Pass(1, {-200, 0, 0}, {-700, 0, 0});
  Pass(2, {300, 400, 0}, {0, -300, -400});
  Pass(3, {-2000, -3000, 6000}, {0, 3000, 4000});
  // Moving the aircraft by rounded positions of 15,000 ft leaves some 1e-6 km.
  ComputeReward(*task);
  const double nearer_ft[] = {500, -500, 0, 2000};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(reward_[i], 3 * nearer_ft[i] / kUnit, kFloat32) << i;
  }
  // Beside the distance, both count.
  config.tracking.distance_weight = 2;
  Pass(3, {-2000, -3000, 6000}, {0, 3000, 4000});
  ComputeReward(*MakeTask(config));
  EXPECT_NEAR(reward_[3], (3 * 2000 - 2 * 5000) / kUnit, kFloat32);
}

TEST_P(TrackingTest, IsReachedWhereThePathTouchesTheBox) {
  struct Case {
    const char* what;
    Position begin, end;
    bool reached;
  };
  const std::vector<Case> cases = {
      {"ends inside", {-120, 0, 0}, {-99, 0, 0}, true},
      {"ends before", {-140, 0, 0}, {-101, 0, 0}, false},
      {"ends inside, below", {50, 50, -130}, {50, 50, -99}, true},
      {"begins and ends inside", {10, 20, 30}, {11, 21, 31}, true},
      {"leaves", {99, 0, 0}, {140, 0, 0}, true},
      {"has left", {101, 0, 0}, {140, 0, 0}, false},
      {"passes through between two steps", {-150, 0, 0}, {150, 0, 0}, true},
      {"passes beside it", {-150, 101, 0}, {150, 101, 0}, false},
      {"passes above it", {-150, 0, 100.5}, {150, 0, 100.5}, false},
      {"passes along its side, inside", {-150, 99.5, -99.5}, {150, 99.5, -99.5}, true},
      // Across the edge north and east: inside where both are below 100, at 99 and 99.
      {"cuts a corner", {88, 110, 0}, {110, 88, 0}, true},
      {"misses the corner", {92, 110, 0}, {110, 92, 0}, false},
      // The diagonal meets the corner (100, 100, 100) at its middle, moved by 1 ft.
      {"cuts a vertex", {77, 110, 110}, {121, 88, 88}, true},
      {"misses the vertex", {81, 110, 110}, {125, 88, 88}, false},
      {"inside of each slab, but never of all at once", {-120, 64, 0}, {-80, 144, 0}, false},
      {"the same, but soon enough", {-120, 40, 0}, {-80, 120, 0}, true},
      {"does not move, inside", {50, -50, 50}, {50, -50, 50}, true},
      {"does not move, outside", {50, -101, 50}, {50, -101, 50}, false},
      {"flies away from it in line with it", {-200, 0, 0}, {-230, 0, 0}, false},
      {"stops short of it", {-400, -400, -400}, {-110, -110, -110}, false},
  };
  for (int i = 0; i < static_cast<int>(cases.size()); ++i) {
    const Case& c = cases[static_cast<std::size_t>(i)];
    Pass(i, c.begin, c.end);
  }
  ComputeReward(*task_);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(reached_[i], cases[i].reached ? 1 : 0) << cases[i].what;
  }
  // The same seen in a mirror, and with the axes in other places.
  for (int i = 0; i < static_cast<int>(cases.size()); ++i) {
    const auto turned = [](const Position& p) { return Position{-p[2], p[0], -p[1]}; };
    const Case& c = cases[static_cast<std::size_t>(i)];
    Pass(i, turned(c.begin), turned(c.end));
  }
  ComputeReward(*task_);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(reached_[i], cases[i].reached ? 1 : 0) << cases[i].what << ", turned";
  }
}

TEST_P(TrackingTest, APathEqualsManyPointsOnIt) {
  simd::RandomStream random({7, 0, 0, 0, simd::RandomPurpose::kTarget});
  constexpr int kPoints = 4000;
  // Farther from the box's surface than two points lie apart: the points cannot miss it.
  constexpr double kClear = 400.0 / kPoints;
  int reached = 0;
  for (int round = 0; round < 10; ++round) {
    std::vector<double> nearest(kCount, 1e9);
    for (int i = 0; i < kCount; ++i) {
      Position begin, end;
      for (std::size_t k = 0; k < 3; ++k) {
        begin[k] = random.Uniform(-250, 250);
        end[k] = begin[k] + random.Uniform(-230, 230);
      }
      Pass(i, begin, end);
      for (int p = 0; p <= kPoints; ++p) {
        double farthest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          farthest = std::max(farthest, std::abs(begin[k] + (end[k] - begin[k]) * p / kPoints));
        }
        double& least = nearest[static_cast<std::size_t>(i)];
        least = std::min(least, farthest);
      }
    }
    ComputeReward(*task_);
    for (std::size_t i = 0; i < kCount; ++i) {
      if (std::abs(nearest[i] - 100) < kClear) continue;
      EXPECT_EQ(reached_[i], nearest[i] < 100 ? 1 : 0) << "nearest " << nearest[i];
      reached += reached_[i];
    }
  }
  EXPECT_GT(reached, 20);
  EXPECT_LT(reached, 350);
}

TEST_P(TrackingTest, APathBeginsWhereTheLastOneEnded) {
  for (int i = 0; i < kCount; ++i) Pass(i, {500, 0, 0}, {-150.0 - i, 0, 0});
  ComputeReward(*task_);
  for (std::size_t i = 0; i < kCount; ++i) EXPECT_EQ(reached_[i], 1);
  // The box lies behind now.
  ComputeReward(*task_);
  for (std::size_t i = 0; i < kCount; ++i) EXPECT_EQ(reached_[i], 0);
}

TEST_P(TrackingTest, WhereATargetIsGivenNothingHasBeenApproachedYet) {
  EnvConfig config = Config();
  config.tracking.distance_weight = 0;
  config.tracking.approach_weight = 1;
  const std::unique_ptr<Task> task = MakeTask(config);
  FlightStart start;
  start.north_ft = 30000;
  start.east_ft = -50000;
  start.altitude_ft = 20000;
  for (int i = 0; i < kCount; ++i) {
    simd::RandomStream random(
        {1, static_cast<std::uint32_t>(i), 0, 0, simd::RandomPurpose::kTarget});
    task->Reset(start, &random, targets_.tile(), i);
    SetPosition(i, {start.north_ft, start.east_ft, start.altitude_ft});
  }
  ComputeReward(*task);
  for (std::size_t i = 0; i < kCount; ++i) {
    EXPECT_EQ(reward_[i], 0) << i;
    EXPECT_EQ(reached_[i], 0) << i;
  }
}

TEST_P(TrackingTest, TolerancesAreDrawnByEpisodeForTraining) {
  EnvConfig config = Config();
  config.tracking.position_tolerance_ft = 20;
  config.tracking.training_tolerance_max = 50;
  const std::unique_ptr<Task> training = MakeTask(config);
  double least = 1e9, most = 0, mean_logarithm = 0;
  constexpr int kEpisodes = 2000;
  for (std::uint32_t episode = 0; episode < kEpisodes; ++episode) {
    simd::RandomStream random({5, 0, episode, 0, simd::RandomPurpose::kTarget});
    training->Reset({20000, 1000, 0.1, 0.2}, &random, targets_.tile(), 0);
    const double tolerance = targets_.at(kTrackingTolerance, 0);
    least = std::min(least, tolerance);
    most = std::max(most, tolerance);
    mean_logarithm += std::log(tolerance / 20) / kEpisodes;
  }
  EXPECT_GE(least, 20);
  EXPECT_LT(least, 20.5);
  EXPECT_LE(most, 1000 * (1 + kEnds));
  EXPECT_GT(most, 980);
  EXPECT_NEAR(mean_logarithm, std::log(50) / 2,
              kStandardErrors * std::log(50) / std::sqrt(12.0 * kEpisodes));

  simd::RandomStream random({5, 0, 0, 0, simd::RandomPurpose::kTarget});
  MakeTask(EvaluationConfig(config))->Reset({20000, 1000, 0.1, 0.2}, &random, targets_.tile(), 0);
  EXPECT_EQ(targets_.at(kTrackingTolerance, 0), 20);
}

TEST_P(TrackingTest, ToleranceIsTheEpisodes) {
  for (const int i : {0, 1}) {
    Pass(i, {-30, i == 0 ? 9.0 : 11.0, 0}, {30, i == 0 ? 9.0 : 11.0, 0});
    targets_.at(kTrackingTolerance, i) = 10;
  }
  ComputeReward(*task_);
  EXPECT_EQ(reached_[0], 1);
  EXPECT_EQ(reached_[1], 0);
}

TEST_P(TrackingTest, AStateThatIsNotFiniteIsNotReached) {
  for (const int column : {kNorth, kEast, kDown}) {
    Pass(0, {0, 0, 0}, {1, 1, 1});
    flight_.at(column, 0) = std::nanf("");
    ComputeReward(*task_);
    EXPECT_EQ(reached_[0], 0) << column;
  }
}

TEST_P(TrackingTest, TargetsLieWithinTheirAnglesOfTheNose) {
  const FlightStart start{19500, 1100, 0.05, 2.9};
  double least[3] = {1e9, 1e9, 1e9}, most[3] = {-1e9, -1e9, -1e9};
  for (std::uint32_t episode = 0; episode < 2000; ++episode) {
    simd::RandomStream random({5, 0, episode, 0, simd::RandomPurpose::kTarget});
    TestTile target(1, kNumTrackingColumns);
    task_->Reset(start, &random, target.tile(), 0);
    const double north = target.at(kTrackingNorth, 0), east = target.at(kTrackingEast, 0);
    const double up = target.at(kTrackingAltitude, 0) - start.altitude_ft;
    const double level = std::hypot(north, east);
    const double drawn[3] = {
        std::hypot(level, up),
        kDegPerRad * std::remainder(std::atan2(east, north) - start.yaw_rad, 2 * M_PI),
        kDegPerRad * (std::atan2(up, level) - start.pitch_rad)};
    for (int k = 0; k < 3; ++k) {
      least[k] = Smaller(least[k], drawn[k]);
      most[k] = Larger(most[k], drawn[k]);
    }
    // The first path begins at the start.
    EXPECT_EQ(target.at(kTrackingLastNorth, 0), 0);
    EXPECT_EQ(target.at(kTrackingLastEast, 0), 0);
    EXPECT_EQ(target.at(kTrackingLastAltitude, 0), 19500);
  }
  const double low[3] = {10000, -30, -30}, high[3] = {30000, 30, 30};
  for (int k = 0; k < 3; ++k) {
    const double width = high[k] - low[k];
    EXPECT_GE(least[k], low[k] - kEnds * width);
    EXPECT_LE(most[k], high[k] + kEnds * width);
    EXPECT_LT(least[k], low[k] + 0.01 * width);
    EXPECT_GT(most[k], high[k] - 0.01 * width);
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, TrackingTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

}  // namespace
}  // namespace skein
