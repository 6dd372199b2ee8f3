// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/tasks/task.h"
#include "src/evaluation/flight_table.h"
#include "src/replay/acmi_writer.h"

namespace skein {

/// As an object's transform, of a place and an attitude in feet and degrees.
struct FlatPlace {
  double north_ft = 0, east_ft = 0, altitude_ft = 0;
  double roll_deg = 0, pitch_deg = 0, yaw_deg = 0;
};
AcmiTransform TransformOf(const FlatPlace& place);

/// How a flight's target is shown: a point where it lies; what is no point, a heading, a pitch, a
/// speed, as a marker one nautical mile ahead of the aircraft in the direction asked for, at the
/// altitude asked for.
class AcmiTarget {
 public:
  /// Both must live as long as it.
  AcmiTarget(const std::vector<TargetQuantity>& quantities, const FlightTable& flight);

  /// In words: "altitude 6096 +- 30.5 m, yaw 10 +- 5 deg".
  std::string Describe(std::size_t row) const;
  AcmiTransform Place(std::size_t row) const;
  /// What its tolerances measure, m: of a marker, as far as they have a height and a width there.
  std::vector<AcmiProperty> Size() const;
  /// Whether the target is another than in the row before.
  bool IsNew(std::size_t row) const;

 private:
  /// Null if there is no such target.
  const TargetQuantity* Find(const std::string& column) const;
  /// The target's value, or `otherwise`.
  double ValueAt(std::size_t row, const std::string& column, double otherwise) const;
  bool IsPoint() const;

  const std::vector<TargetQuantity>& quantities_;
  const FlightTable& flight_;
};

}  // namespace skein
