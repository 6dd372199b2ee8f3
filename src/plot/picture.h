// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace skein {

/// A place on the paper: points (1/72 inch) to the right and down from the upper left corner.
struct PagePoint {
  double x = 0, y = 0;
};

using Colour = std::uint32_t;  ///< 0xRRGGBB

/// As many as differ clearly for protanopes and deuteranopes, too: those of the viewer
/// (viewer/src/palette.ts), of which tests/palette.test.ts there says by how much.
inline constexpr std::array<Colour, 4> kAgentColours = {0x0072B2, 0xD55E00, 0x009E73, 0x59124A};
inline constexpr Colour kInk = 0x222222, kGrey = 0x666666, kGridGrey = 0xDDDDDD, kWhite = 0xFFFFFF;

/// The colour of the agent or setting of that number; after the last the first again.
inline Colour ColourOf(std::size_t index) { return kAgentColours[index % kAgentColours.size()]; }
/// Between two colours, `share` of the second.
Colour Mixed(Colour colour, Colour other, double share);

enum class Dash { kNone, kDashed, kShort };
enum class Marker { kDisc, kSquare, kTriangle };
inline constexpr std::array<Marker, 3> kMarkers = {Marker::kDisc, Marker::kSquare,
                                                   Marker::kTriangle};

/// How the curve or the dots of an agent or setting look.
struct CurveStyle {
  Colour colour = kInk;
  Dash dash = Dash::kNone;        ///< of a line
  Marker marker = Marker::kDisc;  ///< of dots
};

/// By number: all colours whole and as discs, then dashed and as squares, then dotted and as
/// triangles, then as at first again.
CurveStyle StyleOf(std::size_t number);

/// A line through points, or the area that it encloses.
struct Path {
  std::vector<PagePoint> points;
  std::optional<Colour> fill, stroke;
  double width = 1;  ///< of the stroke, points
  bool is_closed = false;
  Dash dash = Dash::kNone;
  double opacity = 1;
};

struct Disc {
  PagePoint middle;
  double radius = 1;
  std::optional<Colour> fill, stroke;
  double width = 1;
};

enum class Anchor { kStart, kMiddle, kEnd };

/// One line of text at its base line, along which its anchor lies.
struct Words {
  PagePoint at;
  std::string text;
  double size = 8;  ///< points
  Anchor anchor = Anchor::kStart;
  Colour colour = kInk;
  bool is_bold = false;
  bool has_halo = false;      ///< white around the letters keeps them legible on lines
  bool runs_upwards = false;  ///< turned by a quarter to the left about `at`, as beside an axis
};

using Shape = std::variant<Path, Disc, Words>;

/// What is drawn, in order, on white.
struct Picture {
  double width = 0, height = 0;  ///< points
  std::string title;             ///< for readers of screens and lists of files
  std::vector<Shape> shapes;
};

inline constexpr double kTextSize = 8, kSmallSize = 7.2, kTitleSize = 10;

Path Line(std::vector<PagePoint> points, Colour colour, double width = 1, Dash dash = Dash::kNone);
Path Area(std::vector<PagePoint> corners, Colour fill, double opacity = 1);
/// A dot of about the area of a disc of that radius, of what `look` says but its place.
Shape MarkerAt(PagePoint middle, Marker marker, const Disc& look);

/// As wide as letters are at most in the common sans-serif fonts, as nobody knows the reader's.
double TextWidth(const std::string& text, double size = kTextSize);
/// `text` in lines of at most `width`, cut at blanks.
std::vector<std::string> Wrapped(const std::string& text, double width, double size);

/// The points that a line needs to stay within 0.15 points of all of them (Douglas and Peucker).
std::vector<PagePoint> Simplified(const std::vector<PagePoint>& points);

}  // namespace skein
