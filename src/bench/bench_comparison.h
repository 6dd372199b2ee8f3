// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/evaluation/estimate.h"

namespace skein {

/// How a figure changed.
struct FigureChange {
  std::string name;
  bool more_is_better = false;
  double before = 0, after = 0;  ///< geometric means of what the ratio is estimated from
  Estimate ratio;                ///< after / before, with its 95 % interval (NaN: none)
};

/// What the runs of either side say of how they were measured, where that is not the same.
struct SettingChange {
  std::string name;           ///< "compiler", as in the files
  std::string before, after;  ///< of several runs every one that is said, with commas between
};

/// What two sets of runs of one benchmark, `skein bench ... --json`, say of each other.
struct BenchComparison {
  std::string benchmark;
  int runs = 0;  ///< on either side
  /// On what and by what the first run of either side was measured, for people.
  std::string machine, before, after;
  std::vector<FigureChange> changes;
  /// Of compiler, build type, LibTorch, stepping of the processor and hash of the task file: what
  /// both sides say, and not alike.
  std::vector<SettingChange> differing;
  std::vector<std::string> unmatched;  ///< figures that not all runs have
};

/// The runs in the files `before`, and as many in `after`. Of one run on either side the samples
/// are compared (Welch's t of their logarithms, in at most ten parts, as what is measured in a row
/// is alike); of several the medians, in pairs in the order of the files (Student's t of the
/// logarithms of their ratios): that holds what differs from run to run, too. Throws UsageError if
/// they are not as many, not of one benchmark with the same settings, or, unless `other_machine`,
/// not of one processor (also by family and model, where both say them), SIMD target and number of
/// threads; Error of a file that cannot be read, or is not of a benchmark that measures figures.
BenchComparison CompareBenchmarks(const std::vector<std::string>& before,
                                  const std::vector<std::string>& after, bool other_machine);

/// Whether the interval excludes that nothing has changed.
bool IsBeyondNoise(const FigureChange& change);

/// A table for people; without a newline at the end.
std::string ToText(const BenchComparison& comparison);

/// Keys: benchmark, runs, machine, before, after, differing: by name before, after; figures: by
/// name before, after, ratio, low, high (null: no interval), beyond_noise.
nlohmann::ordered_json ToJson(const BenchComparison& comparison);

}  // namespace skein
