// SPDX-License-Identifier: Apache-2.0
#include "src/plot/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "src/files/output_file.h"
#include "src/plot/label_places.h"
#include "src/plot/pdf_module.h"
#include "src/plot/picture_file.h"
#include "src/plot/svg_writer.h"
#include "tests/error_message.h"
#include "tests/scratch_directory.h"

namespace skein {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kTolerated = 0.15;  // points, as Simplified promises

double DistanceToPart(const PagePoint& point, const PagePoint& a, const PagePoint& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double along = std::clamp(((point.x - a.x) * dx + (point.y - a.y) * dy) / square, 0.0, 1.0);
  return std::hypot(point.x - a.x - along * dx, point.y - a.y - along * dy);
}

TEST(Lines, SimplifiedStayNearAllPoints) {
  std::vector<PagePoint> points;
  for (int k = 0; k < 1000; ++k) {
    points.push_back({0.5 * k, 40 * std::sin(0.02 * k) + 3 * std::sin(0.3 * k)});
  }
  const std::vector<PagePoint> kept = Simplified(points);
  EXPECT_LT(kept.size(), points.size() / 2);
  for (const PagePoint& point : points) {
    double nearest = 1e9;
    for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
      nearest = std::min(nearest, DistanceToPart(point, kept[k], kept[k + 1]));
    }
    EXPECT_LE(nearest, kTolerated);
  }
}

TEST(Labels, NeverCoverEachOtherNorLeaveThePaper) {
  LabelPlaces places({0, 0, 400, 400});
  std::vector<PageBox> boxes;
  for (int k = 0; k < 40; ++k) {
    Words words;
    words.text = "12.3 s";
    const std::optional<Words> put = places.PutAround(words, {200, 200.0 + k % 3});
    if (!put) continue;
    const PageBox box = BoxOf(*put);
    for (const PageBox& other : boxes) EXPECT_FALSE(box.Overlaps(other)) << k;
    EXPECT_TRUE(box.left >= 0 && box.right <= 400 && box.top >= 0 && box.bottom <= 400);
    boxes.push_back(box);
  }
  EXPECT_GE(boxes.size(), 8u) << "there is room";
  EXPECT_LT(boxes.size(), 40u) << "and then there is none";
}

TEST(Labels, ThatRunUpwardsTakeUpTheirBoxTurnedToTheLeft) {
  constexpr double kRounding = 1e-12;  // of a few operations in float64 on numbers near 10
  for (const Anchor anchor : {Anchor::kStart, Anchor::kMiddle, Anchor::kEnd}) {
    Words words{{}, "altitude, ft", kTextSize, anchor};
    const PageBox lying = BoxOf(words);
    words.runs_upwards = true;
    const PageBox upwards = BoxOf(words);
    EXPECT_NEAR(upwards.left, lying.top, kRounding);
    EXPECT_NEAR(upwards.right, lying.bottom, kRounding);
    EXPECT_NEAR(upwards.top, -lying.right, kRounding);
    EXPECT_NEAR(upwards.bottom, -lying.left, kRounding);
  }
}

/// One of each shape, with words as they come from files of strangers.
Picture Sample() {
  Picture picture;
  picture.width = 200;
  picture.height = 100;
  picture.title = "a < b & \"c\"";
  picture.shapes.emplace_back(Line({{3.14159, 2.71828}, {10.05, 7.77}, {9, 100.123}}, kInk));
  picture.shapes.emplace_back(Area({{0, 0}, {10, 0}, {0, 10}}, kGrey, 0.5));
  picture.shapes.emplace_back(Disc{{50, 50}, 5, std::nullopt, kInk});
  picture.shapes.emplace_back(Words{{20, 20}, "</text><script>&amp; ±5°\x01\xff"});
  return picture;
}

std::string Written(const std::string& name) {
  const ScratchDirectory scratch;
  WritePicture(scratch / name, Sample());
  return ReadFile(scratch / name);
}

