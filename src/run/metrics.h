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
/// `control_steps` were flown in the iteration, by all aircraft together.
std::vector<std::pair<std::string, double>> Scalars(const IterationReport& report,
                                                    double control_steps);

/// Drops the rows of the CSV file at `path` that are torn or whose first column is above
/// `iteration`, and gives the columns the names of `header`, as an older version may have called
/// them otherwise, and empty cells to columns that it did not have; does nothing if there is no
/// file. Returns the number of rows left. Throws Error on a file that cannot be read or replaced,
/// or has more columns.
std::uint64_t TrimRows(const std::string& path, std::uint64_t iteration, const std::string& header);

}  // namespace skein
