// SPDX-License-Identifier: Apache-2.0
#include "src/config/plant_condition.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/error.h"
#include "base/field_list.h"
#include "base/nearest_name.h"
#include "base/number_text.h"
#include "envs/plant/plant_config.h"

namespace skein {
namespace {

const Units kPlain = {{"", 1}};

/// A quantity at the middle level; others move away from the nominal value in proportion.
struct MiddleLevel {
  const char* quantity;
  double min, max;
  bool is_whole = false;
};

/// Scaled for the F-16: what a loaded aircraft, tables of another wind tunnel, another flight
/// control computer or a worn actuator come to.
constexpr MiddleLevel kMiddleLevels[] = {{"mass", 0.9, 1.1},
                                         {"inertia", 0.9, 1.1},
                                         {"cg_shift", -0.05, 0.05},
                                         {"axial_force", 0.8, 1.2},
                                         {"normal_force", 0.8, 1.2},
                                         {"pitching_moment", 0.8, 1.2},
                                         {"lateral", 0.8, 1.2},
                                         {"control", 0.8, 1.2},
                                         {"weak_surface", 0.5, 1},
                                         {"damping", 0.8, 1.2},
                                         {"thrust", 0.85, 1.15},
                                         {"thrust_lag", 0.7, 1.3},
                                         {"engine_momentum", 0, 160},
                                         {"density", 0.95, 1.05},
                                         {"pitch_stick", 0.7, 1.3},
                                         {"roll_stick", 0.7, 1.3},
                                         {"yaw_stick", 0.7, 1.3},
                                         {"actuator_rate", 0.8, 1.2},
                                         {"actuator_bandwidth", 0.5, 2},
                                         {"action_delay", 0, 2, true},
                                         {"observation_delay", 0, 1, true},
                                         {"sensor_bias", 0.02, 0.02},
                                         {"sensor_scale", 0.02, 0.02},
                                         {"sensor_freeze_chance", 0.1, 0.1}};

/// A quantity's keys: two of a range, or one.
struct QuantityKeys {
  std::string min, max;
};

/// By the quantities' names: "mass" of mass_min and mass_max.
std::map<std::string, QuantityKeys> KeysByQuantity(const std::vector<Field>& fields) {
  std::map<std::string, QuantityKeys> quantities;
  for (const Field& field : fields) {
    const std::string& key = field.key;
    if (const auto at = key.find("_min"); at != std::string::npos) {
      quantities[key.substr(0, at)].min = key;
    } else if (const auto end = key.find("_max"); end != std::string::npos) {
      quantities[key.substr(0, end)].max = key;
    } else {
      quantities[key] = {key, key};
    }
  }
  return quantities;
}

/// A quantity's value or range. Throws Error by its name if the range's ends are exchanged.
Range ParseRangeOf(const std::string& quantity, const std::string& text,
                   const LevelRequest& request) {
  const auto [low, high] = SplitRange(text);
  const Range range{ParseNumber(low, kPlain, request), ParseNumber(high, kPlain, request)};
  if (range.min <= range.max) return range;
  request.RefuseReversed(quantity + ": the range " + text, low, high);
}

/// The values of env.plant's keys, at first those of a configuration or nominal.
class PlantValues {
 public:
  explicit PlantValues(PlantConfig plant = {}) {
    const std::vector<Field> fields = FieldsOf(plant);
    quantities_ = KeysByQuantity(fields);
    for (const Field& field : fields) {
      values_[field.key] = NumberOf(field.ValueText(ShortestText)).value();
    }
  }

  /// The part QUANTITY:VALUE or QUANTITY:MIN..MAX of a level.
  void SetPart(const std::string& part, const LevelRequest& request) {
    const auto colon = part.find(':');
    if (colon == std::string::npos) request.Refuse(part);
    const std::string quantity = part.substr(0, colon);
    const QuantityKeys& keys = KeysOf(quantity, request);
    const Range range = ParseRangeOf(quantity, part.substr(colon + 1), request);
    const bool is_one_value = keys.min == keys.max;
    if (!given_.insert(quantity).second || (is_one_value && range.min != range.max)) {
      request.Refuse(part);
    }
    values_[keys.min] = range.min;
    values_[keys.max] = range.max;
  }

