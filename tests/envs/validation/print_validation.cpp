// SPDX-License-Identifier: Apache-2.0
// Prints the tables of docs/explanation/validation.md as JSON: {"NAME": "MARKDOWN TABLE", ...}.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "simd/target.h"
#include "tests/envs/validation/figure.h"

namespace skein::validation {
namespace {

/// A number with its digits after the point; a minus sign before nothing but zeros is left out.
std::string Number(double value, int decimals) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  const std::string number = text;
  const bool is_zero = number.find_first_of("123456789") == std::string::npos;
  return is_zero && number[0] == '-' ? number.substr(1) : number;
}

std::string Row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + cell + " |";
  return row + "\n";
}

/// A small number: as many significant digits as tell.
std::string Small(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string Table(const Section& section) {
  const bool is_corrected = section.correction != nullptr;
  std::vector<std::string> head = {"figure", section.source};
  if (is_corrected) head.emplace_back("their range");
  head.emplace_back("Skein");
  if (is_corrected) head.emplace_back(section.correction);
  head.emplace_back("difference");
  if (!is_corrected) head.emplace_back("held to");
  std::string table = Row(head) + Row(std::vector<std::string>(head.size(), "---"));
  for (const Figure& figure : section.figures) {
    const auto number = [&figure](double value) { return Number(value, figure.decimals); };
    std::vector<std::string> cells = {figure.what, number(figure.published)};
    if (is_corrected) cells.push_back(number(figure.highest - figure.lowest));
    cells.push_back(number(figure.skein));
    if (is_corrected) cells.push_back(number(figure.correction));
    cells.push_back(number(figure.difference()));
    if (!is_corrected) cells.push_back("±" + Small(figure.tolerance));
    table += Row(cells);
  }
  return table;
}

}  // namespace
}  // namespace skein::validation

int main() {
  // Random numbers in float32 differ in their last bits between instruction sets.
  skein::simd::ForceTarget(skein::simd::Target::kScalar);
  nlohmann::ordered_json tables;
  for (const auto& section : skein::validation::AllSections()) {
    tables[section.name] = skein::validation::Table(section);
  }
  std::printf("%s\n", tables.dump(1).c_str());
  return 0;
}
