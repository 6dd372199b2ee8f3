// SPDX-License-Identifier: Apache-2.0
#include "src/plot/axes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "envs/aircraft/registry.h"
#include "src/fdm/flight_grid.h"
#include "src/plot/drag_polar_picture.h"
#include "src/plot/flight_grid_picture.h"
#include "tests/src/plot/legible.h"

namespace skein {
namespace {

using ::testing::ElementsAre;

constexpr double kRounding = 1e-9;  // of a few operations in float64, relative

TEST(Ticks, AreRoundAndEvenAndWithinTheRange) {
  for (const Range& range : {Range{0, 1}, {-3.2, 17.9}, {19000, 23456}, {0, 1e8}, {1e-4, 3e-4}}) {
    const std::vector<double> ticks = Ticks(range, 5);
    ASSERT_GE(ticks.size(), 2u);
    EXPECT_LE(ticks.size(), 7u);
    const double slack = kRounding * std::abs(range.max);
    EXPECT_GE(ticks.front(), range.min - slack);
    EXPECT_LE(ticks.back(), range.max + slack);
    const double step = ticks[1] - ticks[0];
    const double digit = step / std::pow(10.0, std::floor(std::log10(step * (1 + kRounding))));
    EXPECT_TRUE(std::abs(digit - 1) < kRounding || std::abs(digit - 2) < 10 * kRounding ||
                std::abs(digit - 5) < 10 * kRounding)
        << step;
    for (std::size_t k = 0; k + 1 < ticks.size(); ++k) {
      EXPECT_NEAR(ticks[k + 1] - ticks[k], step, kRounding * std::abs(ticks.back()));
    }
  }
}

TEST(Ticks, AreAScaleHoweverFewHaveRoom) {
  for (const Range& range : {Range{19.6, 24.4}, {0.7, 3.9}, {-0.4, 0.9}, {451, 549}, {0, 9.99}}) {
    for (const double count : {0.3, 1.0, 2.0, 3.0, 4.0}) {
      const std::vector<double> ticks = Ticks(range, count);
      EXPECT_GE(ticks.size(), 2u) << range.min << " with " << count;
      EXPECT_LE(ticks.size(), 12u) << range.min << " with " << count;
    }
  }
}

TEST(Ticks, OfNothingAreStillFinite) {
  for (const double tick : Ticks({5, 5}, 4)) EXPECT_TRUE(std::isfinite(tick));
  EXPECT_TRUE(std::isfinite(Padded({}).max));
  EXPECT_LT(Padded({7, 7}).min, 7);
}

TEST(Ticks, OfNumbersThatBarelyDifferAreFew) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  constexpr double kMost = std::numeric_limits<double>::max();
  for (const Range& range : {Range{1e20, 1e20}, {1e17, 1e17 + 16}, {0, kLeast}, {-kMost, kMost}}) {
    const std::vector<double> ticks = Ticks(range, 5);
    EXPECT_LE(ticks.size(), 7u) << range.min;
    for (const double tick : ticks) EXPECT_TRUE(std::isfinite(tick)) << range.min;
  }
}

TEST(AxisWords, HaveUnits) {
  EXPECT_EQ(InWords("true_airspeed_fps"), "true airspeed, ft/s");
  EXPECT_EQ(InWords("p_deg_s"), "p, deg/s");
  EXPECT_EQ(InWords("load_factor_g"), "load factor, g");
  EXPECT_EQ(InWords("mach"), "mach");
  EXPECT_EQ(InWords("evaluation_success_rate"), "evaluation success rate, %");
  EXPECT_EQ(InWords("learning_rate"), "learning rate");
}

TEST(AxisWords, NumbersHaveSeparators) {
  EXPECT_EQ(TickText(12500), "12,500");
  EXPECT_EQ(TickText(-1250), "-1,250");
  EXPECT_EQ(TickText(-0.02), "-0.02");
  EXPECT_EQ(TickText(100), "100");
}

TEST(Panels, HaveNamesBesideTheirNumbersAndAHeadAbove) {
  const Panel panel({kLeftOfPanel, kAbovePanel}, 200, 100, {0, 2}, {-10000, 30000});
  Picture picture{kLeftOfPanel + 210, kAbovePanel + 130, "", {}};
  panel.LabelLeft(Ticks(panel.y_range(), 4), &picture.shapes);
  panel.LabelBottom(Ticks(panel.x_range(), 4), &picture.shapes);
  panel.NameLeft("altitude, ft", &picture.shapes);
  panel.NameBottom("time, s", &picture.shapes);
  panel.DrawHead("climb", &picture.shapes);
  ExpectLegible(picture);
  ASSERT_THAT(NamesOfLeftAxes(picture), ElementsAre("altitude, ft"));
  for (const Words& words : WordsIn(picture)) {
    const PageBox box = BoxOf(words);
    if (words.runs_upwards) {
      EXPECT_LT(box.right, panel.left());
      EXPECT_NEAR(box.top - panel.top(), panel.bottom() - box.bottom, 200 * kRounding);
    }
    if (words.text == "time, s") {
      EXPECT_GT(box.top, panel.bottom());
    }
    if (words.text == "climb") {
      EXPECT_LT(box.bottom, panel.top());
    }
  }
}

TEST(FlightGridPictures, NameBothAxes) {
  constexpr double kWidth = 518;
  const Plant plant(LoadAircraft("f16"), AtmosphereModel::kStevensLewis);
  const FlownGrid flown(plant, {{}, {0, 20000}, {400, 600}});
  const Picture grid = DrawFlightGrid(flown, kWidth, "");
  const Picture polars = DrawDragPolars(flown, kWidth, "");
  EXPECT_THAT(NamesOfLeftAxes(grid), ElementsAre("altitude, ft"));
  EXPECT_THAT(NamesOfLeftAxes(polars), ElementsAre("lift coefficient"));
  for (const Picture& picture : {grid, polars}) ExpectLegible(picture);
}

TEST(Panels, PlaceTheirCorners) {
  const Panel panel({10, 20}, 100, 50, {0, 2}, {-1, 1});
  EXPECT_EQ(panel.Place(0, -1).x, 10);
  EXPECT_EQ(panel.Place(0, -1).y, 70);
  EXPECT_EQ(panel.Place(2, 1).x, 110);
  EXPECT_EQ(panel.Place(2, 1).y, 20);
}

}  // namespace
}  // namespace skein
