// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/reference/plant.h"
#include "src/files/csv_columns.h"

namespace skein {

/// Where a flight with the columns of files of flights leaves the tables that its model is made of,
/// in words: "after 3.2 s the Mach number is outside the engine's tables (0 to 1)", once for each
/// quantity that is in them at first. Beyond them a table is taken for its end.
std::vector<std::string> LeftTables(const Plant& plant, const CsvColumns& flight);

}  // namespace skein
