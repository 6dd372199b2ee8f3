// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "src/config/program_config.h"

namespace skein {

/// A value as a configuration file or `--set` gives it.
using SettingValue = std::variant<bool, std::int64_t, double, std::string>;

/// Where a setting's value lives in a ProgramConfig.
using SettingField =
    std::variant<bool*, int*, std::uint64_t*, double*, std::string*, AtmosphereModel*,
                 FlightControlMode*, TrackingAxes*, Activation*, Backend*, LearnerPrecision*>;

/// The interval that a number must lie in; `min_open` leaves `min` itself out.
struct Bounds {
  double min = 0, max = 0;
  bool min_open = false;
};

/// One configuration key: its name (unit included), its place, its limits and what it means.
struct Setting {
  std::string key;
  SettingField (*field)(ProgramConfig& config);
  Bounds bounds;  ///< ignored for booleans and names
  std::string description;

  /// "a number", "an integer", "true or false", or the names allowed.
  std::string TypeName() const;
  /// "(0, 1]" for numbers, else empty.
  std::string BoundsText() const;
};

/// Every configuration key, grouped by table ("env", "env.initial", ...).
const std::vector<Setting>& Settings();

/// The setting called `key`. Throws Error that names `where` and suggests the nearest key.
const Setting& FindSetting(const std::string& key, const std::string& where);

/// Puts `value` into its field. An integer serves for a number, and a whole number (1.35e9) for an
/// integer. Throws Error that names `where`, the key and what would be right.
void Assign(const Setting& setting, const SettingValue& value, const std::string& where,
            ProgramConfig* config);

/// The setting's value as TOML text; numbers round-trip.
std::string FormatValue(const Setting& setting, const ProgramConfig& config);

}  // namespace skein
