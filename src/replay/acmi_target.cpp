// SPDX-License-Identifier: Apache-2.0
#include "src/replay/acmi_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "envs/aircraft/aircraft.h"
#include "envs/aircraft/units.h"
#include "src/files/column_words.h"
#include "src/replay/flat_earth.h"

namespace skein {
namespace {

constexpr double kMarkerDistance_ft = 6076.115;  // a nautical mile

/// A unit of ACMI files, and how many of it one of the column's own is.
struct AcmiUnit {
  std::string name;
  double factor;
};

AcmiUnit AcmiUnitOf(const std::string& unit) {
  if (unit == "ft") return {"m", kMetresPerFoot};
  if (unit == "ft/s") return {"m/s", kMetresPerFoot};
  return {unit, 1};
}

/// Of Mach numbers and other ratios, three.
int DecimalsWithoutTolerance(const AcmiUnit& unit) { return unit.name.empty() ? 3 : 1; }

/// One, and more where a tolerance needs them for two significant digits.
int DecimalsFor(double tolerance) {
  constexpr double kMostDecimals = 9;
  return static_cast<int>(std::clamp(1 - std::floor(std::log10(tolerance)), 1.0, kMostDecimals));
}

std::string Metres(double feet) { return AcmiNumber(feet * kMetresPerFoot, 2); }

}  // namespace

AcmiTransform TransformOf(const FlatPlace& place) {
  const double north_m = place.north_ft * kMetresPerFoot, east_m = place.east_ft * kMetresPerFoot;
  const GeographicOffset offset = GeographicOffsetOf(north_m, east_m);
  // Brought to 0 .. 360 after it was rounded, or there would be 360.
  const double heading = std::fmod(std::round(place.yaw_deg * 100) / 100 + 360, 360);
  return {AcmiNumber(offset.longitude_deg, 7),
          AcmiNumber(offset.latitude_deg, 7),
          Metres(place.altitude_ft),
          AcmiNumber(place.roll_deg, 2),
          AcmiNumber(place.pitch_deg, 2),
          AcmiNumber(heading, 2),
          Metres(place.east_ft),
          Metres(place.north_ft),
          AcmiNumber(heading, 2)};
}

AcmiTarget::AcmiTarget(const std::vector<TargetQuantity>& quantities, const FlightTable& flight)
    : quantities_(quantities), flight_(flight) {}

const TargetQuantity* AcmiTarget::Find(const std::string& column) const {
  for (const TargetQuantity& quantity : quantities_) {
    if (column == quantity.column) return &quantity;
  }
  return nullptr;
}

double AcmiTarget::ValueAt(std::size_t row, const std::string& column, double otherwise) const {
  return Find(column) == nullptr ? otherwise : flight_.Column("target_" + column)[row];
}

bool AcmiTarget::IsPoint() const {
  return Find("north_ft") != nullptr && Find("east_ft") != nullptr;
}

std::string AcmiTarget::Describe(std::size_t row) const {
  std::string text;
  for (const TargetQuantity& quantity : quantities_) {
    const ColumnWords words = ColumnWordsOf(quantity.column);
    const AcmiUnit unit = AcmiUnitOf(words.unit);
    const double value = flight_.Column(std::string("target_") + quantity.column)[row];
    const double tolerance = quantity.tolerance * unit.factor;
    const int decimals = tolerance > 0 ? DecimalsFor(tolerance) : DecimalsWithoutTolerance(unit);
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", words.quantity,
                        AcmiNumber(value * unit.factor, decimals));
    if (tolerance > 0) text += fmt::format(" +- {}", AcmiNumber(tolerance, decimals));
    if (!unit.name.empty()) text += " " + unit.name;
  }
  return text;
}

AcmiTransform AcmiTarget::Place(std::size_t row) const {
  const auto flown = [&](const char* column) { return flight_.Column(column)[row]; };
  FlatPlace place;
  if (IsPoint()) {
    place.north_ft = ValueAt(row, "north_ft", 0);
    place.east_ft = ValueAt(row, "east_ft", 0);
    place.altitude_ft = ValueAt(row, "altitude_ft", flown("altitude_ft"));
    return TransformOf(place);
  }
  place.pitch_deg = ValueAt(row, "pitch_deg", 0);
  place.yaw_deg = ValueAt(row, "yaw_deg", flown("yaw_deg"));
  const double pitch = place.pitch_deg / kDegPerRad, yaw = place.yaw_deg / kDegPerRad;
  place.north_ft = flown("north_ft") + kMarkerDistance_ft * std::cos(pitch) * std::cos(yaw);
  place.east_ft = flown("east_ft") + kMarkerDistance_ft * std::cos(pitch) * std::sin(yaw);
  place.altitude_ft =
      ValueAt(row, "altitude_ft", flown("altitude_ft") + kMarkerDistance_ft * std::sin(pitch));
  return TransformOf(place);
}

std::vector<AcmiProperty> AcmiTarget::Size() const {
  std::vector<AcmiProperty> size;
  const auto add = [&](const char* name, double half_ft) {
    size.emplace_back(name, Metres(2 * half_ft));
  };
  // Beyond 45 degrees nothing that is a mile away shows the angle.
  const auto across = [](const TargetQuantity& angle) {
    return kMarkerDistance_ft * std::tan(std::min(45.0, angle.tolerance) / kDegPerRad);
  };
  const TargetQuantity* const altitude = Find("altitude_ft");
  if (IsPoint()) {
    add("Length", Find("north_ft")->tolerance);
    add("Width", Find("east_ft")->tolerance);
  } else if (const TargetQuantity* const yaw = Find("yaw_deg")) {
    add("Width", across(*yaw));
  }
  if (altitude != nullptr) {
    add("Height", altitude->tolerance);
  } else if (const TargetQuantity* const pitch = Find("pitch_deg")) {
    add("Height", across(*pitch));
  }
  return size;
}

bool AcmiTarget::IsNew(std::size_t row) const {
  return row == 0 ||
         std::any_of(quantities_.begin(), quantities_.end(), [&](const TargetQuantity& quantity) {
           const auto& column = flight_.Column(std::string("target_") + quantity.column);
           return column[row] != column[row - 1];
         });
}

}  // namespace skein
