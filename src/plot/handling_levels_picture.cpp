// SPDX-License-Identifier: Apache-2.0
#include "src/plot/handling_levels_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/number_text.h"
#include "src/plot/axes.h"
#include "src/plot/legend.h"

namespace skein {
namespace {

constexpr double kHeightPerWidth = 0.9, kMapHeightPerWidth = 0.24, kBelowPanel = 40;
constexpr double kRadius = 2.2, kPale = 0.5;
constexpr double kLeastPadding = 0.1;  // decades beyond the outermost figures

/// Of levels 1, 2, 3 and what is below; paler than the colours of altitudes.
constexpr std::array<Colour, 4> kLevelColours = {0xBFE3C8, 0xF6DE8D, 0xE9A08A, 0x8A8A8A};
constexpr std::array<Dash, 3> kLevelDashes = {Dash::kNone, Dash::kDashed, Dash::kShort};

double LoadFactorByAlpha(const AssessedFlight& flight) {
  return flight.qualities.load_factor_by_alpha;
}
double Frequency(const AssessedFlight& flight) {
  return flight.qualities.short_period.frequency_rad_s;
}
double Damping(const AssessedFlight& flight) { return flight.qualities.short_period.damping_ratio; }

/// Whether its equivalent system is too far from it; an unstable flight has none, which is no
/// doubt.
bool IsDoubtful(const AssessedFlight& flight) {
  return flight.qualities.short_period.mismatch > kMostMismatch;
}

/// The worse of what 3.2.2.1 asks of the frequency and of the damping.
int ShortPeriodLevel(const AssessedFlight& flight) {
  int worst = 1;
  for (const Requirement& requirement : flight.qualities.requirements) {
    const bool counts = std::string(requirement.paragraph).rfind("3.2.2.1", 0) == 0;
    if (counts) worst = std::max(worst, requirement.level);
  }
  return worst;
}

Range Decades(const std::vector<double>& values) {
  std::vector<double> logs;
  for (const double value : values) logs.push_back(std::log10(value));
  const Range span = SpanOf(logs);
  return {span.min - kLeastPadding, span.max + kLeastPadding};
}

/// Of a panel of logarithms: 1, 2 and 5 times powers of ten.
std::vector<double> LogTicks(const Range& decades) {
  std::vector<double> ticks;
  for (double power = std::floor(decades.min); power <= decades.max; ++power) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double tick = power + std::log10(digit);
      if (tick >= decades.min && tick <= decades.max) ticks.push_back(tick);
    }
  }
  return ticks;
}

class LevelsDrawing {
 public:
  LevelsDrawing(const std::vector<AssessedFlight>& flights, const LevelLimits& limits, double width)
      : flights_(flights), limits_(limits), width_(width) {
    std::vector<double> speeds;
    for (const AssessedFlight& flight : flights) {
      altitudes_.emplace(flight.request.altitude_ft, CurveStyle());
      speeds.push_back(flight.request.true_airspeed_ft_s);
    }
    speeds_ = SpanOf(speeds);
    std::size_t index = 0;
    for (auto& [altitude, style] : altitudes_) {
      style = StyleOf(index);
      style.marker = kMarkers[index++ % kMarkers.size()];  // as pale colours are alike to some
    }
  }

  Picture Draw(const std::string& title) {
    const double top = DrawTitle(title, width_, &shapes_) + kAbovePanel;
    const double panel_width = (width_ - 2 * kLeftOfPanel - kMargin) / 2;
    DrawFrequencies({kLeftOfPanel, top}, panel_width);
    DrawDamping({2 * kLeftOfPanel + panel_width, top}, panel_width);
    const double middle = top + kHeightPerWidth * panel_width + kBelowPanel;
    const double map_bottom = DrawMap(middle);
    const double bottom =
        DrawLegend({kLeftOfPanel, map_bottom + kBelowPanel}, width_ - kMargin, Entries(), &shapes_);
    return FinishedPicture(width_, bottom, title.empty() ? "Handling levels" : title,
                           std::move(shapes_));
  }

 private:
  Colour ColourAt(const AssessedFlight& flight) const {
    const double width = speeds_.max - speeds_.min;
    const double share = width > 0 ? (flight.request.true_airspeed_ft_s - speeds_.min) / width : 1;
    return Mixed(altitudes_.at(flight.request.altitude_ft).colour, kWhite, kPale * (1 - share));
  }

