// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein {

/// What a column's name says.
struct ColumnWords {
  std::string quantity;  ///< "true airspeed" of true_airspeed_fps
  std::string unit;      ///< "ft/s" of it; empty of a name that ends in none
};
ColumnWords ColumnWordsOf(const std::string& column);

/// "target reached" of the name target_reached.
std::string WithBlanks(std::string name);

}  // namespace skein
