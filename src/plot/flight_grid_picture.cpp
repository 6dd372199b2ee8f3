// SPDX-License-Identifier: Apache-2.0
#include "src/plot/flight_grid_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "src/plot/axes.h"
#include "src/plot/legend.h"

namespace skein {
namespace {

constexpr double kHeightPerWidth = 0.55;
constexpr Colour kFlown = 0x0072B2;
constexpr int kShades = 4;

/// By FlightLimit: those that end flight in colours, those that end the model in greys.
constexpr std::array<Colour, 6> kLimitColours = {0xE69F00, 0xCC79A7, 0xBBBBBB,
                                                 0xD55E00, 0x009E73, 0xE4E4E4};

class GridDrawing {
 public:
  GridDrawing(const FlownGrid& flown, double width) : flown_(flown), width_(width) {
    for (const GridPoint& point : flown.points()) {
      if (point.IsFlown()) most_ = std::max(most_, point.flight->excess_power_ft_s);
    }
  }

  Picture Draw(const std::string& title) {
    const double top = DrawTitle(title, width_, &shapes_) + 8;
    const double panel_width = width_ - kLeftOfPanel - kMargin;
    const std::vector<double>& speeds = flown_.grid().speed_fps;
    const std::vector<double>& altitudes = flown_.grid().altitude_ft;
    const Panel panel({kLeftOfPanel, top}, panel_width, kHeightPerWidth * panel_width,
                      {Edge(speeds, 0), Edge(speeds, speeds.size())},
                      {Edge(altitudes, 0), Edge(altitudes, altitudes.size())});
    for (std::size_t i = 0; i < altitudes.size(); ++i) {
      for (std::size_t k = 0; k < speeds.size(); ++k) DrawCell(panel, i, k);
    }
    panel.LabelLeft(TicksUp(panel.y_range(), panel.height()), &shapes_);
    panel.LabelBottom(TicksAcross(panel.x_range(), panel.width()), &shapes_);
    panel.NameLeft("altitude, ft", &shapes_);
    panel.NameBottom("true airspeed, ft/s", &shapes_);
    const double bottom =
        DrawLegend({kLeftOfPanel, panel.bottom() + 40}, width_ - kMargin, Entries(), &shapes_);
    return FinishedPicture(width_, bottom, title.empty() ? "Flight envelope" : title,
                           std::move(shapes_));
  }

 private:
  /// Half way between neighbours; as far beyond the ends.
  static double Edge(const std::vector<double>& values, std::size_t index) {
    if (index == 0) return values[0] - (values[1] - values[0]) / 2;
    const std::size_t last = values.size() - 1;
    if (index > last) return values[last] + (values[last] - values[last - 1]) / 2;
    return (values[index - 1] + values[index]) / 2;
  }

  static Colour Shade(int shade) {
    return Mixed(kFlown, kWhite, 0.8 * (1 - static_cast<double>(shade) / (kShades - 1)));
  }

  int ShadeOf(const GridPoint& point) const {
    const double share = most_ > 0 ? point.flight->excess_power_ft_s / most_ : 0;
    return std::clamp(static_cast<int>(share * kShades), 0, kShades - 1);
  }

  void DrawCell(const Panel& panel, std::size_t altitude, std::size_t speed) {
    const GridPoint& point = flown_.At(altitude, speed);
    const Colour colour = point.IsFlown()
                              ? Shade(ShadeOf(point))
                              : kLimitColours[static_cast<std::size_t>(point.limits.front().limit)];
    const std::vector<double>& speeds = flown_.grid().speed_fps;
    const std::vector<double>& altitudes = flown_.grid().altitude_ft;
    const double left = Edge(speeds, speed), right = Edge(speeds, speed + 1);
    const double low = Edge(altitudes, altitude), high = Edge(altitudes, altitude + 1);
    shapes_.emplace_back(
        Area(panel.Placed({{left, low}, {right, low}, {right, high}, {left, high}}), colour));
  }

  std::vector<LegendEntry> Entries() const {
    std::vector<LegendEntry> entries;
    for (int shade = 0; shade < kShades && most_ > 0; ++shade) {
      entries.push_back({BandSample(Shade(shade), 1),
                         fmt::format("{}{:.0f} to {:.0f} ft/s", shade == 0 ? "climbs " : "",
                                     most_ * shade / kShades, most_ * (shade + 1) / kShades)});
    }
    std::array<bool, kLimitColours.size()> seen{};
    for (const GridPoint& point : flown_.points()) {
      if (point.IsFlown()) continue;
      const FlightLimit limit = point.limits.front().limit;
      const auto index = static_cast<std::size_t>(limit);
      if (std::exchange(seen[index], true)) continue;
      entries.push_back({BandSample(kLimitColours[index], 1), WordsOf(std::optional(limit))});
    }
    return entries;
  }

  const FlownGrid& flown_;
  double width_;
  double most_ = 0;  // excess power, ft/s
  std::vector<Shape> shapes_;
};

}  // namespace

Picture DrawFlightGrid(const FlownGrid& flown, double width, const std::string& title) {
  return GridDrawing(flown, width).Draw(title);
}

}  // namespace skein
