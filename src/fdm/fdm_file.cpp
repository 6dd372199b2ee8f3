// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/fdm_file.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "src/files/output_file.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

// Writing a document takes a call for every level of it.
constexpr int kMaxDepth = 100;

[[noreturn]] void Fail(const std::string& where, const std::string& what) {
  throw Error(fmt::format("{}: {}", where, what));
}

const Json& Member(const Json& object, const char* name, const std::string& where) {
  if (!object.is_object()) {
    Fail(where, fmt::format("expected an object, got {}", object.type_name()));
  }
  const auto found = object.find(name);
  if (found == object.end()) Fail(where, fmt::format("{} is missing", name));
  return *found;
}

double Number(const Json& value, const std::string& where) {
  if (!value.is_number()) Fail(where, fmt::format("expected a number, got {}", value.type_name()));
  const double number = value.get<double>();
  if (!std::isfinite(number)) Fail(where, "the number is not finite");
  return number;
}

template <std::size_t kCount>
std::array<double, kCount> Numbers(const Json& object, const char* name, const std::string& where) {
  const Json& list = Member(object, name, where);
  const std::string place = where + "." + name;
  if (!list.is_array() || list.size() != kCount) {
    Fail(place, fmt::format("expected a list of {} numbers, got {}", kCount,
                            list.is_array() ? fmt::format("{} entries", list.size())
                                            : std::string(list.type_name())));
  }
  std::array<double, kCount> numbers{};
  for (std::size_t i = 0; i < kCount; ++i) {
    numbers[i] = Number(list[i], fmt::format("{}[{}]", place, i));
  }
  return numbers;
}

FdmParameters Parameters(const Json& object, const std::string& where) {
  FdmParameters parameters;
  const auto found = object.find("params");
  if (found == object.end()) return parameters;
  const std::string place = where + ".params";
  if (!found->is_object()) {
    Fail(place, fmt::format("expected an object, got {}", found->type_name()));
  }
  for (const auto& [name, value] : found->items()) {
    const std::string item = fmt::format("{}.{}", place, name);
    if (name == "xcg") {
      parameters.cg = Number(value, item);
    } else if (name == "heng") {
      parameters.engine_angular_momentum = Number(value, item);
    } else {
      Fail(item, "unknown parameter; known are xcg and heng");
    }
  }
  return parameters;
}

void CheckAttitude(const FdmState& state, const std::string& where) {
  const double norm = std::sqrt(state[9] * state[9] + state[10] * state[10] +
                                state[11] * state[11] + state[12] * state[12]);
  // Files with a few digits are fine; an attitude that is not a rotation at all is not.
  constexpr double kNormTolerance = 1e-3;
  if (std::abs(norm - 1) > kNormTolerance) {
    Fail(where, fmt::format("the quaternion (entries 9 to 12) has norm {}, not 1", norm));
  }
}

FdmPoint Point(const Json& object, const std::string& where) {
  FdmPoint point;
  point.state = Numbers<13>(object, "state", where);
  CheckAttitude(point.state, where + ".state");
  point.controls = Numbers<5>(object, "controls", where);
  point.parameters = Parameters(object, where);
  return point;
}

FdmPulse Pulse(const Json& object, const std::string& where) {
  FdmPulse pulse;
  const Json& index = Member(object, "control_index", where);
  if (!index.is_number_integer() || index < 0 || index > 4) {
    Fail(where + ".control_index", "expected an integer from 0 to 4");
  }
  pulse.control_index = index.get<int>();
  pulse.t_start = Number(Member(object, "t_start", where), where + ".t_start");
  pulse.t_end = Number(Member(object, "t_end", where), where + ".t_end");
  pulse.delta = Number(Member(object, "delta", where), where + ".delta");
  return pulse;
}

FdmTrajectory Trajectory(const Json& object, const std::string& where) {
  FdmTrajectory trajectory;
  trajectory.initial_state = Numbers<13>(object, "initial_state", where);
  CheckAttitude(trajectory.initial_state, where + ".initial_state");
  trajectory.trim_controls = Numbers<5>(object, "trim_controls", where);
  trajectory.parameters = Parameters(object, where);
  if (const auto pulses = object.find("pulses"); pulses != object.end()) {
    const std::string place = where + ".pulses";
    if (!pulses->is_array()) {
      Fail(place, fmt::format("expected a list, got {}", pulses->type_name()));
    }
    for (std::size_t i = 0; i < pulses->size(); ++i) {
      trajectory.pulses.push_back(Pulse((*pulses)[i], fmt::format("{}[{}]", place, i)));
    }
  }
  const Json& times = Member(object, "t", where);
  const std::string place = where + ".t";
  if (!times.is_array() || times.empty()) {
    Fail(place, "expected a list of times in seconds, beginning with 0");
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = Number(times[i], fmt::format("{}[{}]", place, i));
    if (i == 0 ? t != 0 : t <= trajectory.t.back()) {
      Fail(fmt::format("{}[{}]", place, i), "times must begin with 0 and increase");
    }
    trajectory.t.push_back(t);
  }
  return trajectory;
}

template <typename Item>
std::vector<Item> List(const Json& document, const char* name, const std::string& path,
                       Item (*parse)(const Json&, const std::string&)) {
  std::vector<Item> items;
  const auto found = document.find(name);
  if (found == document.end()) return items;
  if (!found->is_array()) {
    Fail(path + ": " + name, fmt::format("expected a list, got {}", found->type_name()));
  }
  for (std::size_t i = 0; i < found->size(); ++i) {
    items.push_back(parse((*found)[i], fmt::format("{}: {}[{}]", path, name, i)));
  }
  return items;
}

}  // namespace

FdmFile ReadFdmFile(const std::string& path) {
  FdmFile file;
  const std::string text = ReadFile(path);
  try {
    file.document = Json::parse(text, [&path](int depth, Json::parse_event_t, const Json&) {
      if (depth > kMaxDepth) Fail(path, fmt::format("nested deeper than {} levels", kMaxDepth));
      return true;
    });
  } catch (const Json::parse_error& error) {
    std::size_t line = 1;
    for (std::size_t i = 0; i < text.size() && i + 1 < error.byte; ++i) line += text[i] == '\n';
    Fail(fmt::format("{}:{}", path, line),
         error.byte > text.size() ? "not valid JSON: it ends too early"
                                  : fmt::format("not valid JSON at byte {}", error.byte));
  } catch (const Json::exception& error) {
    Fail(path, fmt::format("not usable JSON: {}", error.what()));
  }
  if (!file.document.is_object()) {
    Fail(path, fmt::format("expected an object, got {}", file.document.type_name()));
  }
  file.points = List(file.document, "points", path, Point);
  file.edge_points = List(file.document, "edge_points", path, Point);
  file.trajectories = List(file.document, "trajectories", path, Trajectory);
  if (!file.document.contains("points") && !file.document.contains("edge_points") &&
      !file.document.contains("trajectories")) {
    Fail(path, "holds none of points, edge_points and trajectories");
  }
  return file;
}

}  // namespace skein
