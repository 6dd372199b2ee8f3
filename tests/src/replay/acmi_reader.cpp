// SPDX-License-Identifier: Apache-2.0
#include "tests/src/replay/acmi_reader.h"

#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>

namespace skein {
namespace {

const std::set<std::string> kGlobalProperties = {
    "DataSource", "DataRecorder", "ReferenceTime",      "RecordingTime",
    "Author",     "Title",        "Category",           "Briefing",
    "Debriefing", "Comments",     "ReferenceLongitude", "ReferenceLatitude"};

const std::set<std::string> kObjectProperties = {"Name",
                                                 "Type",
                                                 "Parent",
                                                 "Next",
                                                 "CallSign",
                                                 "Registration",
                                                 "Squawk",
                                                 "Pilot",
                                                 "Group",
                                                 "Country",
                                                 "Coalition",
                                                 "Color",
                                                 "Shape",
                                                 "Label",
                                                 "FocusedTarget",
                                                 "LockedTarget",
                                                 "Importance",
                                                 "Slot",
                                                 "Disabled",
                                                 "Visible",
                                                 "Health",
                                                 "Length",
                                                 "Width",
                                                 "Height",
                                                 "Radius",
                                                 "IAS",
                                                 "CAS",
                                                 "TAS",
                                                 "Mach",
                                                 "AOA",
                                                 "AOS",
                                                 "AGL",
                                                 "HDG",
                                                 "HDM",
                                                 "Throttle",
                                                 "EngineRPM",
                                                 "Afterburner",
                                                 "AirBrakes",
                                                 "Flaps",
                                                 "RollControlInput",
                                                 "PitchControlInput",
                                                 "YawControlInput",
                                                 "RollControlPosition",
                                                 "PitchControlPosition",
                                                 "YawControlPosition",
                                                 "AileronLeft",
                                                 "AileronRight",
                                                 "Elevator",
                                                 "Rudder",
                                                 "VerticalGForce",
                                                 "LongitudinalGForce",
                                                 "LateralGForce"};

const std::set<std::string> kTextProperties = {
    "Name", "Type", "CallSign", "Pilot", "Group", "Coalition", "Color", "Label", "FocusedTarget"};

const std::set<std::string> kColours = {"Red",  "Orange", "Yellow", "Green",
                                        "Cyan", "Blue",   "Violet"};

const std::set<std::string> kTags = {"Air", "Navaid", "Misc", "Static", "FixedWing", "Waypoint"};

const std::set<std::string> kEvents = {"Message",   "Bookmark", "Debug",  "LeftArea",
                                       "Destroyed", "TakenOff", "Landed", "Timeout"};

[[noreturn]] void Refuse(const std::string& why, const std::string& line) {
  throw std::runtime_error(why + ": " + line);
}

double Number(const std::string& text) {
  std::size_t end = 0;
  const double value = std::stod(text, &end);
  if (end != text.size() || !std::isfinite(value)) Refuse("no number", text);
  return value;
}

std::uint64_t ObjectId(const std::string& text) {
  if (text.empty() || text.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos ||
      (text.size() > 1 && text[0] == '0')) {
    Refuse("no object id", text);
  }
  return std::stoull(text, nullptr, 16);
}

/// Splits at `separator`; where `escapes`, not at one behind a backslash, which goes.
std::vector<std::string> Split(const std::string& text, char separator, bool escapes) {
  std::vector<std::string> parts(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (escapes && text[i] == '\\' && i + 1 < text.size()) {
      parts.back() += text[++i];
    } else if (text[i] == separator) {
      parts.emplace_back();
    } else {
      parts.back() += text[i];
    }
  }
  return parts;
}

class Reader {
 public:
  AcmiDocument Read(std::string text) {
    if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
    std::istringstream lines(text);
    std::string line;
    for (const char* expected : {"FileType=text/acmi/tacview", "FileVersion=2.2"}) {
      if (!std::getline(lines, line) || line != expected) Refuse("header", line);
    }
    while (std::getline(lines, line)) ReadLine(line);
    return document_;
  }

