// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/aircraft_document.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "base/choice_error.h"
#include "base/error.h"
#include "base/file_error.h"
#include "base/fnv_hash.h"
#include "envs/aircraft/aircraft_json.h"
#include "envs/aircraft/derivative_aircraft_file.h"
#include "envs/aircraft/table_aircraft.h"

namespace skein {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestName = 60;
constexpr const char* kDerivatives = "derivatives";
constexpr const char* kTables = "tables";

bool IsNameCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.';
}

bool IsName(const std::string& text) {
  for (const char c : text) {
    if (!IsNameCharacter(c)) return false;
  }
  return !text.empty() && text.size() <= kLongestName;
}

/// The name that a file gives an aircraft that has none of its own.
std::string NameOfFile(const std::string& path) {
  std::string name = std::filesystem::path(path).stem().string().substr(0, kLongestName);
  for (char& c : name) {
    if (!IsNameCharacter(c)) c = '_';
  }
  return name.empty() ? "aircraft" : name;
}

/// The content without what is for readers; numbers all of one type, so that 1 is 1.0.
json Canonical(const json& content) {
  if (content.is_number()) return content.get<double>();
  if (content.is_array()) {
    json list = json::array();
    for (const json& element : content) list.push_back(Canonical(element));
    return list;
  }
  if (!content.is_object()) return content;
  json object = json::object();
  for (const auto& entry : content.items()) {
    if (entry.key() == "source" || entry.key() == "about") continue;
    object[entry.key()] = Canonical(entry.value());
  }
  return object;
}

std::string HashOf(const json& content) {
  json model = Canonical(content);
  model.erase(kNameKey);
  model.erase(kSettingsKey);
  model.erase(kPresetsKey);
  return HexHash(model.dump());
}

/// The values below `object` as assignments to configuration keys below `key`.
void ListSettings(const json& object, const std::string& key, const std::string& who,
                  std::vector<std::string>* settings) {
  Section section(object, who + "." + key);
  for (const std::string& name : section.ReadKeys()) {
    if (!IsName(name)) throw Error(section.path() + " has a key that is no configuration key");
    const std::string below = key + "." + name;
    const json& value = object.at(name);
    if (value.is_object()) {
      ListSettings(value, below, who, settings);
    } else if (value.is_number() || value.is_string() || value.is_boolean()) {
      settings->push_back(below + "=" + value.dump());
    } else {
      throw Error(section.path() + ": its values must be numbers, texts, true or false");
    }
  }
}

}  // namespace

AircraftDocument ReadAircraftDocument(const std::string& name, std::string_view text,
                                      const std::string& who) {
  const json content = ParseAircraftJson(text, who);
  AircraftDocument document;
  document.name = name;
  document.text = text;
  document.model = kDerivatives;
  Section section(content, who);
  if (section.Has(kNameKey)) document.name = section.ReadText(kNameKey);
  if (!IsName(document.name)) {
    throw Error(who + ": name must be 1 to " + std::to_string(kLongestName) +
                " letters, digits, \"_\", \"-\" or \".\"");
  }
  if (section.Has(kSettingsKey)) {
    ListSettings(content.at(kSettingsKey), kSettingsKey, who, &document.settings);
  }
  if (section.Has(kPresetsKey)) document.presets_of = section.ReadText(kPresetsKey);
  if (section.Has(kModelKey)) document.model = section.ReadText(kModelKey);
  if (document.model != kTables && document.model != kDerivatives) {
    throw Error(who + ": model must be \"" + kDerivatives + "\" or \"" + kTables + "\"");
  }
  document.hash = HashOf(content);
  return document;
}

AircraftDocument ReadAircraftDocumentFile(const std::string& path) {
  std::error_code failure;
  const auto status = std::filesystem::status(path, failure);
  if (failure == std::errc::permission_denied) {
    throw FileError(path + ": cannot be read: " + failure.message());
  }
  if (!std::filesystem::exists(status)) {
    throw ChoiceError(path + ": there is no such aircraft file");
  }
  if (!std::filesystem::is_regular_file(status)) throw ChoiceError(path + ": is not a file");
  std::ifstream file(path, std::ios::binary);
  // One byte beyond what is allowed shows that it is too long.
  std::string text(kMaxAircraftBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad() || (!file && !file.eof())) throw FileError(path + ": cannot be read");
  text.resize(static_cast<std::size_t>(file.gcount()));
  return ReadAircraftDocument(NameOfFile(path), text, path);
}

Aircraft MakeAircraft(const AircraftDocument& document) {
  if (document.model == kTables) return ReadTableAircraft(document.name, document.text);
  return MakeAircraft(ReadDerivativeAircraft(document.name, document.text));
}

}  // namespace skein
