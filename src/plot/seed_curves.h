// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/plot/picture.h"
#include "src/report/run_record.h"

namespace skein {

/// Runs that differ in their seed alone.
struct CurveSetting {
  std::string task, name;
  std::vector<RunRecord> runs;
};

/// The mean of a column over the runs of a setting, and its lowest and highest, against millions of
/// control steps: where all runs have values, at the steps of any.
struct SeedCurve {
  std::vector<PagePoint> mean, low, high;
};

/// Takes the runs out of `settings` that have no value of one of the columns yet, and settings
/// without a run left; a note says which. Throws Error if that is all of them, and ChoiceError on a
/// column that is not there.
void LeaveOutRunsWithoutValues(const std::vector<std::string>& columns,
                               std::vector<CurveSetting>* settings,
                               std::vector<std::string>* notes);

/// Empty if a run has no value of the column yet. Shares are in percent. Throws ChoiceError if
/// the runs have values, but none over the same control steps.
SeedCurve CurveOf(const CurveSetting& setting, const std::string& column);

/// The value at x of a curve of one point or more; beyond its ends that of the end.
double Interpolated(const std::vector<PagePoint>& curve, double x);

/// Of the quickest run: the others had less of their machine. Nothing without recorded times.
std::optional<double> MinutesPerMillion(const CurveSetting& setting);

/// `runs` as settings, in their order: `seeds` in a row, or without it those of one configuration
/// but for the seed. Without `names` a setting has the name of its first run, or that run's path
/// where another setting of the task has the same name. Throws Error on runs of several tasks in
/// one setting, and if there are not as many names as settings.
std::vector<CurveSetting> SettingsOf(std::vector<RunRecord> runs, std::optional<int> seeds,
                                     const std::vector<std::string>& names);

}  // namespace skein
