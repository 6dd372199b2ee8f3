// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/left_tables.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein {
namespace {

/// The axis of a table, and the column of a flight that moves along it.
struct TableAxis {
  const char* column;
  const char* quantity;
  const char* tables;
  const char* unit;
  const std::vector<double>& values;
};

}  // namespace

std::vector<std::string> LeftTables(const Plant& plant, const CsvColumns& flight) {
  const EngineTables& engine = plant.aircraft().engine;
  const AerodynamicTables& aerodynamics = plant.aircraft().aerodynamics;
  const std::vector<double>& time = *flight.Find("time_s");
  std::vector<std::string> left;
  for (const TableAxis& axis :
       {TableAxis{"altitude_ft", "altitude", "engine's", " ft", engine.altitude_ft},
        TableAxis{"mach", "Mach number", "engine's", "", engine.mach},
        TableAxis{"alpha_deg", "angle of attack", "aerodynamic", " deg", aerodynamics.alpha_deg},
        TableAxis{"beta_deg", "sideslip", "aerodynamic", " deg", aerodynamics.beta_deg}}) {
    const double low = axis.values.front(), high = axis.values.back();
    const std::vector<double>& flown = *flight.Find(axis.column);
    const auto outside = std::find_if(flown.begin(), flown.end(), [low, high](double value) {
      return value < low || value > high;
    });
    if (outside == flown.begin() || outside == flown.end()) continue;
    left.push_back(fmt::format("after {} s the {} is outside the {} tables ({:.6g} to {:.6g}{})",
                               time[static_cast<std::size_t>(outside - flown.begin())],
                               axis.quantity, axis.tables, low, high, axis.unit));
  }
  return left;
}

}  // namespace skein
