// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace skein {

/// A table of numbers, a column at a time.
struct CsvColumns {
  std::vector<std::string> names;
  /// [column][row]; NaN where a cell holds no number, or none that float32 holds.
  std::vector<std::vector<double>> values;
  std::vector<std::string> words;  ///< [row] of the column that was asked for as text
  int rows_left_out = 0;           ///< torn ones: not as many cells as the header, or no end

  std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }
  /// Null if there is no such column.
  const std::vector<double>* Find(const std::string& name) const;
};

/// Reads CSV without quotes, as metrics.csv and files of flights are, also where another program
/// has written a byte order mark ahead, or ends of lines of Windows. A row that a crash has cut
/// short is left out and counted; so is one of another length. Text that is empty has no columns.
/// The cells of `word_column`, if there is one, are kept as text, too.
CsvColumns ParseCsv(const std::string& text, const std::string& word_column = "");

}  // namespace skein
