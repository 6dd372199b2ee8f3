// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "train/ppo/trainer.h"

namespace skein {

/// The header of metrics.csv, newline included.
std::string MetricsHeader();
/// One row of metrics.csv: only what is a function of the configuration, so that runs can be
/// compared byte for byte. Cells without a value (no episode ended, no evaluation) are empty.
std::string MetricsRow(const IterationReport& report);

/// timing.csv: the seconds of each iteration.
std::string TimingHeader();
std::string TimingRow(const IterationReport& report, double unix_time_s);

/// The report as named scalars for TensorBoard; values that do not exist are left out.
std::vector<std::pair<std::string, double>> Scalars(const IterationReport& report);

/// Drops the rows of the CSV file at `path` that are torn or whose first column is above
/// `iteration`; does nothing if there is no file. Returns the number of rows left. Throws Error on
/// a file that cannot be read or replaced.
std::uint64_t TrimRows(const std::string& path, std::uint64_t iteration);

}  // namespace skein
