// SPDX-License-Identifier: Apache-2.0
#include "src/plot/seed_curves.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <system_error>
#include <utility>

#include "base/choice_error.h"
#include "base/error.h"
#include "src/files/text_table.h"
#include "src/plot/axes.h"
#include "src/plot/legend.h"

namespace skein {
namespace {

constexpr double kMillion = 1e6, kSecondsPerMinute = 60;

/// The values of one run: million control steps, value.
std::vector<PagePoint> ValuesOf(const RunRecord& run, const std::string& column) {
  const std::vector<double>* const steps = run.metrics.Find("env_steps");
  const std::vector<double>* const values = run.metrics.Find(column);
  if (steps == nullptr) throw Error(run.path + ": metrics.csv has no column env_steps");
  if (values == nullptr) {
    throw ChoiceError(fmt::format("{}: metrics.csv has no column {}; there are {}", run.path,
                                  column, fmt::join(run.metrics.names, ", ")));
  }
  std::vector<PagePoint> points;
  const double scale = IsShare(column) ? 100 : 1;
  for (std::size_t row = 0; row < steps->size(); ++row) {
    const double value = (*values)[row];
    if (!std::isfinite((*steps)[row]) || !std::isfinite(value)) continue;
    points.push_back({(*steps)[row] / kMillion, scale * value});
  }
  return points;
}

[[noreturn]] void RefuseNoStepsInCommon(const CurveSetting& setting, const std::string& column) {
  std::vector<std::string> paths;
  for (const RunRecord& run : setting.runs) paths.push_back(run.path);
  const std::string last = paths.back();
  paths.pop_back();
  throw ChoiceError(fmt::format(
      "{} and {} have no control steps in common for {}; --seeds 1 draws each for itself",
      fmt::join(paths, ", "), last, column));
}

/// Settings of one task that have the same name are called by the paths of their first runs.
void NameApart(std::vector<CurveSetting>* settings) {
  std::vector<std::string> names;
  for (const CurveSetting& setting : *settings) names.push_back(setting.task + '\n' + setting.name);
  const std::vector<bool> are_twice = AreTwice(names);
  for (std::size_t k = 0; k < settings->size(); ++k) {
    CurveSetting& setting = (*settings)[k];
    if (are_twice[k]) setting.name = setting.runs.front().path;
  }
}

}  // namespace

void LeaveOutRunsWithoutValues(const std::vector<std::string>& columns,
                               std::vector<CurveSetting>* settings,
                               std::vector<std::string>* notes) {
  std::vector<std::string> without;
  const auto is_without = [&](const RunRecord& run) {
    for (const std::string& column : columns) {
      if (run.metrics.rows() > 0 && !ValuesOf(run, column).empty()) continue;
      without.push_back(fmt::format("{}: column {} has no values yet", run.path, column));
      return true;
    }
    return false;
  };
  for (CurveSetting& setting : *settings) {
    std::vector<RunRecord>& runs = setting.runs;
    runs.erase(std::remove_if(runs.begin(), runs.end(), is_without), runs.end());
  }
  settings->erase(std::remove_if(settings->begin(), settings->end(),
                                 [](const CurveSetting& setting) { return setting.runs.empty(); }),
                  settings->end());
  if (settings->empty()) throw Error(without.front());
  for (const std::string& run : without) notes->push_back(run + "; left out");
}

double Interpolated(const std::vector<PagePoint>& curve, double x) {
  const auto after =
      std::lower_bound(curve.begin(), curve.end(), x,
                       [](const PagePoint& point, double wanted) { return point.x < wanted; });
  if (after == curve.end()) return curve.back().y;
  if (after->x == x || after == curve.begin()) return after->y;
  const PagePoint &a = *(after - 1), &b = *after;
  return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

std::optional<double> MinutesPerMillion(const CurveSetting& setting) {
  std::optional<double> least;
  for (const RunRecord& run : setting.runs) {
    const std::vector<double>* const steps = run.timing.Find("env_steps");
    if (steps == nullptr || steps->empty() || !(steps->back() > 0)) continue;
    double seconds = 0;
    for (const char* part : {"rollout_s", "update_s", "evaluation_s"}) {
      const std::vector<double>* const times = run.timing.Find(part);
      if (times == nullptr) continue;
      for (const double time : *times) seconds += std::isfinite(time) ? time : 0;
    }
    const double own = seconds / steps->back() * kMillion / kSecondsPerMinute;
    least = std::min(own, least.value_or(own));
  }
  return least;
}

SeedCurve CurveOf(const CurveSetting& setting, const std::string& column) {
  std::vector<std::vector<PagePoint>> curves;
  double first = 0, last = std::numeric_limits<double>::infinity();
  std::set<double> steps;
  for (const RunRecord& run : setting.runs) {
    curves.push_back(ValuesOf(run, column));
    if (curves.back().empty()) return {};
    first = std::max(first, curves.back().front().x);
    last = std::min(last, curves.back().back().x);
    for (const PagePoint& point : curves.back()) steps.insert(point.x);
  }
  if (first > last) RefuseNoStepsInCommon(setting, column);
  SeedCurve result;
  for (const double x : steps) {
    if (x < first || x > last) continue;
    double sum = 0, low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::vector<PagePoint>& curve : curves) {
      const double value = Interpolated(curve, x);
      sum += value;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    result.mean.push_back({x, sum / static_cast<double>(curves.size())});
    result.low.push_back({x, low});
    result.high.push_back({x, high});
  }
  return result;
}

std::vector<CurveSetting> SettingsOf(std::vector<RunRecord> runs, std::optional<int> seeds,
                                     const std::vector<std::string>& names) {
  std::vector<CurveSetting> settings;
  std::vector<std::string> keys;
  std::set<std::filesystem::path> places;
  for (const RunRecord& run : runs) {
    std::error_code none;
    if (!places.insert(std::filesystem::weakly_canonical(run.path, none)).second) {
      throw Error(fmt::format("{}: it is there twice", run.path));
    }
  }
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const std::string key =
        seeds ? std::to_string(k / static_cast<std::size_t>(*seeds)) : Repetition(runs[k]);
    const auto index =
        static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin());
    const std::string& task = runs[k].config.train.env.task;
    if (index == keys.size()) {
      keys.push_back(key);
      settings.push_back({task, runs[k].name, {}});
    }
    if (settings[index].task != task) {
      throw Error(fmt::format("{}: of another task than {}, with which --seeds puts it together",
                              runs[k].path, settings[index].runs.front().path));
    }
    settings[index].runs.push_back(std::move(runs[k]));
  }
  NameApart(&settings);
  if (!names.empty() && names.size() != settings.size()) {
    throw Error(fmt::format("--names: {} for {}", Counted(static_cast<int>(names.size()), "name"),
                            Counted(static_cast<int>(settings.size()), "setting")));
  }
  for (std::size_t k = 0; k < names.size(); ++k) settings[k].name = names[k];
  return settings;
}

}  // namespace skein
