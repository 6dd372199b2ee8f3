// SPDX-License-Identifier: Apache-2.0
#include "train/policy/policy_environment.h"

#include "base/error.h"
#include "base/field_list.h"
#include "base/number_text.h"

namespace skein {

std::map<std::string, std::string> PolicyEnvironment(const EnvConfig& env) {
  EnvConfig listed = env;
  std::map<std::string, std::string> environment;
  for (const Field& field : FieldsOf(listed)) {
    if (field.role == PolicyRole::kNone || !field.IsOf(env.task)) continue;
    // Of a built-in task there is no file to name.
    if (field.is_off && field.ValueText(ShortestText).empty()) continue;
    environment[field.key] = field.ValueText(ShortestText);
  }
  return environment;
}

void AdoptView(const std::map<std::string, std::string>& made_with, EnvConfig* env) {
  for (const Field& field : FieldsOf(*env)) {
    const auto found = made_with.find(field.key);
    if (field.role != PolicyRole::kChosen || found == made_with.end()) continue;
    field.SetText(found->second);
  }
}

void CheckMadeWith(const EnvConfig& env, const std::map<std::string, std::string>& made_with,
                   const std::string& who) {
  for (const auto& [key, value] : PolicyEnvironment(env)) {
    const auto found = made_with.find(key);
    if (found == made_with.end() || found->second == value) continue;
    throw Error(who + " was made with env." + key + " = " + found->second +
                ", but is to fly with env." + key + " = " + value);
  }
}

void CheckLowLevelMadeFor(const EnvConfig& env, const Policy& low_level, const std::string& who) {
  EnvConfig below = env;
  below.task = kLowLevelTask;
  low_level.CheckMadeFor(below, who);
}

}  // namespace skein
