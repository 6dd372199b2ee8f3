// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/range.h"

namespace skein {

/// A suffix of a number and what it multiplies it with.
struct Unit {
  const char* suffix;
  double factor;
};
using Units = std::vector<Unit>;

/// A condition as it was asked for, for messages.
struct LevelRequest {
  std::string name, level;
  const char* form;      ///< what a level looks like
  bool is_held = false;  ///< not the start alone, but the targets, too

  /// Throws Error: `part` of the level cannot be read.
  [[noreturn]] void Refuse(const std::string& part) const;
  /// Throws Error: `number`, "10mps", has a unit that is none of these, or ends in what is no unit.
  [[noreturn]] void RefuseUnit(const std::string& number, const std::string& unit,
                               const Units& units) const;
  /// Throws Error: a number needs one of the units.
  [[noreturn]] void RefuseWithoutUnit(const std::string& number, const Units& units) const;
  /// Throws Error: `range` from `low` to `high`, "the range 2..1", has its ends exchanged.
  [[noreturn]] void RefuseReversed(const std::string& range, const std::string& low,
                                   const std::string& high) const;
};

// What follows throws Error by the request on what cannot be read.

bool StartsWithDigit(const std::string& text);

/// `text` as a number with one of the units.
double ParseNumber(const std::string& text, const Units& units, const LevelRequest& request);

/// "A..B" in its two parts; a text without ".." is both.
std::pair<std::string, std::string> SplitRange(const std::string& text);

/// "A", "A..B" or "A..Bunit": then the unit is A's, too.
Range ParseRange(const std::string& text, const Units& units, const LevelRequest& request);

/// What stands between commas.
std::vector<std::string> SplitParts(const std::string& level);

}  // namespace skein