TEST(Svg, HoldsTextAsTextAndNothingElse) {
  const std::string svg = Written("out.svg");
  EXPECT_THAT(svg, HasSubstr("&lt;/text&gt;&lt;script&gt;&amp;amp; ±5° \uFFFD</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("<script")));
  EXPECT_THAT(svg, HasSubstr("<title>a &lt; b &amp; &quot;c&quot;</title>"));
  EXPECT_THAT(svg, HasSubstr("width=\"200pt\" height=\"100pt\""));
  // Steps from rounded place to rounded place: 3.1 2.7, 10.1 7.8, 9 100.1.
  EXPECT_THAT(svg, HasSubstr("d=\"M3.1 2.7l7 5.1 -1.1 92.3\""));
}

TEST(Svg, TurnsWordsThatRunUpwardsAboutTheirPlace) {
  Picture picture = Sample();
  EXPECT_THAT(SvgFile(picture), Not(HasSubstr("rotate")));
  std::get<Words>(picture.shapes.back()).runs_upwards = true;
  EXPECT_THAT(SvgFile(picture), HasSubstr("x=\"20\" y=\"20\""));
  EXPECT_THAT(SvgFile(picture), HasSubstr(" transform=\"rotate(-90 20 20)\""));
}

TEST(Styles, AreThreeTimesAsManyAsColours) {
  constexpr std::size_t kStyles = 3 * kAgentColours.size();
  std::set<std::pair<Colour, Dash>> lines;
  std::set<std::pair<Colour, Marker>> dots;
  for (std::size_t k = 0; k < 2 * kStyles; ++k) {
    const CurveStyle style = StyleOf(k);
    lines.emplace(style.colour, style.dash);
    dots.emplace(style.colour, style.marker);
  }
  EXPECT_EQ(lines.size(), kStyles);
  EXPECT_EQ(dots.size(), kStyles);
}

/// Twice the area that a closed path encloses, by the shoelace formula.
double TwiceTheArea(const std::vector<PagePoint>& corners) {
  double sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const PagePoint &a = corners[k], &b = corners[(k + 1) % corners.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return std::abs(sum);
}

TEST(Markers, AreAsLargeAsDiscs) {
  constexpr double kPi = 3.141592653589793, kNear = 0.03;  // of the area, which the eye is to judge
  for (const Marker marker : {Marker::kSquare, Marker::kTriangle}) {
    const Shape shape = MarkerAt({30, 40}, marker, {{}, 2, kInk, std::nullopt});
    const Path& path = std::get<Path>(shape);
    EXPECT_NEAR(TwiceTheArea(path.points) / (2 * kPi * 4), 1, kNear);
    EXPECT_EQ(path.fill, kInk);
  }
  EXPECT_EQ(std::get<Disc>(MarkerAt({30, 40}, Marker::kDisc, {{}, 2, kInk, {}})).middle.x, 30);
}

TEST(Svg, TheSamePictureIsTheSameFile) { EXPECT_EQ(Written("a.svg"), Written("b.svg")); }

bool HasCairo() {
  return MessageOf([] { LoadPdfModule(); }).empty();
}

TEST(Pdf, HasOnePageOfThePicturesSizeAndNoDate) {
  if (!HasCairo()) GTEST_SKIP() << "built without cairo";
  const std::string pdf = Written("a.pdf");
  EXPECT_EQ(pdf.rfind("%PDF-1.4", 0), 0u);
  EXPECT_THAT(pdf, HasSubstr("/Count 1"));
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 200 100 ]"));
  EXPECT_THAT(pdf, Not(HasSubstr("CreationDate")));
  EXPECT_THAT(pdf, HasSubstr("%%EOF"));
  EXPECT_TRUE(pdf == Written("b.pdf")) << "not the same file";
}

TEST(Pdf, TurnsWordsThatRunUpwards) {
  if (!HasCairo()) GTEST_SKIP() << "built without cairo";
  Picture picture = Sample();
  std::get<Words>(picture.shapes.back()).runs_upwards = true;
  const ScratchDirectory scratch;
  WritePicture(scratch / "upwards.pdf", picture);
  EXPECT_FALSE(ReadFile(scratch / "upwards.pdf") == Written("lying.pdf"));
}

TEST(Pdf, WithoutTheLibraryOneLineSaysWhatToInstall) {
  EXPECT_THAT(MessageOf([] { LoadPdfModule("libskein_nowhere.so"); }),
              AllOf(HasSubstr("libskein_nowhere.so"), HasSubstr("libcairo2-dev"), HasSubstr(".svg"),
                    Not(HasSubstr("\n"))));
  EXPECT_THAT(MessageOf([] { LoadPdfModule("libm.so.6"); }), HasSubstr("no module of Skein"));
}

TEST(PictureFiles, AreToldByTheirEnding) {
  EXPECT_EQ(MessageOf([] { CheckPictureFile("a.svg"); }), "");
  EXPECT_THAT(MessageOf([] { CheckPictureFile("a.png"); }),
              HasSubstr("a.png: let the name end in"));
}

}  // namespace
}  // namespace skein