 private:
  void ReadLine(const std::string& line) {
    if (line.empty()) Refuse("empty line", line);
    if (line[0] == '#') {
      const double time = Number(line.substr(1));
      if (time <= time_s_) Refuse("time goes back", line);
      time_s_ = time;
    } else if (line[0] == '-') {
      AcmiObject& object = Living(ObjectId(line.substr(1)), line);
      object.removed_s = time_s_;
    } else {
      ReadProperties(line);
    }
  }

  AcmiObject& Living(std::uint64_t id, const std::string& line) {
    const auto found = document_.objects.find(id);
    if (found == document_.objects.end() || found->second.removed_s >= 0) {
      Refuse("no such object", line);
    }
    return found->second;
  }

  void ReadProperties(const std::string& line) {
    const std::vector<std::string> parts = Split(line, ',', true);
    const std::uint64_t id = ObjectId(parts[0]);
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const std::size_t equals = parts[i].find('=');
      if (equals == std::string::npos) Refuse("no property", line);
      const std::string name = parts[i].substr(0, equals), value = parts[i].substr(equals + 1);
      if (id != 0) {
        SetProperty(id, name, value, line);
      } else if (name == "Event") {
        ReadEvent(value, line);
      } else if (kGlobalProperties.count(name) == 0) {
        Refuse("unknown property of the recording", line);
      } else {
        document_.properties[name] = value;
      }
    }
  }

  void ReadEvent(const std::string& value, const std::string& line) {
    const std::vector<std::string> parts = Split(value, '|', false);
    if (parts.size() < 2 || kEvents.count(parts[0]) == 0) Refuse("unknown event", line);
    AcmiEvent event{time_s_, parts[0], {}, parts.back()};
    for (std::size_t i = 1; i + 1 < parts.size(); ++i) {
      event.objects.push_back(ObjectId(parts[i]));
      Living(event.objects.back(), line);
    }
    document_.events.push_back(event);
  }

  void SetProperty(std::uint64_t id, const std::string& name, const std::string& value,
                   const std::string& line) {
    AcmiSample& sample = SampleNow(id, line);
    if (name == "T") {
      Place(value, &sample, line);
      return;
    }
    if (kObjectProperties.count(name) == 0) Refuse("unknown property", line);
    if (kTextProperties.count(name) == 0) Number(value);
    if (name == "Color" && kColours.count(value) == 0) Refuse("unknown colour", line);
    if (name == "Type") {
      for (const std::string& tag : Split(value, '+', false)) {
        if (kTags.count(tag) == 0) Refuse("unknown tag", line);
      }
    }
    sample.properties[name] = value;
  }

  /// The object's sample of this moment, which begins as the one before.
  AcmiSample& SampleNow(std::uint64_t id, const std::string& line) {
    AcmiObject& object = document_.objects[id];
    if (object.removed_s >= 0) Refuse("the object was removed", line);
    if (object.samples.empty()) {
      object.samples.emplace_back().transform.fill(std::numeric_limits<double>::quiet_NaN());
    } else if (object.samples.back().time_s != time_s_) {
      object.samples.push_back(AcmiSample(object.samples.back()));
    }
    object.samples.back().time_s = time_s_;
    return object.samples.back();
  }

  void Place(const std::string& value, AcmiSample* sample, const std::string& line) {
    const std::vector<std::string> parts = Split(value, '|', false);
    if (parts.size() != sample->transform.size()) Refuse("another notation", line);
    const double offsets[] = {Number(document_.properties.at("ReferenceLongitude")),
                              Number(document_.properties.at("ReferenceLatitude"))};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].empty()) continue;
      sample->transform[i] = Number(parts[i]) + (i < 2 ? offsets[i] : 0);
    }
  }

  AcmiDocument document_;
  double time_s_ = -1;
};

}  // namespace

AcmiDocument ReadAcmi(const std::string& text) { return Reader().Read(text); }

}  // namespace skein
