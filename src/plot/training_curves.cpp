// SPDX-License-Identifier: Apache-2.0
#include "src/plot/training_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "base/error.h"
#include "src/plot/axes.h"
#include "src/plot/label_places.h"
#include "src/plot/legend.h"

namespace skein {
namespace {

constexpr double kBandOpacity = 0.2;
constexpr double kLeft = 40, kAside = 40, kLeastPanelWidth = 100;
constexpr double kHeightPerWidth = 0.7, kMostHeight = 170;
constexpr std::size_t kMostDots = 40;  // that still show where a curve has points
constexpr double kCurveWidth = 1.4;

const std::map<std::string, std::string>& TaskTitles() {
  static const std::map<std::string, std::string> titles = {
      {"heading", "Heading: a new altitude, heading and speed"},
      {"control", "Control: a new pitch, heading and speed"},
      {"tracking", "Tracking: a point in space"}};
  return titles;
}

/// What a column of success is of: episodes of one target, or missions.
struct SuccessTitle {
  const char *of_targets, *of_missions;
  bool (*flies_missions)(const EnvConfig& env);
};

const std::map<std::string, SuccessTitle>& SuccessTitles() {
  static const std::map<std::string, SuccessTitle> titles = {
      {"evaluation_success_rate",
       {"episodes that reach their target, flown by the mean action, %",
        "missions flown to their end by the mean action, %",
        [](const EnvConfig& env) { return EvaluationConfig(env).mission.enabled(); }}},
      {"success_rate",
       {"training episodes that reach their target and the end of its hold, sampled actions, %",
        "training missions flown to their end, sampled actions, %",
        [](const EnvConfig& env) { return env.mission.enabled(); }}}};
  return titles;
}

std::string ColumnTitle(const std::string& column, const std::vector<CurveSetting>& settings) {
  if (column == "return_mean") return "mean return of the training episodes";
  const auto known = SuccessTitles().find(column);
  if (known == SuccessTitles().end()) return InWords(column);
  const SuccessTitle& title = known->second;
  const auto flies_missions = [&](const CurveSetting& setting) {
    return title.flies_missions(setting.runs.front().config.train.env);
  };
  if (std::all_of(settings.begin(), settings.end(), flies_missions)) return title.of_missions;
  if (std::none_of(settings.begin(), settings.end(), flies_missions)) return title.of_targets;
  return fmt::format("{}; or {}", title.of_targets, title.of_missions);
}

std::string TaskTitle(const std::string& task) {
  const auto known = TaskTitles().find(task);
  return known != TaskTitles().end() ? known->second : task;
}

/// Of each setting the number of its style: another one for all of a task, the same one for the
/// same name in several tasks.
std::vector<std::size_t> StyleNumbers(const std::vector<CurveSetting>& settings) {
  std::vector<std::size_t> numbers;
  std::set<std::pair<std::string, std::size_t>> taken;  // task, number
  std::size_t next = 0;
  for (const CurveSetting& setting : settings) {
    std::size_t number = next;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const bool is_free = taken.count({setting.task, numbers[k]}) == 0;
      if (settings[k].name == setting.name && is_free) number = std::min(number, numbers[k]);
    }
    taken.insert({setting.task, number});
    numbers.push_back(number);
    next = std::max(next, number + 1);
  }
  return numbers;
}

class CurveDrawing {
 public:
  CurveDrawing(const std::vector<CurveSetting>& settings, const CurveOptions& options)
      : settings_(settings), options_(options), styles_(StyleNumbers(settings)) {
    for (const CurveSetting& setting : settings) {
      if (std::find(tasks_.begin(), tasks_.end(), setting.task) == tasks_.end()) {
        tasks_.push_back(setting.task);
      }
    }
    const double room = options.width - kLeft - kMargin;
    const auto most = static_cast<std::size_t>((room + kAside) / (kLeastPanelWidth + kAside));
    across_ = std::clamp<std::size_t>(most, 1, tasks_.size());
    const auto count = static_cast<double>(across_);
    panel_width_ = (room - (count - 1) * kAside) / count;
  }

  Picture Draw() {
    double top = DrawTitle(options_.title, options_.width, &shapes_);
    for (std::size_t first = 0; first < tasks_.size(); first += across_) {
      const std::vector<std::string> tasks(
          tasks_.begin() + static_cast<std::ptrdiff_t>(first),
          tasks_.begin() + static_cast<std::ptrdiff_t>(std::min(first + across_, tasks_.size())));
      top = DrawTaskTitles(tasks, top);
      for (const std::string& column : options_.columns) top = DrawRow(tasks, column, top);
    }
    const double bottom =
        DrawLegend({kLeft, top + 6}, options_.width - kMargin, LegendEntries(), &shapes_);
    return FinishedPicture(options_.width, bottom,
                           options_.title.empty() ? "Training curves" : options_.title,
                           std::move(shapes_));
  }

