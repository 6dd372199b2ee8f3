// SPDX-License-Identifier: Apache-2.0
#include "src/plot/time_histories.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/choice_error.h"
#include "src/files/text_table.h"
#include "src/plot/axes.h"
#include "src/plot/legend.h"

namespace skein {
namespace {

constexpr double kLeastPanelWidth = 88, kAside = 14, kBetween = 23;
constexpr double kQuantityHeight = 66, kActionHeight = 32;
constexpr double kPointsPerTick = 34;
constexpr double kToleranceOpacity = 0.3;
constexpr double kPaleOpacity = 0.12;  // of the tolerance around an agent's own target
constexpr double kSameShare = 2e-3;    // of a panel's height, which nobody sees
constexpr double kMostLabelWidth = 44;

bool IsAction(const std::string& row) { return row.rfind("action_", 0) == 0; }

std::string RowWords(const std::string& row) {
  if (!IsAction(row)) return InWords(row);
  const std::string name = InWords(row.substr(std::string("action_").size()));
  return name.rfind("target ", 0) == 0 ? name + " (high-level action), -1 to 1"
                                       : name + " action, -1 to 1";
}

/// The targets' quantities, then the actions of any agent.
std::vector<std::string> RowsOf(const Recordings& recordings) {
  std::vector<std::string> rows = recordings.targets;
  for (const Recording& agent : recordings.agents) {
    for (const std::string& name : agent.flights.front().table.names) {
      if (IsAction(name) && std::find(rows.begin(), rows.end(), name) == rows.end()) {
        rows.push_back(name);
      }
    }
  }
  return rows;
}

/// Throws ChoiceError on a column that is not there. An action may be of some agents alone.
void RequireColumns(const Recordings& recordings, const std::vector<std::string>& columns) {
  const std::vector<Recording>& agents = recordings.agents;
  for (const std::string& column : columns) {
    const auto has = [&](const Recording& agent) { return agent.flights.front().Has(column); };
    if (IsAction(column) && std::any_of(agents.begin(), agents.end(), has)) continue;
    const auto without = std::find_if_not(agents.begin(), agents.end(), has);
    if (without == agents.end()) continue;
    const DrawnFlight& flight = without->flights.front();
    throw ChoiceError(fmt::format("{}: no column {}; there are {}", flight.source, column,
                                  fmt::join(flight.table.names, ", ")));
  }
}

class HistoryDrawing {
 public:
  HistoryDrawing(const Recordings& recordings, const HistoryOptions& options)
      : recordings_(recordings),
        options_(options),
        episodes_(EpisodesOf(recordings)),
        rows_(options.columns.empty() ? RowsOf(recordings) : options.columns) {
    std::vector<double> times;
    for (const DrawnEpisode& episode : episodes_) {
      for (const DrawnEpisode::Entry& entry : episode.flights) {
        const Range own = entry.flight->times_s();
        times.insert(times.end(), {own.min, own.max});
      }
    }
    times_ = SpanOf(times);
    const auto count = static_cast<double>(episodes_.size());
    panel_width_ = (options.width - kMargin - left_ - (count - 1) * kAside) / count;
  }

  Picture Draw() {
    double top = DrawTitle(options_.title, options_.width, &shapes_);
    top = DrawHeads(top + kTextSize);
    for (const std::string& row : rows_) top = DrawRow(row, top + kBetween - 6);
    const double x = (left_ + options_.width - kMargin) / 2;
    shapes_.emplace_back(Words{{x, top + 22}, "time, s", kTextSize, Anchor::kMiddle});
    const double bottom =
        DrawLegend({left_, top + 38}, options_.width - kMargin, LegendEntries(), &shapes_);
    return FinishedPicture(options_.width, bottom,
                           options_.title.empty() ? "Flights over time" : options_.title,
                           std::move(shapes_));
  }

 private:
  double LeftOf(std::size_t column) const {
    return left_ + static_cast<double>(column) * (panel_width_ + kAside);
  }

