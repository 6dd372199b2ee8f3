// SPDX-License-Identifier: Apache-2.0
#include "src/bench/bench_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/median.h"
#include "src/bench/figure.h"
#include "src/config/usage_error.h"
#include "src/files/json_number.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostParts = 10;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// One file.
struct Run {
  std::string path;
  Json document;
  std::vector<Figure> figures;
};

Run ReadRun(const std::string& path) {
  Run run{path, Json::parse(ReadFile(path), nullptr, false), {}};
  const Json& document = run.document;
  if (!document.is_object() || !document.contains("benchmark") || !document.contains("machine")) {
    throw Error(path + ": is not what skein bench --json writes now");
  }
  if (!document.contains("figures")) {
    throw Error(fmt::format("{}: bench {} measures nothing that could be compared", path,
                            document["benchmark"].dump()));
  }
  run.figures = ReadFigures(document["figures"], path);
  return run;
}

std::vector<Run> ReadRuns(const std::vector<std::string>& paths) {
  std::vector<Run> runs;
  for (const std::string& path : paths) runs.push_back(ReadRun(path));
  return runs;
}

/// What the keys lead to; null if they lead nowhere.
Json At(const Json& document, const std::vector<std::string>& keys) {
  Json found = document;
  for (const std::string& key : keys) {
    found = found.is_object() && found.contains(key) ? Json(found[key]) : Json();
  }
  return found;
}

/// The same as text.
std::string TextAt(const Json& document, const std::vector<std::string>& keys) {
  const Json found = At(document, keys);
  return found.is_string() ? found.get<std::string>() : found.dump();
}

bool Says(const Run& run, const std::vector<std::string>& keys) {
  return !At(run.document, keys).is_null();
}

/// Throws UsageError if the keys do not lead to the same in both.
void RequireSame(const Run& first, const Run& other, const std::vector<std::string>& keys,
                 const std::string& hint) {
  const std::string a = TextAt(first.document, keys), b = TextAt(other.document, keys);
  if (a == b) return;
  throw UsageError(
      fmt::format("{} and {} cannot be compared: {} is {} in one and {} in the other{}", first.path,
                  other.path, keys.back(), a, b, hint));
}

/// The same in all that say it: older files, and systems that do not know it, do not.
void RequireSameIfSaid(const std::vector<Run>& runs, const std::vector<std::string>& keys,
                       const std::string& hint) {
  const Run* first = nullptr;
  for (const Run& run : runs) {
    if (!Says(run, keys)) continue;
    if (first == nullptr) first = &run;
    RequireSame(*first, run, keys, hint);
  }
}

constexpr const char* kOtherMachineHint = " (--other-machine compares them all the same)";

/// Throws UsageError unless all runs that say of which kind their processor is name the same.
void RequireOneKindOfProcessor(const std::vector<Run>& runs) {
  RequireSameIfSaid(runs, {"machine", "cpu_family"}, kOtherMachineHint);
  RequireSameIfSaid(runs, {"machine", "cpu_model"}, kOtherMachineHint);
}

void RequireComparable(const Run& first, const Run& other, bool other_machine) {
  RequireSame(first, other, {"benchmark"}, "");
  RequireSame(first, other, {"settings"}, "");
  RequireSame(first, other, {"ranks"}, "");
  if (other_machine) return;
  RequireSame(first, other, {"machine", "cpu"}, kOtherMachineHint);
  RequireSame(first, other, {"machine", "simd"}, kOtherMachineHint);
  RequireSame(first, other, {"threads"}, kOtherMachineHint);
}

const Figure* Find(const Run& run, const std::string& name) {
  const auto found = std::find_if(run.figures.begin(), run.figures.end(),
                                  [&](const Figure& figure) { return figure.name == name; });
  return found == run.figures.end() ? nullptr : &*found;
}

bool IsInAll(const std::vector<Run>& runs, const std::string& name) {
  return std::all_of(runs.begin(), runs.end(),
                     [&](const Run& run) { return Find(run, name) != nullptr; });
}

/// Every figure that is in some run, once.
std::vector<const Figure*> AllFigures(const std::vector<Run>& before,
                                      const std::vector<Run>& after) {
  std::vector<const Figure*> all;
  for (const std::vector<Run>* const runs : {&before, &after}) {
    for (const Run& run : *runs) {
      for (const Figure& figure : run.figures) {
        const bool is_known = std::any_of(all.begin(), all.end(), [&](const Figure* known) {
          return known->name == figure.name;
        });
        if (!is_known) all.push_back(&figure);
      }
    }
  }
  return all;
}

std::vector<double> Logarithms(std::vector<double> values) {
  for (double& value : values) value = std::log(value);
  return values;
}

double Variance(const std::vector<double>& values, double mean) {
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares / static_cast<double>(values.size() - 1);
}

