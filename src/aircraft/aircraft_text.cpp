// SPDX-License-Identifier: Apache-2.0
#include "src/aircraft/aircraft_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "envs/aircraft/derivative_aircraft_file.h"
#include "envs/aircraft/flight_control_file.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

std::string OneLine(const Json& value) {
  if (!value.is_array()) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  std::string text = "[";
  for (const Json& element : value) text += (text.size() > 1 ? ", " : "") + OneLine(element);
  return text + "]";
}

bool IsFlat(const Json& value) {
  if (!value.is_structured()) return true;
  if (value.is_object()) return value.empty();
  for (const Json& element : value) {
    if (element.is_structured()) return false;
  }
  return true;
}

void Append(const Json& value, const std::string& indent, std::string* text) {
  if (IsFlat(value)) {
    *text += OneLine(value);
    return;
  }
  const std::string below = indent + "  ";
  const bool is_object = value.is_object();
  *text += is_object ? "{" : "[";
  bool is_first = true;
  for (const auto& entry : value.items()) {
    *text += (is_first ? "\n" : ",\n") + below;
    if (is_object) *text += OneLine(entry.key()) + ": ";
    Append(entry.value(), below, text);
    is_first = false;
  }
  *text += "\n" + indent + (is_object ? "}" : "]");
}

}  // namespace

std::string AircraftText(const nlohmann::ordered_json& file) {
  std::string text;
  Append(file, "", &text);
  return text + "\n";
}

std::string TextWithGains(const AircraftDocument& document, const FlightControlGains& gains) {
  Json file = Json::parse(document.text);
  Json section = {{"about", "By `skein aircraft tune`, from the linear model over level flight."}};
  section.update(FlightControlJson(gains));
  file["flight_control"] = section;
  std::string text = AircraftText(file);
  try {
    ReadDerivativeAircraft(document.name, text);
  } catch (const Error& error) {
    throw Error(fmt::format("the gains found are none of an aircraft: {}", error.what()));
  }
  return text;
}

}  // namespace skein