  /// Number of the episode, and how each flight ended.
  double DrawHeads(double top) {
    double lowest = top;
    for (std::size_t k = 0; k < episodes_.size(); ++k) {
      double y = top;
      Words head{{LeftOf(k), y}, "episode " + episodes_[k].flights.front().flight->episode};
      head.is_bold = true;
      shapes_.emplace_back(head);
      for (const auto& [agent, flight] : episodes_[k].flights) {
        const Colour colour = recordings_.agents.size() == 1 ? kInk : agent->style.colour;
        for (const std::string& line : Wrapped(EndOf(*flight), panel_width_, kSmallSize)) {
          y += 1.25 * kSmallSize;
          shapes_.emplace_back(Words{{LeftOf(k), y}, line, kSmallSize, Anchor::kStart, colour});
        }
      }
      lowest = std::max(lowest, y);
    }
    return lowest;
  }

  Range RangeOf(const std::string& row) const {
    if (IsAction(row)) return {-1.1, 1.1};
    const double tolerance = ToleranceOf(row);
    std::vector<double> values;
    for (const DrawnEpisode& episode : episodes_) {
      for (const DrawnEpisode::Entry& entry : episode.flights) {
        for (const PagePoint& point : FlownIn(entry, row)) values.push_back(point.y);
        for (const PagePoint& point : entry.flight->Target(row)) {
          values.insert(values.end(), {point.y - tolerance, point.y + tolerance});
        }
      }
    }
    return Padded(values);
  }

  /// 0 if it is not known.
  double ToleranceOf(const std::string& row) const {
    const auto found = recordings_.tolerances.find(row);
    return found == recordings_.tolerances.end() ? 0 : found->second;
  }

  /// Empty of an agent without such a column, as the other agents' high-level actions are.
  static std::vector<PagePoint> FlownIn(const DrawnEpisode::Entry& entry, const std::string& row) {
    return IsAction(row) && !entry.flight->Has(row) ? std::vector<PagePoint>()
                                                    : entry.flight->Flown(row);
  }

  double DrawRow(const std::string& row, double top) {
    const Range range = RangeOf(row);
    const double height = IsAction(row) ? kActionHeight : kQuantityHeight;
    const std::vector<double> up =
        IsAction(row) ? std::vector<double>{-1, 0, 1} : Ticks(range, height / 16);
    const std::vector<double> across = Ticks(times_, panel_width_ / kPointsPerTick);
    Words words{{left_, top - 4}, RowWords(row)};
    words.is_bold = true;
    shapes_.emplace_back(words);
    for (std::size_t k = 0; k < episodes_.size(); ++k) {
      const Panel panel({LeftOf(k), top}, panel_width_, height, times_, range);
      panel.DrawGrid(across, up, &shapes_);
      if (k == 0) panel.LabelLeft(up, &shapes_);
      if (row == rows_.back()) panel.LabelBottom(across, &shapes_);
      DrawCell(panel, episodes_[k], row);
    }
    return top + height;
  }

  /// One quantity or action of one episode, of all agents; the first agent's on top.
  void DrawCell(const Panel& panel, const DrawnEpisode& episode, const std::string& row) {
    const auto longest = std::max_element(episode.flights.begin(), episode.flights.end(),
                                          [](const auto& a, const auto& b) {
                                            return a.flight->duration_s() < b.flight->duration_s();
                                          });
    const std::vector<PagePoint> target = longest->flight->Target(row);
    const double tolerance = ToleranceOf(row);
    if (AreAlike(panel, target, episode, row)) {
      DrawTarget(panel, target, tolerance, {kInk, Dash::kDashed, Marker::kDisc});
    } else {
      has_own_targets_ = true;
      for (auto entry = episode.flights.rbegin(); entry != episode.flights.rend(); ++entry) {
        CurveStyle style = entry->agent->style;
        style.dash = style.dash == Dash::kDashed ? Dash::kShort : Dash::kDashed;
        DrawTarget(panel, entry->flight->Target(row), tolerance, style);
      }
    }
    for (auto entry = episode.flights.rbegin(); entry != episode.flights.rend(); ++entry) {
      const CurveStyle& style = entry->agent->style;
      panel.DrawCurve(FlownIn(*entry, row), style.colour, IsAction(row) ? 0.7 : 1.2, style.dash,
                      &shapes_);
    }
  }

