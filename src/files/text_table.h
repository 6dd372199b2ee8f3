// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace skein {

/// "1 episode", "2 episodes".
std::string Counted(int count, const std::string& noun);

/// Appends rows to a text for people: a label at the left, cells at the right of their columns. Of
/// what is too wide for its column the end is shown, behind "..".
class TextTable {
 public:
  TextTable(std::size_t label_width, std::size_t cell_width, std::string* text)
      : label_width_(label_width), cell_width_(cell_width), text_(text) {}

  void Begin(const std::string& label);
  void Cell(const std::string& cell);
  void End();

 private:
  std::size_t label_width_, cell_width_;
  std::string* text_;
  std::string line_;
};

}  // namespace skein