  void DrawDot(const Panel& panel, double x, double y, const AssessedFlight& flight) {
    const bool is_shown = x >= panel.x_range().min && x <= panel.x_range().max &&
                          y >= panel.y_range().min && y <= panel.y_range().max;
    if (!is_shown) return;
    const Disc look = IsDoubtful(flight) ? Disc{{}, kRadius, kWhite, ColourAt(flight), 0.8}
                                         : Disc{{}, kRadius, ColourAt(flight), kGrey, 0.3};
    shapes_.push_back(
        MarkerAt(panel.Place(x, y), altitudes_.at(flight.request.altitude_ft).marker, look));
  }

  /// frequency = sqrt(anticipation n/alpha), as far as the panel shows it; a line in logarithms.
  void DrawAnticipation(const Panel& panel, double anticipation, Dash dash) {
    const Range &x = panel.x_range(), &y = panel.y_range();
    const double at_zero = 0.5 * std::log10(anticipation);
    const double from = std::max(x.min, 2 * (y.min - at_zero));
    const double to = std::min(x.max, 2 * (y.max - at_zero));
    if (from >= to) return;
    panel.DrawCurve({{from, at_zero + from / 2}, {to, at_zero + to / 2}}, kInk, 0.8, dash,
                    &shapes_);
  }

  /// A boundary upwards, as far as it is in the panel.
  void DrawLevelColumn(const Panel& panel, double across, Dash dash) {
    if (!(across > panel.x_range().min && across < panel.x_range().max)) return;
    panel.DrawCurve({{across, panel.y_range().min}, {across, panel.y_range().max}}, kInk, 0.8, dash,
                    &shapes_);
  }

  /// A boundary at a height, as far as it is in the panel.
  void DrawLevelLine(const Panel& panel, double height, Dash dash) {
    if (!(height > panel.y_range().min && height < panel.y_range().max)) return;
    panel.DrawCurve({{panel.x_range().min, height}, {panel.x_range().max, height}}, kInk, 0.8, dash,
                    &shapes_);
  }

  void DrawFrequencies(PagePoint corner, double width) {
    std::vector<double> across, up;
    for (const AssessedFlight& flight : flights_) {
      across.push_back(LoadFactorByAlpha(flight));
      up.push_back(Frequency(flight));
    }
    for (const double frequency : limits_.short_period_frequency_min) {
      if (frequency > 0) up.push_back(frequency);
    }
    for (const double load_factor : limits_.load_factor_by_alpha_min) {
      if (load_factor > 0) across.push_back(load_factor);
    }
    const Panel panel(corner, width, kHeightPerWidth * width, Decades(across), Decades(up));
    const auto x_ticks = LogTicks(panel.x_range()), y_ticks = LogTicks(panel.y_range());
    panel.DrawGrid(x_ticks, y_ticks, &shapes_);
    for (const double tick : x_ticks) {
      shapes_.emplace_back(Words{{panel.Place(tick, 0).x, panel.bottom() + 10},
                                 TickText(std::pow(10, tick)),
                                 kSmallSize,
                                 Anchor::kMiddle});
    }
    for (const double tick : y_ticks) {
      shapes_.emplace_back(Words{{panel.left() - 3, panel.Place(0, tick).y + 0.35 * kSmallSize},
                                 TickText(std::pow(10, tick)),
                                 kSmallSize,
                                 Anchor::kEnd});
    }
    for (std::size_t level = 0; level < kLevelDashes.size(); ++level) {
      for (const LevelLimit& limit : {limits_.anticipation_min, limits_.anticipation_max}) {
        const bool is_new = level == 0 || limit[level] != limit[level - 1];
        if (is_new && std::isfinite(limit[level])) {
          DrawAnticipation(panel, limit[level], kLevelDashes[level]);
        }
      }
      if (limits_.short_period_frequency_min[level] > 0) {
        DrawLevelLine(panel, std::log10(limits_.short_period_frequency_min[level]),
                      kLevelDashes[level]);
      }
      if (limits_.load_factor_by_alpha_min[level] > 0) {
        DrawLevelColumn(panel, std::log10(limits_.load_factor_by_alpha_min[level]),
                        kLevelDashes[level]);
      }
    }
    panel.DrawHead("MIL-F-8785C, 3.2.2.1.1: frequency against n/alpha", &shapes_);
    panel.NameLeft("short-period frequency, rad/s", &shapes_);
    panel.NameBottom("n/alpha, g/rad", &shapes_);
    for (const AssessedFlight& flight : flights_) {
      DrawDot(panel, std::log10(LoadFactorByAlpha(flight)), std::log10(Frequency(flight)), flight);
    }
  }