/// Such samples say nothing of noise.
bool AreAllAlike(const std::vector<double>& samples) {
  return std::all_of(samples.begin(), samples.end(),
                     [&samples](double sample) { return sample == samples.front(); });
}

/// Of unpaired samples: Welch's t, with the degrees of freedom by Satterthwaite (Biometrics
/// Bulletin 2, 1946) rounded down.
Estimate EstimateDifference(const std::vector<double>& before, const std::vector<double>& after) {
  const double mean_before = EstimateMean(before).value, mean_after = EstimateMean(after).value;
  Estimate estimate{mean_after - mean_before, kNaN, kNaN,
                    static_cast<int>(std::min(before.size(), after.size()))};
  if (estimate.count < 2 || (AreAllAlike(before) && AreAllAlike(after))) return estimate;
  const auto error = [](const std::vector<double>& values, double mean) {
    return Variance(values, mean) / static_cast<double>(values.size());
  };
  const double a = error(before, mean_before), b = error(after, mean_after);
  const double degrees = (a + b) * (a + b) /
                         (a * a / static_cast<double>(before.size() - 1) +
                          b * b / static_cast<double>(after.size() - 1));
  const double half = StudentPoint(std::max(1, static_cast<int>(degrees))) * std::sqrt(a + b);
  estimate.low = estimate.value - half;
  estimate.high = estimate.value + half;
  return estimate;
}

/// What of a figure's runs is compared: logarithms of the samples of one, of the medians of
/// several.
std::vector<double> ComparedOf(const std::vector<Run>& runs, const std::string& name) {
  if (runs.size() == 1) {
    return Logarithms(MediansOfParts(Find(runs[0], name)->samples, kMostParts));
  }
  std::vector<double> medians;
  for (const Run& run : runs) medians.push_back(Median(Find(run, name)->samples));
  return Logarithms(medians);
}

FigureChange ChangeOf(const Figure& figure, const std::vector<Run>& before,
                      const std::vector<Run>& after) {
  const std::vector<double> a = ComparedOf(before, figure.name), b = ComparedOf(after, figure.name);
  Estimate difference;
  if (before.size() == 1) {
    difference = EstimateDifference(a, b);
  } else {
    std::vector<double> differences;
    for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(b[i] - a[i]);
    difference = EstimateMean(differences);
    if (AreAllAlike(differences)) difference.low = difference.high = kNaN;
  }
  const Estimate ratio{std::exp(difference.value), std::exp(difference.low),
                       std::exp(difference.high), difference.count};
  return {figure.name, figure.more_is_better, std::exp(EstimateMean(a).value),
          std::exp(EstimateMean(b).value), ratio};
}

/// "0.3.0 of commit 1a2b3c".
std::string DescribeSource(const Run& run) {
  return fmt::format("{} of commit {}", TextAt(run.document, {"machine", "version"}),
                     TextAt(run.document, {"machine", "commit"}));
}

/// "AMD EPYC (family 25, model 17), avx512, 2 threads".
std::string DescribePlace(const Run& run) {
  std::string cpu = TextAt(run.document, {"machine", "cpu"});
  if (Says(run, {"machine", "cpu_family"}) && Says(run, {"machine", "cpu_model"})) {
    cpu += fmt::format(" (family {}, model {})", TextAt(run.document, {"machine", "cpu_family"}),
                       TextAt(run.document, {"machine", "cpu_model"}));
  }
  return fmt::format("{}, {}, {} threads", cpu, TextAt(run.document, {"machine", "simd"}),
                     TextAt(run.document, {"threads"}));
}

