// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace skein {

/// "1 episode", "2 episodes".
std::string Counted(int count, const std::string& noun);

/// `parts` with `gap` between them, in lines of at most 100 columns where they fit: `begin` and the
/// first ones, then others behind as many blanks. Lines end with what of the gap is not blank.
std::string InLines(const std::string& begin, const std::vector<std::string>& parts,
                    const std::string& gap);
/// The same of a text whose parts have "; " between them.
std::string InLines(const std::string& begin, const std::string& text);

/// Left-aligned columns, each as wide as its widest cell, the last one of a row as it is; lines,
/// each with a newline.
std::string InColumns(const std::vector<std::vector<std::string>>& rows);

/// Appends rows to a text for people: a label at the left, cells at the right of their columns. Of
/// a label that is too wide the end is shown, behind ".."; a cell that is moves the others along:
/// of figures nothing is cut.
class TextTable {
 public:
  TextTable(std::size_t label_width, std::size_t cell_width, std::string* text)
      : label_width_(label_width), cell_width_(cell_width), text_(text) {}

  /// A row of names, none shortened: in as many lines as the longest needs, broken behind its "/"
  /// where that fits.
  void Headings(const std::vector<std::string>& names);
  void Begin(const std::string& label);
  void Cell(const std::string& cell);
  /// A cell that is cut as a label is.
  void Name(const std::string& name);
  void End();

 private:
  std::size_t label_width_, cell_width_;
  std::string* text_;
  std::string line_;
};

}  // namespace skein