  void DrawDamping(PagePoint corner, double width) {
    std::vector<double> across, up = {0};
    for (const AssessedFlight& flight : flights_) {
      across.push_back(flight.request.true_airspeed_ft_s);
      up.push_back(Damping(flight));
    }
    for (const double damping : limits_.short_period_damping_max) up.push_back(damping);
    const Panel panel(corner, width, kHeightPerWidth * width, Padded(across), Padded(up));
    panel.DrawAxes(&shapes_);
    for (std::size_t level = 0; level < kLevelDashes.size(); ++level) {
      DrawLevelLine(panel, limits_.short_period_damping_min[level], kLevelDashes[level]);
      DrawLevelLine(panel, limits_.short_period_damping_max[level], kLevelDashes[level]);
    }
    panel.DrawHead("MIL-F-8785C, 3.2.2.1.2: damping over speed", &shapes_);
    panel.NameLeft("short-period damping ratio", &shapes_);
    panel.NameBottom("true airspeed, ft/s", &shapes_);
    for (const AssessedFlight& flight : flights_) {
      DrawDot(panel, flight.request.true_airspeed_ft_s, Damping(flight), flight);
    }
  }

  /// A mark for every flight in the colour of its level; returns the map's lower edge.
  double DrawMap(double top) {
    constexpr double kHalfWidth = 7, kHalfHeight = 5;
    std::vector<double> across, up;
    for (const AssessedFlight& flight : flights_) {
      across.push_back(flight.request.true_airspeed_ft_s);
      up.push_back(flight.request.altitude_ft);
    }
    const double width = width_ - kLeftOfPanel - kMargin;
    const Panel panel({kLeftOfPanel, top}, width, kMapHeightPerWidth * width, Padded(across),
                      Padded(up));
    panel.DrawAxes(&shapes_);
    panel.DrawHead("MIL-F-8785C, 3.2.2.1: the worse of the levels of frequency and damping",
                   &shapes_);
    panel.NameLeft("altitude, ft", &shapes_);
    panel.NameBottom("true airspeed, ft/s", &shapes_);
    for (const AssessedFlight& flight : flights_) {
      const Colour colour = kLevelColours[static_cast<std::size_t>(ShortPeriodLevel(flight)) - 1];
      const PagePoint at =
          panel.Place(flight.request.true_airspeed_ft_s, flight.request.altitude_ft);
      const double left = at.x - kHalfWidth, right = at.x + kHalfWidth;
      const double high = at.y - kHalfHeight, low = at.y + kHalfHeight;
      shapes_.emplace_back(Area({{left, high}, {right, high}, {right, low}, {left, low}}, colour));
      if (IsDoubtful(flight)) shapes_.emplace_back(Disc{at, kRadius, kWhite, kGrey, 0.8});
    }
    return panel.bottom();
  }

  std::vector<LegendEntry> Entries() const {
    std::vector<LegendEntry> entries;
    for (std::size_t level = 0; level < kLevelDashes.size(); ++level) {
      entries.push_back({LineSample(kInk, 0.8, kLevelDashes[level]),
                         fmt::format("boundary of level {}", level + 1)});
    }
    for (const auto& [altitude, style] : altitudes_) {
      entries.push_back({MarkerSample(style.marker, {{}, kRadius, style.colour, std::nullopt}),
                         TickText(altitude) + " ft"});
    }
    if (speeds_.max > speeds_.min) {
      entries.push_back(PaleIsSlow(speeds_, kRadius, kPale));
    }
    std::array<bool, kLevelColours.size()> seen{};
    for (const AssessedFlight& flight : flights_) {
      seen[static_cast<std::size_t>(ShortPeriodLevel(flight)) - 1] = true;
    }
    for (std::size_t level = 0; level < seen.size(); ++level) {
      if (!seen[level]) continue;
      entries.push_back({BandSample(kLevelColours[level], 1),
                         level < 3 ? fmt::format("level {}", level + 1) : "below level 3"});
    }
    if (std::any_of(flights_.begin(), flights_.end(), IsDoubtful)) {
      entries.push_back({MarkerSample(Marker::kDisc, {{}, kRadius, kWhite, kGrey, 0.8}),
                         fmt::format("no equivalent system: mismatch above {}", kMostMismatch)});
    }
    return entries;
  }

  const std::vector<AssessedFlight>& flights_;
  const LevelLimits& limits_;
  double width_;
  Range speeds_;
  std::map<double, CurveStyle> altitudes_;
  std::vector<Shape> shapes_;
};

}  // namespace

Picture DrawHandlingLevels(const std::vector<AssessedFlight>& flights, const LevelLimits& limits,
                           double width, const std::string& title) {
  return LevelsDrawing(flights, limits, width).Draw(title);
}

}  // namespace skein
