// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <complex>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "src/plot/root_locus_picture.h"
#include "tests/src/plot/legible.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pair;

constexpr double kWidth = 500;

/// A flight with one mode, which oscillatory at 1 rad/s.
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
  for (const Words& words : WordsIn(picture)) text += words.text + "\n";
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

TEST(RootLocus, BothPanelsSayWhatTheyAndTheirAxesShow) {
  const Picture picture = DrawRootLocus({FlightAt(5000, 400)}, kWidth, "");
  EXPECT_THAT(NamesOfLeftAxes(picture),
              ElementsAre("imaginary part, rad/s", "imaginary part, rad/s"));
  std::vector<std::string> heads;
  for (const Words& words : WordsIn(picture)) {
    if (words.is_bold) heads.push_back(words.text);
  }
  EXPECT_THAT(heads, ElementsAre("all modes", "phugoid and spiral, enlarged"));
  ExpectLegible(picture);
}

FlightMode ModeOf(const std::string& name, ModeFamily family, std::complex<double> eigenvalue) {
  FlightMode mode;
  mode.name = name;
  mode.family = family;
  mode.eigenvalue = eigenvalue;
  return mode;
}

/// Dots of the modes, the legend's left out: in the first panel, and in the second's half.
struct ModeDots {
  std::vector<PagePoint> all, enlarged;
};
ModeDots DotsOfModes(const Picture& picture) {
  ModeDots dots;
  for (std::size_t k = 0; k + 1 < picture.shapes.size(); ++k) {
    const auto* const disc = std::get_if<Disc>(&picture.shapes[k]);
    const bool is_sample = std::holds_alternative<Words>(picture.shapes[k + 1]);
    if (disc == nullptr || is_sample) continue;
    (disc->middle.x > kWidth / 2 ? dots.enlarged : dots.all).push_back(disc->middle);
  }
  return dots;
}

/// Where the first panel's left (kEnd) or lower (kMiddle) axis says `number`.
PagePoint PlaceOfNumber(const Picture& picture, Anchor anchor, const std::string& number) {
  for (const Words& words : WordsIn(picture)) {
    if (words.anchor == anchor && words.text == number) return words.at;
  }
  ADD_FAILURE() << "no axis says " << number;
  return {};
}

constexpr Tolerance kPoints{1e-9, "float64 rounding of places, points"};

/// Both parts of eigenvalues that any of the panels shows.
void ExpectInProportion(const std::vector<PagePoint>& dots,
                        const std::vector<std::complex<double>>& eigenvalues) {
  ASSERT_EQ(dots.size(), eigenvalues.size());
  ASSERT_GE(dots.size(), 2u);
  const std::complex<double> whole = eigenvalues[1] - eigenvalues[0];
  const double right = (dots[1].x - dots[0].x) / whole.real();
  const double down = (dots[1].y - dots[0].y) / whole.imag();
  EXPECT_GT(right, 0) << "real parts grow to the right";
  EXPECT_LT(down, 0) << "imaginary parts grow upwards";
  for (std::size_t k = 2; k < dots.size(); ++k) {
    const std::complex<double> part = eigenvalues[k] - eigenvalues[0];
    EXPECT_NEAR(dots[k].x - dots[0].x, right * part.real(), kPoints) << k;
    EXPECT_NEAR(dots[k].y - dots[0].y, down * part.imag(), kPoints) << k;
  }
}

