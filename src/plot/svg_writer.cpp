// SPDX-License-Identifier: Apache-2.0
#include "src/plot/svg_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace skein {
namespace {

constexpr double kHaloPerSize = 0.3;

std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += letter;
    }
  }
  return escaped;
}

std::string Hexadecimal(const std::optional<Colour>& colour) {
  return colour ? fmt::format("#{:06X}", *colour) : "none";
}

/// A number of tenths without what SVG does not need.
std::string Tenths(long count) {
  const char* const sign = count < 0 ? "-" : "";
  const long size = std::labs(count);
  return size % 10 == 0 ? fmt::format("{}{}", sign, size / 10)
                        : fmt::format("{}{}.{}", sign, size / 10, size % 10);
}

std::string Place(double value) { return Tenths(std::lround(10 * value)); }

/// A path by its steps, which takes half as many letters as a list of places. What is rounded is
/// the place, so that errors do not add up.
std::string PathData(const Path& path) {
  std::string data;
  long x = 0, y = 0;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const long to_x = std::lround(10 * path.points[i].x), to_y = std::lround(10 * path.points[i].y);
    data += (i == 0 ? "M" : i == 1 ? "l" : " ") + Tenths(to_x - x) + " " + Tenths(to_y - y);
    x = to_x;
    y = to_y;
  }
  return data + (path.is_closed ? "z" : "");
}

std::string StrokeOf(const std::optional<Colour>& stroke, double width) {
  return stroke ? fmt::format(" stroke=\"{}\" stroke-width=\"{:g}\"", Hexadecimal(stroke), width)
                : "";
}

struct ShapeWriter {
  std::string* text;

  void operator()(const Path& path) const {
    if (path.points.empty()) return;
    const auto out = std::back_inserter(*text);
    fmt::format_to(out, "<path fill=\"{}\"{}", Hexadecimal(path.fill),
                   StrokeOf(path.stroke, path.width));
    if (path.dash == Dash::kDashed) *text += " stroke-dasharray=\"4.5 3\"";
    if (path.dash == Dash::kShort) *text += " stroke-dasharray=\"1.5 2\"";
    if (path.opacity < 1) fmt::format_to(out, " opacity=\"{:g}\"", path.opacity);
    fmt::format_to(out, " d=\"{}\"/>\n", PathData(path));
  }

  void operator()(const Disc& disc) const {
    fmt::format_to(std::back_inserter(*text),
                   "<circle cx=\"{}\" cy=\"{}\" r=\"{:g}\" fill=\"{}\"{}/>\n", Place(disc.middle.x),
                   Place(disc.middle.y), disc.radius, Hexadecimal(disc.fill),
                   StrokeOf(disc.stroke, disc.width));
  }

  void operator()(const Words& words) const {
    const auto out = std::back_inserter(*text);
    fmt::format_to(out, "<text x=\"{}\" y=\"{}\" font-size=\"{:g}\" fill=\"{}\"", Place(words.at.x),
                   Place(words.at.y), words.size, Hexadecimal(words.colour));
    if (words.anchor == Anchor::kMiddle) *text += " text-anchor=\"middle\"";
    if (words.anchor == Anchor::kEnd) *text += " text-anchor=\"end\"";
    if (words.is_bold) *text += " font-weight=\"bold\"";
    if (words.runs_upwards) {
      fmt::format_to(out, " transform=\"rotate(-90 {} {})\"", Place(words.at.x), Place(words.at.y));
    }
    if (words.has_halo) {
      fmt::format_to(out, " stroke=\"#FFFFFF\" stroke-width=\"{:g}\" paint-order=\"stroke\"",
                     kHaloPerSize * words.size);
    }
    fmt::format_to(out, ">{}</text>\n", Escaped(words.text));
  }
};

}  // namespace

std::string SvgFile(const Picture& picture) {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}pt\" "
      "height=\"{1}pt\" role=\"img\" font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu "
      "Sans', sans-serif\" stroke-linejoin=\"round\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#FFFFFF\"/>\n",
      Place(picture.width), Place(picture.height), Escaped(picture.title));
  for (const Shape& shape : picture.shapes) std::visit(ShapeWriter{&text}, shape);
  return text + "</svg>\n";
}

}  // namespace skein
