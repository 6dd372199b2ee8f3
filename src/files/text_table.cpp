// SPDX-License-Identifier: Apache-2.0
#include "src/files/text_table.h"

#include <fmt/format.h>

namespace skein {
namespace {

constexpr std::size_t kGap = 2;  // between columns, at least

std::string EndOf(const std::string& text, std::size_t width) {
  const std::size_t room = width - kGap;
  return text.size() <= room ? text : ".." + text.substr(text.size() - room + 2);
}

}  // namespace

std::string Counted(int count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

void TextTable::Begin(const std::string& label) {
  line_ = fmt::format("{:{}}", EndOf(label, label_width_), label_width_);
}

void TextTable::Cell(const std::string& cell) {
  line_ += fmt::format("{:>{}}", EndOf(cell, cell_width_), cell_width_);
}

void TextTable::End() {
  line_.erase(line_.find_last_not_of(' ') + 1);
  *text_ += line_ + "\n";
}

}  // namespace skein
