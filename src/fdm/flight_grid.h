// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/fdm/steady_flight.h"

namespace skein {

/// The same manoeuvre at every altitude and speed, or every altitude and Mach number.
struct FlightGrid {
  SteadyFlightRequest manoeuvre;               ///< but for altitude and speed
  std::vector<double> altitude_ft, speed_fps;  ///< ascending, for what is described or drawn
  std::vector<double> mach = {};               ///< in place of speeds, ascending

  /// Speeds, ft/s, or Mach numbers: what the points at one altitude differ by.
  const std::vector<double>& speeds() const { return mach.empty() ? speed_fps : mach; }
  std::size_t CountPoints() const { return altitude_ft.size() * speeds().size(); }
  bool IsOnePoint() const { return CountPoints() == 1; }
  /// Throws UsageError of more than 100,000 points.
  void CheckSize() const;
  /// A Mach number is that in the plant's atmosphere at the altitude.
  SteadyFlightRequest At(const Plant& plant, std::size_t altitude, std::size_t speed) const;
};

/// Whether and how it is flown at one point.
struct GridPoint {
  SteadyFlightRequest request;
  std::optional<SteadyFlight> flight;
  std::vector<ExceededLimit> limits;  ///< why it is not, the first reason first

  bool IsFlown() const { return limits.empty(); }
};

/// A point's letter and words in the picture of a grid; of none: flown.
char LetterOf(std::optional<FlightLimit> limit);
const char* WordsOf(std::optional<FlightLimit> limit);

/// The points of a grid: altitude by altitude, at each speed by speed.
class FlownGrid {
 public:
  /// Trims every point. Throws UsageError as CheckSize, and of a turn that is a pull-up.
  FlownGrid(const Plant& plant, FlightGrid grid);

  const FlightGrid& grid() const { return grid_; }
  const std::vector<GridPoint>& points() const { return points_; }
  const GridPoint& At(std::size_t altitude, std::size_t speed) const {
    return points_[altitude * grid_.speeds().size() + speed];
  }

  /// A map of letters, and of every altitude the slowest and the fastest speed, in a wind those
  /// over ground, too, and the greatest excess power. Of axes that ascend.
  std::string Describe() const;
  /// A line for every point, behind one of names.
  std::string Csv() const;

 private:
  std::string Map() const;
  std::string DescribeRow(std::size_t altitude) const;
  /// Of the column of speeds over ground, which is there in a wind alone.
  std::string GroundCell(const std::string& text) const;

  FlightGrid grid_;
  std::vector<GridPoint> points_;
};

/// A point of a grid, or a flight alone, for JSON files.
nlohmann::ordered_json ToJson(const GridPoint& point);
nlohmann::ordered_json ToJson(const SteadyFlight& flight);

}  // namespace skein
