// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/field_list.h"
#include "src/config/program_config.h"

namespace skein {

/// A value as a configuration file or `--set` gives it.
using SettingValue = std::variant<bool, std::int64_t, double, std::string>;

/// The field called `key`. Throws Error that names `where`: if only older files call one so, with
/// its name; else with the setting that is meant, or the nearest key.
const Field& FindField(const std::vector<Field>& fields, const std::string& key,
                       const std::string& where);

/// A setting that somebody means by another name, as it is to be written, and how its values differ
/// from those that go with the other name. Both are empty if no setting is meant.
struct MeantSetting {
  std::string name;
  std::string difference;
};

/// The field of `fields` whose key ends in `name`, as key or option, or that other PPO
/// implementations call so.
MeantSetting FindMeantSetting(const std::vector<Field>& fields, const std::string& name);

/// "; did you mean ppo.minibatches (the number of minibatches, not their size)?", or an empty
/// string if nothing is meant.
std::string DidYouMean(const MeantSetting& meant);

/// Puts `value` into its field. An integer serves for a number, and a whole number (1.35e9) for an
/// integer. Throws Error that names `where`, the key and what would be right.
void Assign(const Field& field, const SettingValue& value, const std::string& where);

/// The same by the field's key.
void Assign(const std::string& key, const SettingValue& value, const std::string& where,
            ProgramConfig* config);

/// The field's value as TOML text; numbers round-trip.
std::string TomlText(const Field& field);

}  // namespace skein
