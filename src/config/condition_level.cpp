// SPDX-License-Identifier: Apache-2.0
#include "src/config/condition_level.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "base/nearest_name.h"

namespace skein {
namespace {

constexpr const char* kDigits = "0123456789.";

}  // namespace

void LevelRequest::Refuse(const std::string& part) const {
  throw Error(fmt::format("--condition {}={}: cannot read \"{}\"{}; {} takes {}", name, level, part,
                          DidYouMean(part, {"mild", "middle", "hard"}), name, form));
}

void LevelRequest::RefuseUnit(const std::string& number, const std::string& unit,
                              const Units& units) const {
  std::vector<std::string> known;
  for (const Unit& one : units) {
    if (one.suffix[0] != '\0') known.emplace_back(one.suffix);
  }
  const bool is_unit = unit.find_first_not_of("abcdefghijklmnopqrstuvwxyz/%") == std::string::npos;
  if (known.empty() || !is_unit) Refuse(number);
  throw Error(fmt::format("--condition {}={}: {} has the unknown unit {}; known: {}", name, level,
                          number, unit, fmt::join(known, ", ")));
}

void LevelRequest::RefuseWithoutUnit(const std::string& number, const Units& units) const {
  std::vector<std::string> forms;
  for (const Unit& unit : units) forms.push_back(number + unit.suffix);
  throw Error(fmt::format("--condition {}={}: {} of what? Write {}", name, level, number,
                          fmt::join(forms, ", ")));
}

void LevelRequest::RefuseReversed(const std::string& range, const std::string& low,
                                  const std::string& high) const {
  throw Error(fmt::format("--condition {}={}: {} is reversed; write {}..{}", name, level, range,
                          high, low));
}

bool StartsWithDigit(const std::string& text) { return text.find_first_of(kDigits) == 0; }

double ParseNumber(const std::string& text, const Units& units, const LevelRequest& request) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, failure] = std::from_chars(text.data(), end, value);
  if (failure != std::errc()) request.Refuse(text);
  const std::string suffix(rest, end);
  for (const Unit& unit : units) {
    if (suffix == unit.suffix) return value * unit.factor;
  }
  if (suffix.empty()) request.RefuseWithoutUnit(text, units);
  request.RefuseUnit(text, suffix, units);
}

std::pair<std::string, std::string> SplitRange(const std::string& text) {
  const auto dots = text.find("..");
  if (dots == std::string::npos) return {text, text};
  return {text.substr(0, dots), text.substr(dots + 2)};
}

Range ParseRange(const std::string& text, const Units& units, const LevelRequest& request) {
  auto [low, high] = SplitRange(text);
  const std::size_t unit = high.find_last_of(kDigits), end = low.find_last_of(kDigits);
  const bool low_has_unit = end + 1 < low.size(), high_has_unit = unit + 1 < high.size();
  if (low_has_unit && !high_has_unit) request.Refuse(text);  // 60kt..120: of what?
  if (!low_has_unit && high_has_unit) {
    const std::string suffix = high.substr(unit + 1);
    const auto is_it = [&suffix](const Unit& known) { return suffix == known.suffix; };
    if (std::none_of(units.begin(), units.end(), is_it)) request.RefuseUnit(text, suffix, units);
    low += suffix;
  }
  const Range range{ParseNumber(low, units, request), ParseNumber(high, units, request)};
  if (range.min > range.max) request.RefuseReversed("the range " + text, low, high);
  return range;
}

std::vector<std::string> SplitParts(const std::string& level) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= level.size();) {
    const std::size_t end = std::min(level.find(',', begin), level.size());
    parts.push_back(level.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

}  // namespace skein
