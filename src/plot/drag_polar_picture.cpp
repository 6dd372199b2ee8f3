// SPDX-License-Identifier: Apache-2.0
#include "src/plot/drag_polar_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "src/plot/axes.h"
#include "src/plot/legend.h"

namespace skein {
namespace {

constexpr double kHeightPerWidth = 0.55, kRadius = 2.4;

struct Polar {
  double altitude_ft = 0;
  std::vector<PagePoint> points;  ///< drag and lift coefficient
  std::optional<PagePoint> best;  ///< of them, with the greatest lift over drag
  double best_speed_ft_s = 0;
};

bool IsInBalance(const GridPoint& point) {
  if (!point.flight) return false;
  return std::none_of(point.limits.begin(), point.limits.end(), [](const ExceededLimit& limit) {
    return limit.limit == FlightLimit::kAlphaTables || limit.limit == FlightLimit::kControls;
  });
}

Polar PolarAt(const FlownGrid& flown, std::size_t altitude) {
  Polar polar;
  polar.altitude_ft = flown.grid().altitude_ft[altitude];
  for (std::size_t k = 0; k < flown.grid().speed_fps.size(); ++k) {
    const GridPoint& point = flown.At(altitude, k);
    if (!IsInBalance(point)) continue;
    const PagePoint place{point.flight->drag_coefficient(), point.flight->lift_coefficient()};
    polar.points.push_back(place);
    if (!polar.best || place.y * polar.best->x > polar.best->y * place.x) {
      polar.best = place;
      polar.best_speed_ft_s = flown.grid().speed_fps[k];
    }
  }
  return polar;
}

/// Of values that are mostly positive: room above them, and below zero only what needs it.
Range FromZero(const std::vector<double>& values) {
  const Range padded = Padded(values), span = SpanOf(values);
  return {span.min < 0 ? padded.min : 0, padded.max};
}

}  // namespace

Picture DrawDragPolars(const FlownGrid& flown, double width, const std::string& title) {
  std::vector<Polar> polars;
  std::vector<double> drag = {0}, lift = {0};
  for (std::size_t i = 0; i < flown.grid().altitude_ft.size(); ++i) {
    polars.push_back(PolarAt(flown, i));
    for (const PagePoint& point : polars.back().points) {
      drag.push_back(point.x);
      lift.push_back(point.y);
    }
  }
  std::vector<Shape> shapes;
  const double top = DrawTitle(title, width, &shapes) + 8;
  const double panel_width = width - kLeftOfPanel - kMargin;
  const Panel panel({kLeftOfPanel, top}, panel_width, kHeightPerWidth * panel_width, FromZero(drag),
                    FromZero(lift));
  panel.DrawAxes(&shapes);
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < polars.size(); ++i) {
    const Polar& polar = polars[i];
    const CurveStyle style = StyleOf(i);
    panel.DrawCurve(polar.points, style.colour, 1.2, style.dash, &shapes);
    std::string words = TickText(polar.altitude_ft) + " ft";
    if (polar.best) {
      shapes.push_back(MarkerAt(panel.Place(polar.best->x, polar.best->y), style.marker,
                                {{}, kRadius, style.colour, std::nullopt}));
      words += fmt::format(": lift over drag at most {:.1f}, at {} ft/s",
                           polar.best->y / polar.best->x, ShortestText(polar.best_speed_ft_s));
    }
    entries.push_back({LineSample(style.colour, 1.2, style.dash), words});
  }
  panel.NameLeft("lift coefficient", &shapes);
  panel.NameBottom("drag coefficient", &shapes);
  const double bottom =
      DrawLegend({kLeftOfPanel, panel.bottom() + 40}, width - kMargin, entries, &shapes);
  return FinishedPicture(width, bottom, title.empty() ? "Drag polars" : title, std::move(shapes));
}

}  // namespace skein
