// SPDX-License-Identifier: Apache-2.0
#include "src/files/text_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein {
namespace {

constexpr std::size_t kGap = 2;  // between columns, at least
constexpr std::size_t kLineWidth = 100;

std::string EndOf(const std::string& text, std::size_t width) {
  const std::size_t room = width - kGap;
  return text.size() <= room ? text : ".." + text.substr(text.size() - room + 2);
}

/// `name` in lines of at most `width` bytes, the gap among them, none of which ends within a
/// character.
std::vector<std::string> HeadingLines(std::string name, std::size_t width) {
  const std::size_t room = width - kGap;
  std::vector<std::string> lines;
  while (name.size() > room) {
    const std::size_t slash = name.rfind('/', room - 1);
    std::size_t length = slash == std::string::npos ? room : slash + 1;
    while (length > 1 && (name[length] & 0xC0) == 0x80) --length;  // UTF-8
    lines.push_back(name.substr(0, length));
    name.erase(0, length);
  }
  lines.push_back(name);
  return lines;
}

}  // namespace

std::string Counted(int count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string InLines(const std::string& begin, const std::vector<std::string>& parts,
                    const std::string& gap) {
  const std::string end = gap.substr(0, gap.find(' '));
  std::string text, line = begin;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t width = line.size() + gap.size() + parts[i].size() + end.size();
    if (i > 0 && width > kLineWidth) {
      text += line + end + "\n";
      line = std::string(begin.size(), ' ') + parts[i];
    } else {
      line += (i == 0 ? "" : gap) + parts[i];
    }
  }
  return text + line;
}

std::string InLines(const std::string& begin, const std::string& text) {
  const std::string gap = "; ";
  std::vector<std::string> parts;
  std::size_t at = 0;
  for (std::size_t end; (end = text.find(gap, at)) != std::string::npos; at = end + gap.size()) {
    parts.push_back(text.substr(at, end - at));
  }
  parts.push_back(text.substr(at));
  return InLines(begin, parts, gap);
}

std::string InColumns(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += i + 1 == row.size() ? row[i] : fmt::format("{:{}}", row[i], widths[i] + kGap);
    }
    text += "\n";
  }
  return text;
}

void TextTable::Headings(const std::vector<std::string>& names) {
  std::vector<std::vector<std::string>> columns;
  std::size_t most = 0;
  for (const std::string& name : names) {
    columns.push_back(HeadingLines(name, cell_width_));
    most = std::max(most, columns.back().size());
  }
  for (std::size_t line = 0; line < most; ++line) {
    Begin("");
    for (const std::vector<std::string>& column : columns) {
      const std::size_t blank = most - column.size();
      Cell(line < blank ? "" : column[line - blank]);
    }
    End();
  }
}

void TextTable::Begin(const std::string& label) {
  line_ = fmt::format("{:{}}", EndOf(label, label_width_), label_width_);
}

void TextTable::Cell(const std::string& cell) {
  line_ += fmt::format("{:>{}}", cell, std::max(cell_width_, cell.size() + kGap));
}

void TextTable::Name(const std::string& name) { Cell(EndOf(name, cell_width_)); }

void TextTable::End() {
  line_.erase(line_.find_last_not_of(' ') + 1);
  *text_ += line_ + "\n";
}

}  // namespace skein
