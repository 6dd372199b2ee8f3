// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "src/fdm/flying_qualities_report.h"
#include "src/plot/handling_levels_picture.h"
#include "tests/src/plot/legible.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kWidth = 500;

/// A flight at 15000 ft with n/alpha of 8 g/rad.
AssessedFlight FlightWith(double mismatch) {
  AssessedFlight flight;
  flight.request.altitude_ft = 15000;
  flight.request.true_airspeed_ft_s = 500;
  flight.qualities.short_period = {2, 0.7, 0.05, mismatch};
  flight.qualities.load_factor_by_alpha = 8;
  flight.qualities.requirements.push_back(
      {"3.2.2.1.2", "short-period damping", "1", 0.7, 1, "", mismatch > kMostMismatch});
  for (const auto& [where, name] : kLoopBreaks) flight.qualities.loops.push_back({where, {}});
  return flight;
}

/// Boundaries of levels, in ink, that run straight upwards.
std::size_t Columns(const LevelLimits& limits) {
  const std::vector<AssessedFlight> flights = {FlightWith(1)};
  const Picture picture = DrawHandlingLevels(flights, limits, kWidth, "");
  return static_cast<std::size_t>(
      std::count_if(picture.shapes.begin(), picture.shapes.end(), [](const Shape& shape) {
        const auto* const path = std::get_if<Path>(&shape);
        return path != nullptr && path->stroke == kInk && path->points.size() == 2 &&
               path->points[0].x == path->points[1].x && path->points[0].y != path->points[1].y;
      }));
}

TEST(HandlingLevels, EveryLeastLoadFactorByAlphaIsDrawn) {
  const LevelLimits landing = LimitsNamed("IV", "C");
  const auto& least = landing.load_factor_by_alpha_min;
  const auto wanted = static_cast<std::size_t>(
      std::count_if(least.begin(), least.end(), [](double limit) { return limit > 0; }));
  ASSERT_GT(wanted, 0u);
  EXPECT_EQ(Columns(landing), wanted);
  EXPECT_EQ(Columns(LimitsNamed("IV", "A")), 0u) << "which asks for none";
}

constexpr Dash kDashes[] = {Dash::kNone, Dash::kDashed, Dash::kShort};  // of levels 1 to 3
constexpr Tolerance kPoints{1e-9, "float64 rounding of places, points"};

/// Whether `point` lies on the line between two others.
bool LiesBetween(const PagePoint& begin, const PagePoint& end, const PagePoint& point) {
  const PagePoint along{end.x - begin.x, end.y - begin.y};
  const PagePoint from{point.x - begin.x, point.y - begin.y};
  const double length = std::hypot(along.x, along.y);
  const double beside = (along.x * from.y - along.y * from.x) / length;
  const double share = (along.x * from.x + along.y * from.y) / (length * length);
  return std::abs(beside) <= kPoints && share >= 0 && share <= 1;
}

/// How many boundaries of `level` (from 0) run through all of the points.
std::size_t BoundariesThrough(const Picture& picture, std::size_t level,
                              const std::vector<PagePoint>& points) {
  return static_cast<std::size_t>(
      std::count_if(picture.shapes.begin(), picture.shapes.end(), [&](const Shape& shape) {
        const auto* const path = std::get_if<Path>(&shape);
        return path != nullptr && path->stroke == kInk && path->dash == kDashes[level] &&
               path->points.size() == 2 &&
               std::all_of(points.begin(), points.end(), [&](const PagePoint& point) {
                 return LiesBetween(path->points[0], path->points[1], point);
               });
      }));
}

/// The dots of the flights, panel by panel.
std::vector<PagePoint> DotsIn(const Picture& picture) {
  std::vector<PagePoint> dots;
  for (const Shape& shape : picture.shapes) {
    if (const auto* const disc = std::get_if<Disc>(&shape)) dots.push_back(disc->middle);
  }
  return dots;
}

AssessedFlight FlightOf(double frequency, double load_factor_by_alpha, double damping = 0.7) {
  AssessedFlight flight = FlightWith(1);
  flight.qualities.short_period.frequency_rad_s = frequency;
  flight.qualities.short_period.damping_ratio = damping;
  flight.qualities.load_factor_by_alpha = load_factor_by_alpha;
  return flight;
}

