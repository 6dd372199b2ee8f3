// SPDX-License-Identifier: Apache-2.0
// What a task file draws, and the terrain below it.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/ends_with.h"
#include "base/error.h"
#include "envs/aircraft/aircraft.h"
#include "src/config/table_reader.h"
#include "src/config/task_checks.h"
#include "src/config/task_sections.h"
#include "src/config/term_numbers.h"

namespace skein {
namespace {

bool CanBeAroundStart(const TermTarget& target) {
  switch (target.quantity.value) {
    case TermValue::kAltitude:
    case TermValue::kTrueAirspeed:
    case TermValue::kPitch:
    case TermValue::kYaw:
    case TermValue::kRoll:
    case TermValue::kNorth:
    case TermValue::kEast:
      return true;
    default:
      return false;
  }
}

bool IsPartOfPoint(const TermTarget& other, const TermTarget& target) {
  const TermValue value = target.quantity.value;
  return other.draw_from == TermTarget::Draw::kPoint &&
         (value == TermValue::kNorth || value == TermValue::kEast || value == TermValue::kAltitude);
}

/// Of lengths and speeds the aircraft's own, of angles a radian, of rates a radian per second.
TermUnit UsualUnit(const TermTarget& target) {
  const std::string& name = target.quantity.name;
  if (name == "point" || EndsWith(name, "_ft")) return {ReferenceUnit::kAltitudeError, 1};
  if (EndsWith(name, "_fps")) return {ReferenceUnit::kSpeed, 1};
  if (EndsWith(name, "_deg_s")) return {ReferenceUnit::kNone, kDegPerRad};
  return {};
}

void ReadPoint(TableReader& own, const TermTaskConfig& task, TermTarget* target) {
  target->name = own.Text("name", "point");
  target->draw_from = TermTarget::Draw::kPoint;
  target->quantity.name = "point";
  target->quantity.value = TermValue::kPointNorth;
  target->distance_ft = own.NumberRange("distance_ft", {0, 1e6}).value_or(Range{0, 0});
  if (target->distance_ft.max <= 0 || target->distance_ft.min < 0) {
    own.RefuseLack({"distance_ft"}, "a point needs distance_ft = [from, to], to above 0");
  }
  target->azimuth_deg = own.Number("azimuth_deg", {0, 180}).value_or(0);
  target->elevation_deg = own.Number("elevation_deg", {0, 90}).value_or(0);
  if (!task.targets.empty()) throw Error(own.Here() + ": a point must be the first target");
}

void ReadDraw(TableReader& own, const std::string& quantity, TermTarget* target) {
  target->quantity = FindTargetQuantity(quantity, own.Here());
  target->name = own.Text("name", NameWithoutUnit(quantity));
  const std::string draw = OneOf(own, {"around_start", "between"});
  target->draw_from =
      draw == "between" ? TermTarget::Draw::kBetween : TermTarget::Draw::kAroundStart;
  const Range range = own.NumberRange(draw, kAnyNumber).value_or(Range());
  target->draw = {range.min / target->quantity.per_value, range.max / target->quantity.per_value};
  if (target->draw_from == TermTarget::Draw::kAroundStart && !CanBeAroundStart(*target)) {
    throw Error(fmt::format(
        "{}: around_start is for altitude, airspeed, position and attitude; {} needs between",
        own.Here(), quantity));
  }
}

/// Two names of errors can be one: of targets "x", an angle, and "x_deg".
void RequireNamesApart(const TermTaskConfig& task, const std::string& where) {
  std::vector<std::string> names = TermNumbers(task).Names();
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice != names.end()) {
    throw Error(fmt::format("{}: two targets' errors are called {}; give one of them another name",
                            where, *twice));
  }
}

}  // namespace

void ReadTerrain(const toml::table& table, const std::string& source, TermTaskConfig* task) {
  TableReader own(table, source);
  task->terrain_base_ft = own.Number("base_ft", kAnyNumber).value_or(0);
  for (const toml::node* node : own.Elements("waves")) {
    if (!node->is_table()) throw Error(own.At(*node, "waves") + " must be tables in braces");
    TableReader wave(*node->as_table(), source);
    TerrainWave read;
    read.height_ft = wave.Number("height_ft", kAnyNumber).value_or(0);
    // Shorter ones would be steps to an aircraft, and lose their phase in float32.
    const Bounds length{1000, kMostOfTaskFile};
    read.wavelength_north_ft = wave.Number("wavelength_north_ft", length).value_or(0);
    read.wavelength_east_ft = wave.Number("wavelength_east_ft", length).value_or(0);
    read.phase_rad = wave.Number("phase_deg", {-360, 360}).value_or(0) / kDegPerRad;
    wave.RefuseOthers();
    task->terrain.push_back(read);
  }
  RequireAtMost(task->terrain.size(), TermTaskConfig::kMaxWaves, own.Here(), "waves");
  own.RefuseOthers();
}

void ReadTarget(const toml::table& table, const std::string& source, TermTaskConfig* task) {
  TableReader own(table, source);
  TermTarget target;
  const std::string quantity = own.Text("quantity", "");
  if (quantity.empty()) own.RefuseLack({"quantity"}, "a target needs a quantity");
  if (quantity == "point") {
    ReadPoint(own, *task, &target);
  } else {
    ReadDraw(own, quantity, &target);
  }
  RequireName(target.name, own.Here() + ": name of a target");
  target.unit = ReadUnit(own, "unit", UsualUnit(target));
  // A number is in the quantity's own unit, errors are in that of its value.
  if (own.Find("unit") != nullptr) target.unit.number /= target.quantity.per_value;
  for (const TermTarget& other : task->targets) {
    if (other.name == target.name) {
      throw Error(fmt::format("{}: two targets are called {}", own.Here(), target.name));
    }
    if (other.quantity.value == target.quantity.value || IsPartOfPoint(other, target)) {
      throw Error(fmt::format("{}: {} has a target already, {}", own.Here(), quantity, other.name));
    }
  }
  own.RefuseOthers();
  task->targets.push_back(target);
  RequireNamesApart(*task, own.Here());
}

}  // namespace skein
