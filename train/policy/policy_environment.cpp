// SPDX-License-Identifier: Apache-2.0
#include "train/policy/policy_environment.h"

#include <algorithm>
#include <vector>

#include "base/choice_error.h"
#include "base/field_list.h"
#include "base/number_text.h"

namespace skein {
namespace {

/// "f16", and for aircraft of one name their hashes, too.
std::string Shown(const AircraftIdentity& aircraft, const AircraftIdentity& other) {
  return aircraft.name == other.name ? aircraft.name + "#" + aircraft.hash : aircraft.name;
}

void CheckAircraft(const EnvConfig& env, const std::map<std::string, std::string>& made_with,
                   const std::string& who) {
  const AircraftIdentity made = AircraftMadeWith(made_with);
  if (made.name.empty()) return;
  const AircraftIdentity flown = IdentifyAircraft(env.aircraft);
  if (made.hash == flown.hash) return;
  throw ChoiceError(
      who + " was made with env.aircraft = " + Shown(made, flown) +
      ", but is to fly with env.aircraft = " + Shown(flown, made) +
      " (--aircraft chooses its own, of a run RUN/aircraft.json; skein eval --other-aircraft and "
      "the agent policy:FILE@other-aircraft allow another)");
}

}  // namespace

std::map<std::string, std::string> PolicyEnvironment(const EnvConfig& env) {
  EnvConfig listed = env;
  std::map<std::string, std::string> environment;
  for (const Field& field : FieldsOf(listed)) {
    if (field.role == PolicyRole::kNone || !field.IsOf(env.task)) continue;
    // Of a built-in task there is no file to name.
    if (field.is_off && field.ValueText(ShortestText).empty()) continue;
    environment[field.key] = field.ValueText(ShortestText);
  }
  const AircraftIdentity aircraft = IdentifyAircraft(env.aircraft);
  environment[kAircraftKey] = aircraft.name;
  environment[kAircraftHashKey] = aircraft.hash;
  return environment;
}

AircraftIdentity AircraftMadeWith(const std::map<std::string, std::string>& made_with) {
  const auto name = made_with.find(kAircraftKey), hash = made_with.find(kAircraftHashKey);
  if (name == made_with.end()) return {};
  if (hash != made_with.end()) return {name->second, hash->second};
  // Older versions had no aircraft but those that come with Skein.
  const std::vector<std::string> known = AircraftNames();
  const bool is_known = std::find(known.begin(), known.end(), name->second) != known.end();
  return is_known ? IdentifyAircraft(name->second) : AircraftIdentity{name->second, ""};
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
  CheckAircraft(env, made_with, who);
  for (const auto& [key, value] : PolicyEnvironment(env)) {
    if (key == kAircraftKey || key == kAircraftHashKey) continue;
    const auto found = made_with.find(key);
    if (found == made_with.end() || found->second == value) continue;
    if (key == kTaskInterfaceKey) {
      throw ChoiceError(who +
                        " was made for a task file whose numbers, observed or flown to, are "
                        "others, or have another order or other units");
    }
    throw ChoiceError(who + " was made with env." + key + " = " + found->second +
                      ", but is to fly with env." + key + " = " + value);
  }
}

void CheckLowLevelMadeFor(const EnvConfig& env, const Policy& low_level, const std::string& who) {
  EnvConfig below = env;
  below.task = kLowLevelTask;
  low_level.CheckMadeFor(below, who);
}

}  // namespace skein
