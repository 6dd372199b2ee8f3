// SPDX-License-Identifier: Apache-2.0
#include "src/plot/axes.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "base/number_text.h"
#include "envs/aircraft/registry.h"
#include "src/fdm/flight_grid.h"
#include "src/plot/drag_polar_picture.h"
#include "src/plot/flight_grid_picture.h"
#include "tests/src/plot/legible.h"

namespace skein {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;

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

/// The number that letters with separators are.
double NumberIn(std::string letters) {
  letters.erase(std::remove(letters.begin(), letters.end(), ','), letters.end());
  return NumberOf(letters).value_or(std::nan(""));
}

TEST(AxisWords, NumbersOfAnAxisAreItsTicksHoweverSmallTheStep) {
  constexpr double kOfStep = 1e-6;  // that the last digit and rounding in float64 leave
  for (const Range& range : {Range{15000, 15000.5},
                             {14998, 15003},
                             {15, 15.0004},
                             {-1000.3, -999.9},
                             {99990, 100012},
                             {1e8, 1e8 + 10},
                             {0, 1},
                             {-3.2, 17.9}}) {
    const std::vector<double> ticks = Ticks(range, 5);
    const double step = ticks[1] - ticks[0];
    const Panel panel({100, 100}, 100, 100, range, range);
    Picture left, below;
    panel.LabelLeft(ticks, &left.shapes);
    panel.LabelBottom(ticks, &below.shapes);
    for (const Picture& picture : {left, below}) {
      const std::vector<Words> numbers = WordsIn(picture);
      ASSERT_EQ(numbers.size(), ticks.size());
      for (std::size_t k = 0; k < ticks.size(); ++k) {
        EXPECT_NEAR(NumberIn(numbers[k].text), ticks[k], kOfStep * step) << numbers[k].text;
      }
    }
  }
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

/// An area without an edge, or null.
const Path* AreaOf(const Shape& shape) {
  const auto* const path = std::get_if<Path>(&shape);
  return path != nullptr && path->is_closed && path->fill ? path : nullptr;
}

/// The colour of the area before the first of the legend's words with that ending.
Colour ColourBeside(const Picture& picture, const std::string& ending) {
  for (std::size_t k = 1; k < picture.shapes.size(); ++k) {
    const auto* const words = std::get_if<Words>(&picture.shapes[k]);
    const Path* const area = AreaOf(picture.shapes[k - 1]);
    if (words != nullptr && area != nullptr && testing::Matches(EndsWith(ending))(words->text)) {
      return *area->fill;
    }
  }
  ADD_FAILURE() << "no legend of " << ending;
  return kWhite;
}

TEST(FlightGridPictures, CellsLieAtTheirSpeedsAndAltitudesAndLookAsTheLegendSays) {
  const Plant plant(LoadAircraft("f16"), AtmosphereModel::kStevensLewis);
  const FlownGrid flown(plant, {{}, {0, 20000, 40000}, {200, 600, 1000}});
  const Picture picture = DrawFlightGrid(flown, 518, "");
  std::vector<Path> cells;
  for (const Shape& shape : picture.shapes) {
    const Path* const area = AreaOf(shape);
    if (area != nullptr && cells.size() < 9) cells.push_back(*area);
  }
  ASSERT_EQ(cells.size(), 9u);
  double most = 0;
  for (const GridPoint& point : flown.points()) {
    if (point.IsFlown()) most = std::max(most, point.flight->excess_power_ft_s);
  }
  int not_flown = 0;
  for (std::size_t altitude = 0; altitude < 3; ++altitude) {
    for (std::size_t speed = 0; speed < 3; ++speed) {
      SCOPED_TRACE(testing::Message() << "altitude " << altitude << ", speed " << speed);
      const Path& cell = cells[3 * altitude + speed];
      // Corners from the lower left one on.
      const PagePoint &from = cell.points[0], &to = cell.points[2];
      EXPECT_LT(from.x, to.x);
      EXPECT_GT(from.y, to.y);
      if (speed > 0) {
        EXPECT_EQ(from.x, cells[3 * altitude + speed - 1].points[2].x) << "faster is to the right";
      }
      if (altitude > 0) {
        EXPECT_EQ(from.y, cells[3 * altitude - 3 + speed].points[2].y) << "higher is above";
      }
      const GridPoint& point = flown.At(altitude, speed);
      if (!point.IsFlown()) {
        EXPECT_EQ(*cell.fill, ColourBeside(picture, WordsOf(point.limits.front().limit)));
        ++not_flown;
      } else if (point.flight->excess_power_ft_s == most) {
        EXPECT_EQ(*cell.fill, ColourBeside(picture, fmt::format(" to {:.0f} ft/s", most)));
      }
    }
  }
  EXPECT_GT(not_flown, 0);
  EXPECT_LT(not_flown, 9);
}

TEST(FlightGridPictures, PolarsLieAtTheirCoefficients) {
  const Plant plant(LoadAircraft("f16"), AtmosphereModel::kStevensLewis);
  const FlownGrid flown(plant, {{}, {0, 20000}, {400, 500, 600, 800}});
  const Picture picture = DrawDragPolars(flown, 518, "");
  PagePoint origin;  // of no drag and no lift: the panel's corner
  std::vector<Path> curves;
  for (const Shape& shape : picture.shapes) {
    const auto* const path = std::get_if<Path>(&shape);
    if (path == nullptr || path->is_closed) continue;
    const bool is_axes = path->stroke == kGrey && path->points.size() == 3;
    if (is_axes) origin = path->points[1];
    const bool is_curve = path->stroke == ColourOf(curves.size()) && path->points.size() > 1;
    if (is_curve && curves.size() < 2) curves.push_back(*path);
  }
  ASSERT_EQ(curves.size(), 2u);
  // Of the curves' ends, over those of the first one's slow end.
  const SteadyFlight& first = *flown.At(0, 0).flight;
  const PagePoint& place = curves[0].points.front();
  ASSERT_GT(place.x, origin.x) << "drag to the right";
  ASSERT_LT(place.y, origin.y) << "lift upwards";
  for (std::size_t altitude = 0; altitude < 2; ++altitude) {
    for (const std::size_t speed : {std::size_t{0}, std::size_t{3}}) {
      const SteadyFlight& flight = *flown.At(altitude, speed).flight;
      const std::vector<PagePoint>& points = curves[altitude].points;
      const PagePoint& end = speed == 0 ? points.front() : points.back();
      EXPECT_NEAR((end.x - origin.x) / (place.x - origin.x),
                  flight.drag_coefficient() / first.drag_coefficient(), kRounding);
      EXPECT_NEAR((end.y - origin.y) / (place.y - origin.y),
                  flight.lift_coefficient() / first.lift_coefficient(), kRounding);
    }
  }
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