/// What the runs say there, each once; empty if none says anything.
std::string TextsAt(const std::vector<Run>& runs, const std::vector<std::string>& keys) {
  std::vector<std::string> texts;
  for (const Run& run : runs) {
    const std::string text = TextAt(run.document, keys);
    const bool is_known = std::find(texts.begin(), texts.end(), text) != texts.end();
    if (Says(run, keys) && !is_known) texts.push_back(text);
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::vector<SettingChange> DifferingSettings(const std::vector<Run>& before,
                                             const std::vector<Run>& after) {
  std::vector<SettingChange> differing;
  for (const std::vector<std::string>& keys : {std::vector<std::string>{"machine", "compiler"},
                                               {"machine", "build_type"},
                                               {"machine", "libtorch"},
                                               {"machine", "libtorch_openblas"},
                                               {"machine", "cpu_stepping"},
                                               {"task_hash"}}) {
    const std::string a = TextsAt(before, keys), b = TextsAt(after, keys);
    if (!a.empty() && !b.empty() && a != b) differing.push_back({keys.back(), a, b});
  }
  return differing;
}

std::string Verdict(const FigureChange& change) {
  if (std::isnan(change.ratio.low)) return "one sample, or all alike: no interval";
  if (!IsBeyondNoise(change)) return "within noise";
  const bool is_better = (change.ratio.value > 1) == change.more_is_better;
  return fmt::format("{} by {:.1f} %", is_better ? "better" : "worse",
                     100 * std::abs(change.ratio.value - 1));
}

}  // namespace

BenchComparison CompareBenchmarks(const std::vector<std::string>& before,
                                  const std::vector<std::string>& after, bool other_machine) {
  if (before.size() != after.size()) {
    throw UsageError(fmt::format("{} before and {} after: as many are needed, measured in turns",
                                 Counted(static_cast<int>(before.size()), "run"),
                                 Counted(static_cast<int>(after.size()), "run")));
  }
  const std::vector<Run> old_runs = ReadRuns(before), new_runs = ReadRuns(after);
  const Run &first = old_runs[0], &first_after = new_runs[0];
  RequireComparable(first, first_after, other_machine);
  for (const Run& run : old_runs) RequireComparable(first, run, false);
  for (const Run& run : new_runs) RequireComparable(first_after, run, false);
  if (other_machine) {
    RequireOneKindOfProcessor(old_runs);
    RequireOneKindOfProcessor(new_runs);
  } else {
    std::vector<Run> all = old_runs;
    all.insert(all.end(), new_runs.begin(), new_runs.end());
    RequireOneKindOfProcessor(all);
  }
  BenchComparison comparison;
  comparison.benchmark = TextAt(first.document, {"benchmark"});
  comparison.runs = static_cast<int>(before.size());
  comparison.machine = DescribePlace(first);
  if (const std::string other = DescribePlace(first_after); other != comparison.machine) {
    comparison.machine += "; after: " + other;
  }
  comparison.before = DescribeSource(first);
  comparison.after = DescribeSource(first_after);
  comparison.differing = DifferingSettings(old_runs, new_runs);
  for (const Figure* const figure : AllFigures(old_runs, new_runs)) {
    if (IsInAll(old_runs, figure->name) && IsInAll(new_runs, figure->name)) {
      comparison.changes.push_back(ChangeOf(*figure, old_runs, new_runs));
    } else {
      comparison.unmatched.push_back(figure->name);
    }
  }
  return comparison;
}

bool IsBeyondNoise(const FigureChange& change) {
  return change.ratio.low > 1 || change.ratio.high < 1;
}

std::string ToText(const BenchComparison& comparison) {
  std::string text = fmt::format("bench {}: {} before and after; {}\n  before  {}\n  after   {}\n",
                                 comparison.benchmark, Counted(comparison.runs, "run"),
                                 comparison.machine, comparison.before, comparison.after);
  if (!comparison.differing.empty()) {
    std::vector<std::string> texts;
    for (const SettingChange& change : comparison.differing) {
      texts.push_back(
          fmt::format("{} {} before, {} after", change.name, change.before, change.after));
    }
    text += fmt::format("  differ  {}\n", fmt::join(texts, "; "));
  }
  std::vector<std::vector<std::string>> rows{
      {"figure", "before", "after", "ratio", "95 % interval", ""}};
  for (const FigureChange& change : comparison.changes) {
    const Estimate& ratio = change.ratio;
    const std::string interval =
        std::isnan(ratio.low) ? "-" : fmt::format("{:.4f} to {:.4f}", ratio.low, ratio.high);
    rows.push_back({change.name, fmt::format("{:.5g}", change.before),
                    fmt::format("{:.5g}", change.after), fmt::format("{:.4f}", ratio.value),
                    interval, Verdict(change)});
  }
  text += InColumns(rows);
  if (!comparison.unmatched.empty()) {
    text += fmt::format("not in all runs: {}\n", fmt::join(comparison.unmatched, ", "));
  }
  text += comparison.runs == 1
              ? "One run each: what differs from run to run is not in the intervals."
              : "Medians of runs, in pairs.";
  return text;
}

Json ToJson(const BenchComparison& comparison) {
  Json figures = Json::object();
  for (const FigureChange& change : comparison.changes) {
    figures[change.name] = {{"before", change.before},
                            {"after", change.after},
                            {"ratio", change.ratio.value},
                            {"low", NumberOrNull(change.ratio.low)},
                            {"high", NumberOrNull(change.ratio.high)},
                            {"beyond_noise", IsBeyondNoise(change)}};
  }
  Json differing = Json::object();
  for (const SettingChange& change : comparison.differing) {
    differing[change.name] = {{"before", change.before}, {"after", change.after}};
  }
  return {{"benchmark", comparison.benchmark},
          {"runs", comparison.runs},
          {"machine", comparison.machine},
          {"before", comparison.before},
          {"after", comparison.after},
          {"differing", differing},
          {"figures", figures}};
}

}  // namespace skein