  /// Throws Error if a time is given to what never happens.
  void CheckFreeze(const LevelRequest& request) const {
    if (given_.count("sensor_freeze") == 0 || values_.at("sensor_freeze_chance") > 0) return;
    throw Error(
        fmt::format("--condition {}={}: sensor_freeze is when a sensor freezes, and without a "
                    "sensor_freeze_chance above 0 none does; add sensor_freeze_chance:0.1",
                    request.name, request.level));
  }

  /// Everything at `share` of the middle level.
  void SetShare(double share) {
    for (const MiddleLevel& level : kMiddleLevels) {
      const QuantityKeys& keys = quantities_.at(level.quantity);
      const auto scale = [&](const std::string& key, double middle) {
        double& value = values_[key];
        value += share * (middle - value);
        if (level.is_whole) value = std::round(value);
      };
      scale(keys.min, level.min);
      if (keys.max != keys.min) scale(keys.max, level.max);
    }
  }

  /// Of each quantity that is not as `nominal` has it, its name and value or range.
  std::vector<std::string> DifferencesFrom(const PlantValues& nominal) const {
    std::vector<std::string> differences;
    for (const auto& [quantity, keys] : quantities_) {
      const double min = values_.at(keys.min), max = values_.at(keys.max);
      if (min == nominal.values_.at(keys.min) && max == nominal.values_.at(keys.max)) continue;
      differences.push_back(min == max ? fmt::format("{} {:.6g}", quantity, min)
                                       : fmt::format("{} {:.6g} to {:.6g}", quantity, min, max));
    }
    return differences;
  }

  /// The share of the middle level that the masses are at.
  double ShareOfMass() const {
    return (1 - values_.at(quantities_.at("mass").min)) / (1 - kMiddleLevels[0].min);
  }

  std::vector<std::string> Assignments() const {
    std::vector<std::string> assignments;
    for (const auto& [key, value] : values_) {
      assignments.push_back(fmt::format("env.plant.{}={}", key, RoundedText(value, kDigits)));
    }
    return assignments;
  }

 private:
  // Shares of the middle level are not exact: 0.95 and not 0.9500000000000001.
  static constexpr int kDigits = 12;

  const QuantityKeys& KeysOf(const std::string& quantity, const LevelRequest& request) const {
    const auto found = quantities_.find(quantity);
    if (found != quantities_.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [name, keys] : quantities_) names.push_back(name);
    throw Error(fmt::format("--condition {}={}: unknown quantity {}{}", request.name, request.level,
                            quantity, DidYouMean(quantity, names)));
  }

  std::map<std::string, QuantityKeys> quantities_;
  std::map<std::string, double> values_;
  std::set<std::string> given_;
};

}  // namespace

std::vector<std::string> PlantAssignments(const LevelRequest& request, const std::string& level) {
  PlantValues values;
  if (StartsWithDigit(level)) {
    values.SetShare(ParseNumber(level, kPlain, request));
  } else {
    for (const std::string& part : SplitParts(level)) values.SetPart(part, request);
    values.CheckFreeze(request);
  }
  return values.Assignments();
}

std::string DescribePlant(const PlantConfig& plant) {
  constexpr std::size_t kMostNamed = 3;
  const PlantValues values(plant);
  const std::vector<std::string> differences = values.DifferencesFrom(PlantValues());
  if (differences.empty()) return "";
  if (differences.size() <= kMostNamed) {
    return fmt::format("plant: {}", fmt::join(differences, ", "));
  }
  PlantValues level;
  level.SetShare(values.ShareOfMass());
  if (level.Assignments() == values.Assignments()) {
    return fmt::format("plant at {:.6g} of the middle level", values.ShareOfMass());
  }
  return fmt::format("drawn plants ({} quantities)", differences.size());
}

}  // namespace skein
