// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "src/plot/root_locus_picture.h"

namespace skein {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kWidth = 500;

/// A flight with one mode, which swings at 1 rad/s.
LinearisedFlight FlightAt(double altitude_ft, double speed_ft_s) {
  LinearisedFlight flight;
  flight.request.altitude_ft = altitude_ft;
  flight.request.true_airspeed_ft_s = speed_ft_s;
  FlightMode mode;
  mode.name = "short period";
  mode.eigenvalue = {-0.6, 0.8};
  flight.modes.push_back(mode);
  return flight;
}

std::string AllWords(const Picture& picture) {
  std::string text;
  for (const Shape& shape : picture.shapes) {
    if (const auto* const words = std::get_if<Words>(&shape)) text += words->text + "\n";
  }
  return text;
}

/// Of the dots of the first panel, in the order of the flights: with corners (0: discs).
std::vector<std::pair<Colour, std::size_t>> Dots(const Picture& picture, std::size_t count) {
  std::vector<std::pair<Colour, std::size_t>> dots;
  for (const Shape& shape : picture.shapes) {
    if (const auto* const disc = std::get_if<Disc>(&shape)) dots.emplace_back(*disc->fill, 0);
    const auto* const path = std::get_if<Path>(&shape);
    if (path != nullptr && path->is_closed) dots.emplace_back(*path->fill, path->points.size());
  }
  dots.resize(count);
  return dots;
}

TEST(RootLocus, ShadesAreThoseOfSpeedsAndMarkersOfAltitudes) {
  const std::vector<LinearisedFlight> flights = {FlightAt(5000, 400), FlightAt(5000, 1000),
                                                 FlightAt(30000, 400), FlightAt(30000, 1000)};
  const Picture picture = DrawRootLocus(flights, kWidth, "");
  const auto dots = Dots(picture, flights.size());
  EXPECT_EQ(dots[0].first, dots[2].first) << "as slow";
  EXPECT_EQ(dots[1].first, dots[3].first) << "as fast";
  EXPECT_EQ(dots[1].first, ColourOf(0)) << "dark is fast";
  EXPECT_NE(dots[0].first, dots[1].first);
  EXPECT_EQ(dots[0].second, dots[1].second) << "of one altitude";
  EXPECT_NE(dots[0].second, dots[2].second);
  for (const char* words : {"pale: 400 ft/s, dark: 1,000 ft/s", "5,000 ft\n", "30,000 ft\n"}) {
    EXPECT_THAT(AllWords(picture), HasSubstr(words));
  }
}

TEST(RootLocus, OneFlightNeedsNoWordsOnShades) {
  EXPECT_THAT(AllWords(DrawRootLocus({FlightAt(5000, 400)}, kWidth, "")), Not(HasSubstr("pale")));
}

}  // namespace
}  // namespace skein
