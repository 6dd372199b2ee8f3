// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "train/ppo/trainer.h"

namespace skein {

/// A cell of metrics.csv.
struct MetricsCell {
  std::string name;       ///< of its column
  double value;           ///< not finite where it is empty
  bool is_count = false;  ///< a whole number that is not negative
};

/// The cells of a row, in the order of the columns.
std::vector<MetricsCell> MetricsCells(const IterationReport& report);
/// The header of metrics.csv, newline included.
std::string MetricsHeader();
/// One row of metrics.csv: only what is a function of the configuration, so that runs can be
/// compared byte for byte. Cells without a value (no episode ended, no evaluation) are empty.
std::string MetricsRow(const IterationReport& report);

/// What passed by the clock from the row before, or the start of the program's part in the run, to
/// this one, s.
struct TurnSeconds {
  double whole = 0;
  double start = 0;  ///< of it, before the first iteration
  double files = 0;  ///< of it, records and checkpoints: those of the iteration before
};

/// timing.csv: the seconds of each iteration.
std::string TimingHeader();
std::string TimingRow(const IterationReport& report, double unix_time_s, const TurnSeconds& turn);

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
