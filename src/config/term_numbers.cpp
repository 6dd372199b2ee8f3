// SPDX-License-Identifier: Apache-2.0
#include "src/config/term_numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/ends_with.h"
#include "base/error.h"
#include "base/nearest_name.h"

namespace skein {
namespace {

constexpr std::array<std::pair<const char*, ReferenceUnit>, 3> kReferenceUnits = {
    {{"altitude_error", ReferenceUnit::kAltitudeError},
     {"altitude", ReferenceUnit::kAltitude},
     {"speed", ReferenceUnit::kSpeed}}};

/// Names that differ in nothing but the unit of what they name: "yaw_deg", "yaw_rad".
std::vector<const TermName*> NamesOf(TermValue value) {
  std::vector<const TermName*> names;
  for (const TermName& name : TermNames()) {
    if (name.value == value) names.push_back(&name);
  }
  return names;
}

/// "deg_s" of "p_deg_s"; empty of what has no unit.
std::string UnitOf(const std::string& name) {
  for (const char* unit : {"deg_s", "rad_s", "deg", "rad", "fps", "ft", "g"}) {
    if (EndsWith(name, std::string("_") + unit)) return unit;
  }
  return "";
}

[[noreturn]] void RefuseUnknown(const std::string& name, const std::vector<std::string>& known,
                                const std::string& where) {
  const std::string suggestion = DidYouMean(name, known);
  throw Error(
      fmt::format("{}: unknown quantity {}{}", where, name,
                  suggestion.empty() ? "; docs/reference/task-files.md lists them" : suggestion));
}

/// All names by which a task file may call its targets' errors, with what they are.
std::vector<TermNumber> ErrorsOf(const TermTaskConfig& task) {
  std::vector<TermNumber> errors;
  for (std::size_t k = 0; k < task.targets.size(); ++k) {
    const TermTarget& target = task.targets[k];
    if (target.draw_from == TermTarget::Draw::kPoint) continue;
    TermNumber error;
    error.value = TermValue::kTargetError;
    error.target = static_cast<int>(k);
    error.name = "error_" + target.name;
    error.unit = target.unit;
    errors.push_back(error);
    error.unit = {};
    for (const TermName* name : NamesOf(target.quantity.value)) {
      const std::string unit = UnitOf(name->name);
      if (unit.empty()) continue;
      error.name = fmt::format("error_{}_{}", target.name, unit);
      error.per_value = name->per_value;
      errors.push_back(error);
    }
  }
  return errors;
}

bool HasTarget(const TermTaskConfig& task, TermValue value) {
  return std::any_of(task.targets.begin(), task.targets.end(),
                     [value](const TermTarget& target) { return target.quantity.value == value; });
}

}  // namespace

TermNumber TermNumbers::Find(const std::string& name, const std::string& where) const {
  for (const TermNumber& error : ErrorsOf(task_)) {
    if (error.name == name) return error;
  }
  for (const TermName& known : TermNames()) {
    if (known.name != name) continue;
    TermNumber number;
    number.name = name;
    number.value = known.value;
    number.per_value = known.per_value;
    RequireWhatItIsOf(number, where);
    return number;
  }
  RefuseUnknown(name, Names(), where);
}

std::vector<std::string> TermNumbers::Names() const {
  std::vector<std::string> names;
  for (const TermNumber& error : ErrorsOf(task_)) names.push_back(error.name);
  for (const TermName& name : TermNames()) names.emplace_back(name.name);
  return names;
}

TermNumber TermNumbers::Read(const toml::node& node, const std::string& key,
                             const TableReader& reader) const {
  if (const auto* name = node.as_string()) return Find(name->get(), reader.At(node, key));
  if (!node.is_table()) {
    throw Error(reader.At(node, key) +
                " must be the name of a quantity in quotes, or {quantity = \"NAME\", unit = UNIT}");
  }
  TableReader own(*node.as_table(), reader.source());
  const std::string name = own.Text("quantity", "");
  if (name.empty()) throw Error(reader.At(node, key) + " needs a quantity");
  TermNumber number = Find(name, reader.At(node, key));
  number.unit = ReadUnit(own, "unit", number.unit);
  own.RefuseOthers();
  return number;
}

void TermNumbers::RequireWhatItIsOf(const TermNumber& number, const std::string& where) const {
  const TermValue value = number.value;
  if (value >= TermValue::kPointNorth && value <= TermValue::kPointAbovePath &&
      !task_.has_point()) {
    throw Error(fmt::format("{}: {} is of a target that is a point, and there is none", where,
                            number.name));
  }
  const bool is_attitude = value == TermValue::kNoseAngle || value == TermValue::kAttitudeAngle;
  if (is_attitude && !(HasTarget(task_, TermValue::kPitch) && HasTarget(task_, TermValue::kYaw))) {
    throw Error(fmt::format("{}: {} is of a target pitch and yaw, and there are not both", where,
                            number.name));
  }
  const bool is_terrain = value == TermValue::kTerrain || value == TermValue::kHeightAboveTerrain;
  if (is_terrain && !task_.has_terrain()) {
    throw Error(
        fmt::format("{}: {} is of a terrain, and there is no [terrain]", where, number.name));
  }
}

TermNumber FindTargetQuantity(const std::string& name, const std::string& where) {
  std::vector<std::string> known = {"point"};
  for (const TermName& candidate : TermNames()) {
    // Of an angle's two names one is recorded.
    const std::vector<const TermName*> same = NamesOf(candidate.value);
    const bool is_recorded = std::any_of(same.begin(), same.end(),
                                         [](const TermName* other) { return other->is_recorded; });
    if (!is_recorded && candidate.name == name) {
      throw Error(fmt::format("{}: {} cannot be a target, as recorded flights do not have it",
                              where, name));
    }
    if (!is_recorded) continue;
    known.emplace_back(candidate.name);
    if (candidate.name != name) continue;
    TermNumber number;
    number.name = name;
    number.value = candidate.value;
    number.per_value = candidate.per_value;
    return number;
  }
  RefuseUnknown(name, known, where);
}

std::string NameWithoutUnit(const std::string& name) {
  const std::string unit = UnitOf(name);
  return unit.empty() ? name : name.substr(0, name.size() - unit.size() - 1);
}

TermUnit ReadUnit(TableReader& reader, const std::string& key, const TermUnit& otherwise) {
  const toml::node* const node = reader.Find(key);
  if (node == nullptr) return otherwise;
  TermUnit unit;
  if (const auto* name = node->as_string()) {
    std::vector<std::string> known;
    for (const auto& [text, reference] : kReferenceUnits) {
      known.emplace_back(text);
      unit.reference = reference;
      if (name->get() == text) return unit;
    }
    throw Error(fmt::format("{}: unknown unit {}{}; known: {}, or a number above 0",
                            reader.At(*node, key), name->get(), DidYouMean(name->get(), known),
                            fmt::join(known, ", ")));
  }
  unit.number = reader.Number(key, {1e-9, 1e9}).value_or(1);
  return unit;
}

}  // namespace skein