 private:
  double LeftOf(std::size_t task) const {
    return kLeft + static_cast<double>(task) * (panel_width_ + kAside);
  }

  std::vector<std::size_t> SettingsIn(const std::string& task) const {
    std::vector<std::size_t> numbers;
    for (std::size_t k = 0; k < settings_.size(); ++k) {
      if (settings_[k].task == task) numbers.push_back(k);
    }
    return numbers;
  }

  bool HasSeveralSettings() const { return settings_.size() > tasks_.size(); }
  /// One for all if the panels' titles tell them apart.
  std::size_t StyleNumberFor(std::size_t setting) const {
    return HasSeveralSettings() ? styles_[setting] : 0;
  }
  CurveStyle StyleFor(std::size_t setting) const { return StyleOf(StyleNumberFor(setting)); }

  double DrawTaskTitles(const std::vector<std::string>& tasks, double top) {
    double lowest = top;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      double y = top;
      for (const std::string& line :
           Wrapped(TaskTitle(tasks[k]), panel_width_ + kAside / 2, kTextSize)) {
        y += 1.25 * kTextSize;
        Words words{{LeftOf(k), y}, line};
        words.is_bold = true;
        shapes_.emplace_back(words);
      }
      lowest = std::max(lowest, y);
    }
    return lowest;
  }

