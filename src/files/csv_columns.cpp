// SPDX-License-Identifier: Apache-2.0
#include "src/files/csv_columns.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace skein {
namespace {

std::vector<std::string_view> CellsOf(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

/// Without the byte order mark that other programs begin UTF-8 with.
std::string_view WithoutMark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.substr(0, kMark.size()) == kMark) text.remove_prefix(kMark.size());
  return text;
}

/// Without what Windows puts before the end of a line.
std::string_view WithoutReturn(std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

double NumberIn(std::string_view cell) {
  double value = 0;
  const auto [stop, failure] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool is_number = failure == std::errc() && stop == cell.data() + cell.size() &&
                         std::abs(value) <= std::numeric_limits<float>::max();
  return is_number ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

const std::vector<double>* CsvColumns::Find(const std::string& name) const {
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k] == name) return &values[k];
  }
  return nullptr;
}

CsvColumns ParseCsv(const std::string& text, const std::string& word_column) {
  CsvColumns table;
  std::string_view rest = WithoutMark(text);
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    const bool is_whole = end != std::string_view::npos;
    const std::vector<std::string_view> cells = CellsOf(WithoutReturn(rest.substr(0, end)));
    rest.remove_prefix(is_whole ? end + 1 : rest.size());
    if (!is_whole || (!table.names.empty() && cells.size() != table.names.size())) {
      ++table.rows_left_out;
    } else if (table.names.empty()) {
      table.names.assign(cells.begin(), cells.end());
      table.values.resize(cells.size());
    } else {
      for (std::size_t k = 0; k < cells.size(); ++k) {
        table.values[k].push_back(NumberIn(cells[k]));
        if (table.names[k] == word_column) table.words.emplace_back(cells[k]);
      }
    }
  }
  return table;
}

}  // namespace skein