  /// Whether all flights of a cell have the longest one's target as long as they are flown; a
  /// mission's depend on when the one before was reached.
  static bool AreAlike(const Panel& panel, const std::vector<PagePoint>& longest,
                       const DrawnEpisode& episode, const std::string& row) {
    const double most = kSameShare * (panel.y_range().max - panel.y_range().min);
    for (const DrawnEpisode::Entry& entry : episode.flights) {
      const std::vector<PagePoint> own = entry.flight->Target(row);
      const std::size_t rows = std::min(own.size(), longest.size());
      for (std::size_t k = 0; k < rows; ++k) {
        if (std::abs(own[k].y - longest[k].y) > most) return false;
      }
    }
    return true;
  }

  /// In ink what all are to reach, in an agent's colour what it alone is to reach.
  void DrawTarget(const Panel& panel, const std::vector<PagePoint>& target, double tolerance,
                  const CurveStyle& style) {
    if (tolerance > 0) {
      std::vector<PagePoint> low = target, high = target;
      for (PagePoint& point : low) point.y -= tolerance;
      for (PagePoint& point : high) point.y += tolerance;
      const bool is_of_all = style.colour == kInk;
      panel.DrawBand(low, high, is_of_all ? kGrey : style.colour,
                     is_of_all ? kToleranceOpacity : kPaleOpacity, &shapes_);
    }
    panel.DrawCurve(target, style.colour, 0.9, style.dash, &shapes_);
  }

  std::vector<LegendEntry> LegendEntries() const {
    std::vector<LegendEntry> entries;
    for (const Recording& agent : recordings_.agents) {
      entries.push_back({LineSample(agent.style.colour, 1.2, agent.style.dash), agent.name});
    }
    const auto has = [this](const auto& known) {
      return std::any_of(rows_.begin(), rows_.end(), known);
    };
    const std::vector<std::string>& targets = recordings_.targets;
    if (has([&](const std::string& row) {
          return std::find(targets.begin(), targets.end(), row) != targets.end();
        })) {
      entries.push_back(
          {LineSample(kInk, 0.9, Dash::kDashed),
           has_own_targets_ ? "target; in the agents' colours where theirs differ" : "target"});
    }
    if (has([&](const std::string& row) { return recordings_.tolerances.count(row) > 0; })) {
      entries.push_back({BandSample(kGrey, kToleranceOpacity), "tolerance"});
    }
    return entries;
  }

  const Recordings& recordings_;
  const HistoryOptions& options_;
  std::vector<DrawnEpisode> episodes_;
  std::vector<std::string> rows_;
  Range times_;
  bool has_own_targets_ = false;  ///< whether a cell was drawn with them
  double left_ = kMostLabelWidth, panel_width_ = 0;
  std::vector<Shape> shapes_;
};

}  // namespace

int MostHistories(double width) {
  const double room = width - kMargin - kMostLabelWidth + kAside;
  return std::max(1, static_cast<int>(room / (kLeastPanelWidth + kAside)));
}

Picture TimeHistories(const Recordings& recordings, const HistoryOptions& options) {
  RequireColumns(recordings, options.columns);
  const auto count = static_cast<int>(EpisodesOf(recordings).size());
  if (count > MostHistories(options.width)) {
    throw ChoiceError(
        fmt::format("{} do not fit side by side: at most {} do in a picture of {:.3g} in "
                    "(--width); choose with --show",
                    Counted(count, "episode"), MostHistories(options.width), options.width / 72));
  }
  return HistoryDrawing(recordings, options).Draw();
}

}  // namespace skein