/// Boundaries of `level` through the dots of two flights with different n/alpha in the panel of
/// frequencies.
std::size_t BoundariesThroughBoth(const AssessedFlight& first, const AssessedFlight& second,
                                  const LevelLimits& limits, std::size_t level) {
  const std::vector<AssessedFlight> flights = {first, second};
  const Picture picture = DrawHandlingLevels(flights, limits, kWidth, "");
  const std::vector<PagePoint> dots = DotsIn(picture);
  if (dots.size() < 2) return 0;
  EXPECT_NE(dots[0].x, dots[1].x);
  return BoundariesThrough(picture, level, {dots[0], dots[1]});
}

// MIL-F-8785C, figures 1 to 3: frequency^2 over n/alpha.
TEST(HandlingLevels, FlightsAtALimitOfTheAnticipationLieOnItsBoundary) {
  const LevelLimits limits = LimitsNamed("IV", "A");
  int boundaries = 0;
  for (std::size_t level = 0; level < 3; ++level) {
    for (const LevelLimit& limit : {limits.anticipation_min, limits.anticipation_max}) {
      // What is that of the level before is drawn as its boundary.
      const bool is_new = level == 0 || limit[level] != limit[level - 1];
      if (!is_new || !std::isfinite(limit[level])) continue;
      SCOPED_TRACE(testing::Message() << "level " << level + 1 << ": " << limit[level]);
      const auto at = [&](double load_factor_by_alpha, double share) {
        return FlightOf(std::sqrt(share * limit[level] * load_factor_by_alpha),
                        load_factor_by_alpha);
      };
      EXPECT_EQ(BoundariesThroughBoth(at(8, 1), at(30, 1), limits, level), 1u);
      EXPECT_EQ(BoundariesThroughBoth(at(8, 1.1), at(30, 1.1), limits, level), 0u) << "beside it";
      ++boundaries;
    }
  }
  EXPECT_GE(boundaries, 4);
}

TEST(HandlingLevels, FlightsAtTheLeastFrequencyOrLoadFactorLieOnItsBoundary) {
  const LevelLimits limits = LimitsNamed("IV", "C");
  for (const std::size_t level : {0u, 1u}) {
    SCOPED_TRACE(level + 1);
    const double frequency = limits.short_period_frequency_min[level];
    const double load_factor = limits.load_factor_by_alpha_min[level];
    ASSERT_GT(frequency, 0);
    ASSERT_GT(load_factor, 0);
    EXPECT_EQ(BoundariesThroughBoth(FlightOf(frequency, 3), FlightOf(frequency, 9), limits, level),
              1u);
    const std::vector<AssessedFlight> flights = {FlightOf(1.5, load_factor),
                                                 FlightOf(3, load_factor)};
    const Picture picture = DrawHandlingLevels(flights, limits, kWidth, "");
    const std::vector<PagePoint> dots = DotsIn(picture);
    ASSERT_GE(dots.size(), 2u);
    EXPECT_EQ(BoundariesThrough(picture, level, {dots[0], dots[1]}), 1u);
  }
}

TEST(HandlingLevels, FlightsAtALimitOfTheDampingLieOnItsBoundary) {
  const LevelLimits limits = LimitsNamed("IV", "A");
  for (std::size_t level = 0; level < 3; ++level) {
    for (const LevelLimit& limit :
         {limits.short_period_damping_min, limits.short_period_damping_max}) {
      if (!std::isfinite(limit[level])) continue;
      SCOPED_TRACE(testing::Message() << "level " << level + 1 << ": " << limit[level]);
      const std::vector<AssessedFlight> flights = {FlightOf(2, 8, limit[level])};
      const Picture picture = DrawHandlingLevels(flights, limits, kWidth, "");
      const std::vector<PagePoint> dots = DotsIn(picture);
      ASSERT_GE(dots.size(), 2u);
      EXPECT_EQ(BoundariesThrough(picture, level, {dots[1]}), 1u);
    }
  }
}

std::string AllWords(const Picture& picture) {
  std::string text;
  for (const Words& words : WordsIn(picture)) text += words.text + "\n";
  return text;
}