  double DrawRow(const std::vector<std::string>& tasks, const std::string& column, double top) {
    top += 4;
    for (const std::string& line :
         Wrapped(ColumnTitle(column, settings_), options_.width - kLeft - kMargin, kTextSize)) {
      top += 1.25 * kTextSize;
      shapes_.emplace_back(Words{{kLeft, top}, line});
    }
    top += column == options_.columns.front() && HasMinutes() ? 32 : 7;
    const std::vector<SeedCurve> curves = CurvesOf(column);
    const Range range = RangeOf(column, curves);
    const double height = std::min(kMostHeight, kHeightPerWidth * panel_width_);
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      const Panel panel({LeftOf(k), top}, panel_width_, height, {0, LastStep(tasks[k], curves)},
                        range);
      DrawPanel(panel, tasks[k], column, curves);
    }
    return top + height + 38;
  }

  std::vector<SeedCurve> CurvesOf(const std::string& column) const {
    std::vector<SeedCurve> curves;
    for (const CurveSetting& setting : settings_) {
      curves.push_back(CurveOf(setting, column));
      if (curves.back().mean.empty()) {
        throw Error(
            fmt::format("{}: column {} has no values yet", setting.runs.front().path, column));
      }
    }
    return curves;
  }

  static Range RangeOf(const std::string& column, const std::vector<SeedCurve>& curves) {
    if (IsShare(column)) return {0, 112};  // with room for words above
    std::vector<double> values;
    for (const SeedCurve& curve : curves) {
      for (const auto& side : {curve.low, curve.high}) {
        for (const PagePoint& point : side) values.push_back(point.y);
      }
    }
    return Padded(values);
  }

  double LastStep(const std::string& task, const std::vector<SeedCurve>& curves) const {
    double last = 0;
    for (const std::size_t k : SettingsIn(task)) last = std::max(last, curves[k].mean.back().x);
    return last;
  }

  void DrawPanel(const Panel& panel, const std::string& task, const std::string& column,
                 const std::vector<SeedCurve>& curves) {
    const std::vector<std::size_t> own = SettingsIn(task);
    panel.DrawAxes(&shapes_);
    panel.NameBottom("control steps, million", &shapes_);
    for (const std::size_t k : own) {
      panel.DrawBand(curves[k].low, curves[k].high, StyleFor(k).colour, kBandOpacity, &shapes_);
    }
    for (const std::size_t k : own) DrawMean(panel, curves[k].mean, StyleFor(k));
    if (IsShare(column)) DrawAutopilot(panel, task, curves, own);
    if (column == options_.columns.front()) DrawMinutes(panel, own);
  }

  void DrawMean(const Panel& panel, const std::vector<PagePoint>& mean, const CurveStyle& style) {
    panel.DrawCurve(mean, style.colour, kCurveWidth, style.dash, &shapes_);
    if (mean.size() > kMostDots) return;
    for (const PagePoint& point : mean) {
      shapes_.push_back(MarkerAt(panel.Place(point.x, point.y), style.marker,
                                 {{}, 1.7, style.colour, std::nullopt}));
    }
  }

  /// A line at its figure, with words where no curve passes.
  void DrawAutopilot(const Panel& panel, const std::string& task,
                     const std::vector<SeedCurve>& curves, const std::vector<std::size_t>& own) {
    const auto found = options_.autopilots.find(task);
    if (found == options_.autopilots.end()) return;
    const auto& [name, rate] = found->second;
    panel.DrawCurve({{0, 100 * rate}, {panel.x_range().max, 100 * rate}}, kInk, 1, Dash::kDashed,
                    &shapes_);
    LabelPlaces places({panel.left(), panel.top() + 1, panel.right(), panel.bottom()});
    for (const std::size_t k : own) {
      for (const auto& side : {curves[k].mean, curves[k].low, curves[k].high}) {
        constexpr int kParts = 60;
        for (int part = 0; part <= kParts; ++part) {
          const double x = side.front().x + (side.back().x - side.front().x) * part / kParts;
          places.Avoid(panel.Place(x, Interpolated(side, x)), 2.5, 1);
        }
      }
    }
    std::vector<Words> offsets;
    for (const double down : {9.0, -4.0, 20.0, 32.0, 44.0, 60.0, 80.0}) {
      for (const bool at_end : {true, false}) {
        Words offset;
        offset.at = {at_end ? -4 : -panel.width() + 4, down};
        offset.anchor = at_end ? Anchor::kEnd : Anchor::kStart;
        offsets.push_back(offset);
      }
    }
    Words words{{}, fmt::format("{}: {:.1f} %", name, 100 * rate), kSmallSize};
    words.has_halo = true;
    const std::optional<Words> put =
        places.Put(words, panel.Place(panel.x_range().max, 100 * rate), offsets);
    if (put) shapes_.emplace_back(*put);
  }

  bool HasMinutes() const {
    return std::any_of(settings_.begin(), settings_.end(),
                       [](const CurveSetting& setting) { return MinutesPerMillion(setting); });
  }

  /// On the upper edge, where the settings of a panel do not differ by more than a tenth.
  void DrawMinutes(const Panel& panel, const std::vector<std::size_t>& own) {
    constexpr double kSame = 1.1;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const std::size_t k : own) {
      const std::optional<double> rate = MinutesPerMillion(settings_[k]);
      least = std::min(least, rate.value_or(0));
      most = std::max(most, rate.value_or(0));
    }
    if (!(least > 0) || most > kSame * least) return;
    const double last = panel.x_range().max * least;
    shapes_.emplace_back(
        Line({{panel.left(), panel.top()}, {panel.right(), panel.top()}}, kGrey, 0.6));
    for (const double minutes : TicksAcross({0, last}, panel.width())) {
      const double x = panel.Place(minutes / least, 0).x;
      shapes_.emplace_back(Line({{x, panel.top()}, {x, panel.top() - 3}}, kGrey, 0.6));
      shapes_.emplace_back(
          Words{{x, panel.top() - 6}, TickText(minutes), kSmallSize, Anchor::kMiddle});
    }
    const std::string machine = options_.machine.empty() ? "" : " on " + options_.machine;
    shapes_.emplace_back(Words{{panel.left() + panel.width() / 2, panel.top() - 16},
                               "minutes" + machine,
                               kTextSize,
                               Anchor::kMiddle});
  }

  std::vector<LegendEntry> LegendEntries() const {
    std::vector<LegendEntry> entries;
    bool has_band = false;
    std::set<std::pair<std::size_t, std::string>> known;
    for (std::size_t k = 0; k < settings_.size(); ++k) {
      const CurveSetting& setting = settings_[k];
      has_band |= setting.runs.size() > 1;
      const std::string seeds = setting.runs.size() > 1
                                    ? fmt::format("mean of {} seeds", setting.runs.size())
                                    : "one seed";
      const std::string words = HasSeveralSettings() ? setting.name + ", " + seeds : seeds;
      if (!known.insert({StyleNumberFor(k), words}).second) continue;
      const CurveStyle style = StyleFor(k);
      entries.push_back({LineSample(style.colour, kCurveWidth, style.dash), words});
    }
    if (has_band) {
      entries.push_back(
          {BandSample(HasSeveralSettings() ? kGrey : StyleFor(0).colour, kBandOpacity),
           "lowest to highest seed"});
    }
    return entries;
  }

  const std::vector<CurveSetting>& settings_;
  const CurveOptions& options_;
  std::vector<std::size_t> styles_;  ///< numbers, by setting
  std::vector<std::string> tasks_;
  std::size_t across_ = 1;  ///< tasks side by side
  double panel_width_ = 0;
  std::vector<Shape> shapes_;
};

}  // namespace

Picture TrainingCurves(const std::vector<CurveSetting>& settings, const CurveOptions& options) {
  return CurveDrawing(settings, options).Draw();
}

}  // namespace skein
