// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/registry.h"

#include <array>
#include <map>
#include <memory>
#include <mutex>

#include "base/error.h"
#include "envs/aircraft/aircraft_document.h"
#include "envs/aircraft/derivative_aircraft_file.h"
#include "envs/aircraft/f16.h"

namespace skein {
namespace {

/// Aircraft with a loader of their own.
struct Registration {
  const char* name;
  Aircraft (*load)();
};

constexpr std::array<Registration, 1> kAircraft = {{{"f16", F16}}};

using SharedDocument = std::shared_ptr<const AircraftDocument>;

/// The files that the process keeps, by what stands for them. Content never changes under a name
/// that holds its hash, so that what is kept is the same for everyone.
class KeptFiles {
 public:
  std::string Keep(AircraftDocument document) {
    const std::string key = document.name + "#" + document.hash;
    const std::lock_guard<std::mutex> lock(mutex_);
    kept_.emplace(key, std::make_shared<const AircraftDocument>(std::move(document)));
    return key;
  }

  /// Null if it is not kept.
  SharedDocument Find(const std::string& key) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = kept_.find(key);
    return found == kept_.end() ? nullptr : found->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, SharedDocument> kept_;
};

KeptFiles& Kept() {
  static KeptFiles kept;
  return kept;
}

SharedDocument DocumentOf(const std::string& aircraft) {
  if (auto kept = Kept().Find(aircraft)) return kept;
  if (IsAircraftPath(aircraft)) {
    return std::make_shared<const AircraftDocument>(ReadAircraftDocumentFile(aircraft));
  }
  for (const AircraftFile& file : AircraftFiles()) {
    if (aircraft != file.name) continue;
    return std::make_shared<const AircraftDocument>(
        ReadAircraftDocument(aircraft, *file.text, "aircraft " + aircraft));
  }
  if (aircraft.find('#') != std::string::npos) {
    throw Error("environment: the file of the aircraft " + aircraft +
                " is not at hand; name it with --aircraft FILE.json");
  }
  std::string known;
  for (const std::string& name : AircraftNames()) known += (known.empty() ? "" : ", ") + name;
  throw Error("environment: unknown aircraft \"" + aircraft + "\"; known: " + known +
              ", or the path of a file, FILE.json");
}

}  // namespace

std::vector<std::string> AircraftNames() {
  std::vector<std::string> names;
  for (const Registration& aircraft : kAircraft) names.emplace_back(aircraft.name);
  for (const AircraftFile& file : AircraftFiles()) names.emplace_back(file.name);
  return names;
}

bool IsAircraftPath(const std::string& aircraft) {
  constexpr std::string_view kExtension = ".json";
  return aircraft.find('/') != std::string::npos ||
         (aircraft.size() > kExtension.size() &&
          aircraft.compare(aircraft.size() - kExtension.size(), kExtension.size(), kExtension) ==
              0);
}

Aircraft LoadAircraft(const std::string& aircraft) {
  for (const Registration& registered : kAircraft) {
    if (aircraft == registered.name) return registered.load();
  }
  return MakeAircraft(*DocumentOf(aircraft));
}

std::string KeepAircraftFile(const std::string& path, const std::string& name) {
  AircraftDocument document = ReadAircraftDocumentFile(path);
  if (!name.empty()) document.name = name;
  MakeAircraft(document);  // what is kept can be flown
  return Kept().Keep(std::move(document));
}

}  // namespace skein