TEST(RootLocus, DotsLieAtTheirEigenvalues) {
  LinearisedFlight flight = FlightAt(5000, 400);
  flight.modes = {ModeOf("phugoid", ModeFamily::kPhugoid, {-0.02, 0.2}),
                  ModeOf("roll-spiral", ModeFamily::kSpiral, {0.1, 0.4}),
                  ModeOf("spiral", ModeFamily::kSpiral, 0),
                  ModeOf("short period", ModeFamily::kShortPeriod, {-1, 2}),
                  ModeOf("roll", ModeFamily::kRoll, -3)};
  std::vector<std::complex<double>> eigenvalues;
  for (const FlightMode& mode : flight.modes) eigenvalues.push_back(mode.eigenvalue);
  const Picture picture = DrawRootLocus({flight}, kWidth, "");
  const ModeDots dots = DotsOfModes(picture);
  ASSERT_EQ(dots.all.size(), flight.modes.size());
  ExpectInProportion(dots.all, eigenvalues);
  ExpectInProportion(dots.enlarged, {eigenvalues.begin(), eigenvalues.begin() + 3});

  // And as the axes' numbers say, of which those at the left stand below their heights.
  const PagePoint &spiral = dots.all[2], &short_period = dots.all[3], &roll = dots.all[4];
  EXPECT_NEAR(spiral.x, PlaceOfNumber(picture, Anchor::kMiddle, "0").x, kPoints);
  EXPECT_NEAR(short_period.x, PlaceOfNumber(picture, Anchor::kMiddle, "-1").x, kPoints);
  EXPECT_NEAR(roll.x, PlaceOfNumber(picture, Anchor::kMiddle, "-3").x, kPoints);
  const double below = PlaceOfNumber(picture, Anchor::kEnd, "0").y - spiral.y;
  EXPECT_GE(below, 0);
  EXPECT_LT(below, kSmallSize);
  EXPECT_NEAR(PlaceOfNumber(picture, Anchor::kEnd, "2").y - short_period.y, below, kPoints);
}

/// The colours of the legend, by what stands beside them.
std::map<std::string, Colour> ColoursOf(const std::vector<FlightMode>& modes) {
  LinearisedFlight flight = FlightAt(5000, 400);
  flight.modes = modes;
  const Picture picture = DrawRootLocus({flight}, kWidth, "");
  std::map<std::string, Colour> colours;
  for (std::size_t k = 0; k + 1 < picture.shapes.size(); ++k) {
    const auto* const disc = std::get_if<Disc>(&picture.shapes[k]);
    const auto* const words = std::get_if<Words>(&picture.shapes[k + 1]);
    if (disc != nullptr && words != nullptr) colours[words->text] = *disc->fill;
  }
  return colours;
}

TEST(RootLocus, EveryModeHasAColourOfItsOwnWhateverIsDrawnBesideIt) {
  std::vector<FlightMode> modes;
  for (const char* name : {"short period", "third oscillatory", "phugoid", "Dutch roll",
                           "roll-spiral", "roll", "spiral"}) {
    modes.push_back(ModeOf(name, ModeFamily::kShortPeriod, {-1, 2}));
  }
  const std::map<std::string, Colour> together = ColoursOf(modes);
  std::set<Colour> colours;
  for (const auto& [name, colour] : together) colours.insert(colour);
  EXPECT_EQ(colours.size(), modes.size());
  for (const FlightMode& mode : modes) {
    EXPECT_THAT(ColoursOf({mode}), ElementsAre(Pair(mode.name, together.at(mode.name))));
    LinearisedFlight flight = FlightAt(5000, 400);
    flight.modes = {mode};
    EXPECT_EQ(Dots(DrawRootLocus({flight}, kWidth, ""), 1)[0].first, together.at(mode.name));
  }
}

TEST(RootLocus, OtherModesDoNotSetTheRangeOfTheEnlargedPanel) {
  LinearisedFlight flight = FlightAt(5000, 400);
  flight.modes = {ModeOf("phugoid", ModeFamily::kPhugoid, {-0.01, 0.1}),
                  ModeOf("spiral", ModeFamily::kSpiral, -0.02)};
  const auto alone = DotsOfModes(DrawRootLocus({flight}, kWidth, "")).enlarged;
  flight.modes.push_back(ModeOf("short period, real", ModeFamily::kShortPeriod, 0.4));
  const auto beside = DotsOfModes(DrawRootLocus({flight}, kWidth, "")).enlarged;
  ASSERT_EQ(alone.size(), 2u);
  ASSERT_EQ(beside.size(), 2u);
  for (std::size_t k = 0; k < alone.size(); ++k) {
    EXPECT_EQ(alone[k].x, beside[k].x);
    EXPECT_EQ(alone[k].y, beside[k].y);
  }
}

}  // namespace
}  // namespace skein
