// SPDX-License-Identifier: Apache-2.0
#include "src/plot/projection.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <variant>

#include "base/number_text.h"
#include "src/plot/aircraft_glyph.h"
#include "src/plot/ground.h"
#include "tests/src/plot/legible.h"

namespace skein {
namespace {

constexpr double kRounding = 1e-12;  // of a few operations in float64 on numbers near 1

double Length(const View& view, const SpacePoint& step) {
  const PagePoint a = view.Place(SpacePoint::Zero()), b = view.Place(step);
  return std::hypot(b.x - a.x, b.y - a.y);
}

TEST(BodyAxesTest, AreOrthonormalAndNotMirrored) {
  for (const SpacePoint& angles :
       {SpacePoint(0, 0, 0), SpacePoint(60, 20, -130), SpacePoint(-170, -80, 179)}) {
    const BodyAxes axes = BodyAxesOf(angles.x(), angles.y(), angles.z());
    EXPECT_NEAR(axes.forward.norm(), 1, kRounding);
    EXPECT_NEAR(axes.right.norm(), 1, kRounding);
    // North, east, up is left-handed: forward x right points down in it, and up is its negative.
    EXPECT_NEAR((axes.forward.cross(axes.right) - axes.up).norm(), 0, kRounding);
  }
}

TEST(BodyAxesTest, ARightBankLowersTheRightWingAndPitchRaisesTheNose) {
  EXPECT_LT(BodyAxesOf(30, 0, 45).right.z(), 0);
  EXPECT_GT(BodyAxesOf(0, 30, 45).forward.z(), 0);
  EXPECT_GT(BodyAxesOf(0, 0, 90).forward.y(), 0.99) << "yaw 90 is to the east";
}

TEST(ViewTest, KeepsLengthsAcrossAndShowsNothingOfTheLineOfSight) {
  const double azimuth = 30 * M_PI / 180, elevation = 25 * M_PI / 180;
  for (const double vertical_scale : {1.0, 8.0}) {
    const View view(30, 25, vertical_scale);
    const SpacePoint sight(std::cos(elevation) * std::cos(azimuth),
                           std::cos(elevation) * std::sin(azimuth),
                           -std::sin(elevation) / vertical_scale);
    EXPECT_NEAR(Length(view, {-std::sin(azimuth), std::cos(azimuth), 0}), 1, kRounding);
    EXPECT_NEAR(Length(view, sight), 0, kRounding);
    EXPECT_NEAR(view.Nearness(sight), -1, kRounding);
    EXPECT_LT(view.Place({0, 0, 100}).y, view.Place({0, 0, 0}).y) << "up is up";
  }
}

TEST(ViewTest, AVerticalScaleEnlargesHeightsAlone) {
  const View equal(30, 25), stretched(30, 25, 8);
  EXPECT_NEAR(Length(stretched, kUpward), 8 * Length(equal, kUpward), 8 * kRounding);
  for (const SpacePoint& level : {kNorthward, kEastward}) {
    EXPECT_NEAR(Length(stretched, level), Length(equal, level), kRounding);
  }
}

/// An aircraft keeps its shape, heading and bank, and its nose is raised as much as its path.
TEST(AircraftGlyphTest, AVerticalScaleChangesThePitchAngleAlone) {
  constexpr double kScale = 8, kDegree = M_PI / 180, kFar = 100 * kRounding;
  const View equal(30, 25), stretched(30, 25, kScale);
  for (const SpacePoint& angles :
       {SpacePoint(0, 0, 0), SpacePoint(60, 20, -130), SpacePoint(-170, -5, 100)}) {
    const double pitch = std::atan(kScale * std::tan(kDegree * angles.y())) / kDegree;
    const auto drawn = AircraftGlyph(stretched, SpacePoint::Zero(),
                                     BodyAxesOf(angles.x(), angles.y(), angles.z()), kInk, 1);
    const auto wanted = AircraftGlyph(equal, SpacePoint::Zero(),
                                      BodyAxesOf(angles.x(), pitch, angles.z()), kInk, 1);
    ASSERT_EQ(drawn.size(), wanted.size());
    for (std::size_t part = 0; part < drawn.size(); ++part) {
      const Path &a = std::get<Path>(drawn[part]), &b = std::get<Path>(wanted[part]);
      EXPECT_EQ(a.fill, b.fill);
      ASSERT_EQ(a.points.size(), b.points.size());
      for (std::size_t k = 0; k < a.points.size(); ++k) {
        EXPECT_NEAR(a.points[k].x, b.points[k].x, kFar);
        EXPECT_NEAR(a.points[k].y, b.points[k].y, kFar);
      }
    }
  }
}

TEST(ViewTest, FromAboveIsAMap) {
  const View map(0, 90);
  EXPECT_NEAR(map.Place(kNorthward).y, -1, kRounding);
  EXPECT_NEAR(map.Place(kEastward).x, 1, kRounding);
  EXPECT_NEAR(Length(map, kUpward), 0, kRounding);
}

TEST(ViewTest, FitsItsCorners) {
  View view(-40, 20);
  const std::vector<SpacePoint> corners = {{0, 0, 0}, {5000, 0, 0}, {0, 7000, 0}, {100, 200, 9000}};
  const double height = view.Fit(corners, {50, 60}, 800);
  PagePoint low{1e9, 1e9}, high{-1e9, -1e9};
  for (const SpacePoint& corner : corners) {
    const PagePoint place = view.Place(corner);
    low = {std::min(low.x, place.x), std::min(low.y, place.y)};
    high = {std::max(high.x, place.x), std::max(high.y, place.y)};
  }
  constexpr double kPoints = 1e-9;
  EXPECT_NEAR(low.x, 50, kPoints);
  EXPECT_NEAR(high.x, 850, kPoints);
  EXPECT_NEAR(low.y, 60, kPoints);
  EXPECT_NEAR(high.y, 60 + height, kPoints);
}

TEST(GroundTest, LiesUnderAllPoints) {
  const std::vector<SpacePoint> points = {{0, 0, 19000}, {12000, -7000, 23100}};
  const Ground ground(points);
  for (const SpacePoint& point : points) {
    EXPECT_LE(ground.north().min, point.x());
    EXPECT_GE(ground.north().max, point.x());
    EXPECT_LE(ground.east().min, point.y());
    EXPECT_GE(ground.east().max, point.y());
    EXPECT_LT(ground.floor_ft(), point.z());
    EXPECT_GE(ground.ceiling_ft(), point.z());
  }
}

TEST(GroundTest, NumbersDifferHoweverSmallTheGrid) {
  const Ground ground({{15000, 25000, 5000}, {15001, 25001, 5000.5}});
  View view(30, 30);
  view.PutOrigin({0, 0}, 500);
  Picture picture;
  picture.shapes = ground.Draw(view);
  std::vector<std::string> numbers;  // of north, east and altitude, which have none in common
  for (const Words& words : WordsIn(picture)) {
    if (NumberOf(words.text)) numbers.push_back(words.text);
  }
  EXPECT_GE(numbers.size(), 9u);
  EXPECT_EQ(std::set<std::string>(numbers.begin(), numbers.end()).size(), numbers.size());
}

TEST(GroundTest, OfOnePointHasASize) {
  const Ground ground({{0, 0, 20000}});
  EXPECT_GT(ground.north().max, ground.north().min);
  EXPECT_GT(ground.ceiling_ft(), ground.floor_ft());
}

}  // namespace
}  // namespace skein