TEST(HandlingLevels, EveryPanelNamesItsParagraphAndItsAxes) {
  const std::vector<AssessedFlight> flights = {FlightWith(1)};
  const Picture picture = DrawHandlingLevels(flights, LimitsNamed("IV", "A"), kWidth, "");
  std::vector<std::string> heads;
  for (const Words& words : WordsIn(picture)) {
    if (words.is_bold) heads.push_back(words.text);
  }
  EXPECT_THAT(heads, ElementsAre(HasSubstr("MIL-F-8785C, 3.2.2.1.1: frequency"),
                                 HasSubstr("MIL-F-8785C, 3.2.2.1.2: damping"),
                                 HasSubstr("MIL-F-8785C, 3.2.2.1: the worse")));
  EXPECT_THAT(NamesOfLeftAxes(picture), ElementsAre("short-period frequency, rad/s",
                                                    "short-period damping ratio", "altitude, ft"));
  ExpectLegible(picture);
}

TEST(HandlingLevels, AFlightWithoutAnEquivalentSystemIsDoubted) {
  const LevelLimits limits = LimitsNamed("IV", "A");
  for (const bool is_doubtful : {false, true}) {
    const AssessedFlight flight = FlightWith(is_doubtful ? kMostMismatch + 1 : kMostMismatch);
    const std::vector<AssessedFlight> flights = {flight};
    const auto expects = [&](const std::string& text, const std::string& doubt) {
      if (is_doubtful) {
        EXPECT_THAT(text, HasSubstr(doubt));
      } else {
        EXPECT_THAT(text, Not(HasSubstr(doubt)));
      }
    };
    expects(Describe(flight.qualities, ""), "level 1?");
    expects(Describe(flight.qualities, ""), "mismatch above 10");
    expects(DescribeLevels(flights), "1?");
    expects(AllWords(DrawHandlingLevels(flights, limits, kWidth, "")), "mismatch above 10");
  }
}

TEST(HandlingLevels, AnUnstableFlightIsBelowLevelThreeAndHasNoDot) {
  const LevelLimits limits = LimitsNamed("IV", "A");
  AssessedFlight unstable = FlightWith(std::nan(""));
  FlyingQualities& qualities = unstable.qualities;
  qualities.unstable_mode = LinearMode{{5, 34}, {}};
  qualities.short_period.frequency_rad_s = qualities.short_period.damping_ratio = std::nan("");
  qualities.requirements.front().level = 4;
  for (const bool is_alone : {true, false}) {
    std::vector<AssessedFlight> flights = {unstable};
    if (!is_alone) flights.push_back(FlightWith(1));
    const Picture picture = DrawHandlingLevels(flights, limits, kWidth, "");
    EXPECT_THAT(AllWords(picture), HasSubstr("below level 3"));
    EXPECT_THAT(AllWords(picture), Not(HasSubstr("mismatch above")));
    const std::size_t of_legend = 1, of_panels = is_alone ? 0 : 2;
    EXPECT_EQ(DotsIn(picture).size(), of_panels + of_legend);
    ExpectLegible(picture);
  }
}

TEST(HandlingLevels, EveryAltitudeLooksDifferent) {
  constexpr std::size_t kAltitudes = 7;  // one more than there are colours
  std::vector<AssessedFlight> flights;
  for (std::size_t k = 0; k < kAltitudes; ++k) {
    flights.push_back(FlightWith(1));
    flights.back().request.altitude_ft = 1000 * static_cast<double>(k + 1);
  }
  const Picture picture = DrawHandlingLevels(flights, LimitsNamed("IV", "A"), kWidth, "");
  std::set<std::pair<Colour, std::size_t>> looks;  // and corners
  for (std::size_t k = 1; k < picture.shapes.size(); ++k) {
    const auto* const words = std::get_if<Words>(&picture.shapes[k]);
    if (words == nullptr || words->text.find(",000 ft") == std::string::npos) continue;
    const auto* const disc = std::get_if<Disc>(&picture.shapes[k - 1]);
    if (disc != nullptr) {
      looks.emplace(*disc->fill, 0);
    } else {
      const auto& marker = std::get<Path>(picture.shapes[k - 1]);
      looks.emplace(*marker.fill, marker.points.size());
    }
  }
  EXPECT_EQ(looks.size(), kAltitudes);
}

}  // namespace
}  // namespace skein
