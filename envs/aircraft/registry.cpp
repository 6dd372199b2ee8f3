// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/registry.h"

#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "base/choice_error.h"
#include "base/ends_with.h"
#include "base/error.h"
#include "base/nearest_name.h"
#include "envs/aircraft/aircraft_document.h"
#include "envs/aircraft/derivative_aircraft_file.h"

namespace skein {
namespace {

constexpr const char* kNotAtHand = " is not at hand; name it with --aircraft FILE.json";

/// An aircraft with the file that it was read from.
struct KnownAircraft {
  AircraftDocument document;
  Aircraft aircraft;
};

using SharedAircraft = std::shared_ptr<const KnownAircraft>;

SharedAircraft Make(AircraftDocument document) {
  Aircraft aircraft = MakeAircraft(document);
  return std::make_shared<const KnownAircraft>(
      KnownAircraft{std::move(document), std::move(aircraft)});
}

/// What the process has read, by what stands for it: the names of the aircraft that come with
/// Skein, and NAME#HASH of files. Neither ever stands for something else.
class Known {
 public:
  SharedAircraft Keep(const std::string& key, SharedAircraft aircraft) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return known_.insert_or_assign(key, std::move(aircraft)).first->second;
  }

  /// NAME#HASH of a kept file of that hash; empty if there is none.
  std::string FindHash(const std::string& hash) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [key, aircraft] : known_) {
      if (IsKeptFile(key) && aircraft->document.hash == hash) return key;
    }
    return "";
  }

  /// Null if it is not known.
  SharedAircraft Find(const std::string& key) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = known_.find(key);
    return found == known_.end() ? nullptr : found->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, SharedAircraft> known_;
};

Known& TheKnown() {
  static Known known;
  return known;
}

SharedAircraft Find(const std::string& aircraft) {
  if (auto known = TheKnown().Find(aircraft)) return known;
  if (IsAircraftPath(aircraft)) return Make(ReadAircraftDocumentFile(aircraft));
  for (const AircraftFile& file : AircraftFiles()) {
    if (aircraft != file.name) continue;
    return TheKnown().Keep(
        aircraft, Make(ReadAircraftDocument(aircraft, *file.text, "aircraft " + aircraft)));
  }
  if (IsKeptFile(aircraft)) {
    throw Error("the file of the aircraft " + aircraft + kNotAtHand);
  }
  std::string names;
  for (const std::string& name : AircraftNames()) names += (names.empty() ? "" : ", ") + name;
  throw ChoiceError("unknown aircraft \"" + aircraft + "\"" +
                    DidYouMean(aircraft, AircraftNames()) + "; known: " + names +
                    ", or the path of a file, FILE.json");
}

}  // namespace

std::vector<std::string> AircraftNames() {
  std::vector<std::string> names;
  for (const AircraftFile& file : AircraftFiles()) names.emplace_back(file.name);
  return names;
}

bool IsAircraftPath(const std::string& aircraft) {
  return aircraft.find('/') != std::string::npos || EndsWith(aircraft, ".json");
}

Aircraft LoadAircraft(const std::string& aircraft) { return Find(aircraft)->aircraft; }

std::string KeepAircraftFile(const std::string& path, const std::string& name) {
  AircraftDocument document = ReadAircraftDocumentFile(path);
  if (!name.empty()) document.name = name;
  std::string key = document.name + "#" + document.hash;
  TheKnown().Keep(key, Make(std::move(document)));
  return key;
}

AircraftIdentity IdentifyAircraft(const std::string& aircraft) {
  const SharedAircraft known = Find(aircraft);
  return {known->document.name, known->document.hash};
}

std::string AircraftText(const std::string& aircraft) { return Find(aircraft)->document.text; }

bool IsKeptFile(const std::string& aircraft) { return aircraft.find('#') != std::string::npos; }

std::string FindAircraft(const AircraftIdentity& identity) {
  for (const std::string& name : AircraftNames()) {
    if (IdentifyAircraft(name).hash == identity.hash) return name;
  }
  if (std::string kept = TheKnown().FindHash(identity.hash); !kept.empty()) return kept;
  throw Error("the file of the aircraft " + identity.name + "#" + identity.hash + kNotAtHand);
}

std::string PresetsOf(const std::string& aircraft) {
  const SharedAircraft known = Find(aircraft);
  const AircraftDocument& document = known->document;
  return document.presets_of.empty() ? document.name : document.presets_of;
}

std::vector<std::string> AircraftSettings(const std::string& aircraft) {
  return Find(aircraft)->document.settings;
}

}  // namespace skein
