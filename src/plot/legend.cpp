// SPDX-License-Identifier: Apache-2.0
#include "src/plot/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "src/plot/axes.h"

namespace skein {
namespace {

constexpr double kAfterSample = 5, kAfterEntry = 14, kLineHeight = 13;

}  // namespace

Sample LineSample(Colour colour, double width, Dash dash) {
  return [=](PagePoint left, std::vector<Shape>* shapes) {
    shapes->emplace_back(Line({left, {left.x + kSampleWidth, left.y}}, colour, width, dash));
  };
}

Sample BandSample(Colour colour, double opacity) {
  return [=](PagePoint left, std::vector<Shape>* shapes) {
    const double right = left.x + kSampleWidth, top = left.y - 4, bottom = left.y + 4;
    shapes->emplace_back(
        Area({{left.x, top}, {right, top}, {right, bottom}, {left.x, bottom}}, colour, opacity));
  };
}

Sample MarkerSample(Marker marker, const Disc& look) {
  return [=](PagePoint left, std::vector<Shape>* shapes) {
    shapes->push_back(MarkerAt({left.x + kSampleWidth / 2, left.y}, marker, look));
  };
}

LegendEntry PaleIsSlow(const Range& true_airspeed_fps, double radius, double pale) {
  const auto sample = [radius, pale](PagePoint left, std::vector<Shape>* shapes) {
    const Colour slow = Mixed(kInk, kWhite, pale);
    shapes->emplace_back(Disc{{left.x + 5, left.y}, radius, slow, std::nullopt});
    shapes->emplace_back(Disc{{left.x + 15, left.y}, radius, kInk, std::nullopt});
  };
  return {sample, fmt::format("pale: {} ft/s, dark: {} ft/s", TickText(true_airspeed_fps.min),
                              TickText(true_airspeed_fps.max))};
}

std::vector<bool> AreTwice(const std::vector<std::string>& names) {
  std::map<std::string, int> count;
  for (const std::string& name : names) ++count[name];
  std::vector<bool> are_twice;
  for (const std::string& name : names) are_twice.push_back(count[name] > 1);
  return are_twice;
}

double DrawLegend(PagePoint at, double right, const std::vector<LegendEntry>& entries,
                  std::vector<Shape>* shapes) {
  double x = at.x, y = at.y;
  for (const LegendEntry& entry : entries) {
    const double before = kSampleWidth + kAfterSample;
    if (x > at.x && x + before + TextWidth(entry.words) > right) {
      x = at.x;
      y += kLineHeight;
    }
    entry.sample({x, y - 0.35 * kTextSize}, shapes);
    const std::vector<std::string> lines =
        Wrapped(entry.words, std::max(right - x - before, 1.0), kTextSize);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      if (k > 0) y += kLineHeight;
      shapes->emplace_back(Words{{x + before, y}, lines[k]});
    }
    x += before + TextWidth(entry.words) + kAfterEntry;
  }
  return y;
}

double DrawTitle(const std::string& title, double width, std::vector<Shape>* shapes) {
  double y = kMargin;
  for (const std::string& line : Wrapped(title, width - 2 * kMargin, kTitleSize)) {
    y += 1.3 * kTitleSize;
    Words words{{kMargin, y - 0.3 * kTitleSize}, line, kTitleSize};
    words.is_bold = true;
    shapes->emplace_back(std::move(words));
  }
  return title.empty() ? y : y + 4;
}

Picture FinishedPicture(double width, double bottom, const std::string& title,
                        std::vector<Shape> shapes) {
  return {width, std::ceil(bottom + kMargin), title, std::move(shapes)};
}

}  // namespace skein
