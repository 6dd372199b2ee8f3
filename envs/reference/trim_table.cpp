// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/trim_table.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "envs/aircraft/table_lookup.h"
#include "envs/reference/trim.h"

namespace skein {
namespace {

std::vector<double> EvenNodes(double min, double max, int count) {
  if (min == max) return {min};
  std::vector<double> nodes;
  for (int i = 0; i < count; ++i) nodes.push_back(min + (max - min) * i / (count - 1));
  return nodes;
}

/// `gravity_g` is what the wing must hold up, in multiples of kGravityFtS2.
TrimmedStart Summary(const TrimPoint& point, double gravity_g) {
  TrimmedStart start;
  start.alpha_rad = point.alpha_rad;
  start.bank_rad = point.bank_rad;
  start.pitch_rad = point.pitch_rad;
  start.elevator_deg = point.controls.elevator_deg;
  start.aileron_deg = point.controls.aileron_deg;
  start.rudder_deg = point.controls.rudder_deg;
  start.leading_edge_flap_deg = point.controls.leading_edge_flap_deg;
  start.power = point.power;
  start.nz = gravity_g * std::cos(point.pitch_rad) * std::cos(point.bank_rad);
  start.ny = -gravity_g * std::cos(point.pitch_rad) * std::sin(point.bank_rad);
  return start;
}

TrimmedStart Blend(const TrimmedStart& a, const TrimmedStart& b, double fraction) {
  const auto blend = [&](double TrimmedStart::*member) {
    return a.*member + (b.*member - a.*member) * fraction;
  };
  TrimmedStart result;
  for (double TrimmedStart::*member :
       {&TrimmedStart::alpha_rad, &TrimmedStart::bank_rad, &TrimmedStart::pitch_rad,
        &TrimmedStart::elevator_deg, &TrimmedStart::aileron_deg, &TrimmedStart::rudder_deg,
        &TrimmedStart::leading_edge_flap_deg, &TrimmedStart::power, &TrimmedStart::nz,
        &TrimmedStart::ny}) {
    result.*member = blend(member);
  }
  return result;
}

/// Like Locate, for an axis that may have only one node.
GridCell LocateNode(const std::vector<double>& axis, double x) {
  return axis.size() == 1 ? GridCell{} : Locate(axis, x);
}

}  // namespace

TrimTable::TrimTable(const Plant& plant, double min_altitude_ft, double max_altitude_ft,
                     double min_speed_ft_s, double max_speed_ft_s, int altitude_nodes,
                     int speed_nodes) {
  if (!(min_altitude_ft <= max_altitude_ft) || !(min_speed_ft_s <= max_speed_ft_s)) {
    throw Error("a trim table needs ranges with min <= max; asked for altitudes " +
                std::to_string(min_altitude_ft) + " to " + std::to_string(max_altitude_ft) +
                " ft, speeds " + std::to_string(min_speed_ft_s) + " to " +
                std::to_string(max_speed_ft_s) + " ft/s");
  }
  if (altitude_nodes < 2 || speed_nodes < 2) {
    throw Error("a trim table needs at least 2 nodes along each range; asked for " +
                std::to_string(altitude_nodes) + " x " + std::to_string(speed_nodes));
  }
  altitude_ft_ = EvenNodes(min_altitude_ft, max_altitude_ft, altitude_nodes);
  speed_ft_s_ = EvenNodes(min_speed_ft_s, max_speed_ft_s, speed_nodes);
  for (const double altitude : altitude_ft_) {
    // From fast to slow: the fast end trims from any start, and each trim leads to its neighbour.
    std::vector<TrimmedStart> row(speed_ft_s_.size());
    TrimPoint previous;
    for (int j = static_cast<int>(speed_ft_s_.size()) - 1; j >= 0; --j) {
      TrimRequest request;
      request.altitude_ft = altitude;
      request.true_airspeed_ft_s = speed_ft_s_[j];
      const bool first = j + 1 == static_cast<int>(speed_ft_s_.size());
      previous = first ? Trim(plant, request) : Trim(plant, request, previous);
      row[j] = Summary(previous, plant.gravity().At(altitude) / kGravityFtS2);
    }
    nodes_.insert(nodes_.end(), row.begin(), row.end());
  }
}

TrimmedStart TrimTable::At(double altitude_ft, double true_airspeed_ft_s) const {
  const GridCell i = LocateNode(altitude_ft_, altitude_ft);
  const GridCell j = LocateNode(speed_ft_s_, true_airspeed_ft_s);
  const int columns = static_cast<int>(speed_ft_s_.size());
  const int next_row = altitude_ft_.size() == 1 ? 0 : columns;
  const int next_column = columns == 1 ? 0 : 1;
  const TrimmedStart* node = nodes_.data() + i.index * columns + j.index;
  return Blend(Blend(node[0], node[next_column], j.fraction),
               Blend(node[next_row], node[next_row + next_column], j.fraction), i.fraction);
}

}  // namespace skein
