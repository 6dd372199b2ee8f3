// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <variant>

#include "src/fdm/flying_qualities_report.h"
#include "src/plot/handling_levels_picture.h"
#include "tests/src/plot/legible.h"

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

TEST(HandlingLevels, EveryAltitudeLooksDifferent) {
  constexpr std::size_t kAltitudes = 7;  // one more than there are colours
  std::vector<AssessedFlight> flights;
  for (std::size_t k = 0; k < kAltitudes; ++k) {
    flights.push_back(FlightWith(1));
    flights.back().request.altitude_ft = 1000 * static_cast<double>(k + 1);
  }
  const Picture picture = DrawHandlingLevels(flights, LimitsNamed("IV", "A"), kWidth, "");
  std::set<std::pair<Colour, bool>> looks;
  for (std::size_t k = 1; k < picture.shapes.size(); ++k) {
    const auto* const words = std::get_if<Words>(&picture.shapes[k]);
    if (words == nullptr || words->text.find(",000 ft") == std::string::npos) continue;
    const auto* const disc = std::get_if<Disc>(&picture.shapes[k - 1]);
    looks.emplace(disc != nullptr ? *disc->fill : *std::get<Path>(picture.shapes[k - 1]).fill,
                  disc != nullptr);
  }
  EXPECT_EQ(looks.size(), kAltitudes);
}

}  // namespace
}  // namespace skein
