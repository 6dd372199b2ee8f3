// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace skein {

/// A reader of flight recordings, written against the public description of ACMI 2.2
/// (https://www.tacview.net/documentation/acmi/) and nothing else. It is stricter than Tacview.
struct AcmiSample {
  double time_s = 0;
  /// Longitude, latitude, deg, the reference's included; altitude, m; roll, pitch, yaw, deg; u, v,
  /// m; heading, deg. NaN where nothing was said so far.
  std::array<double, 9> transform{};
  std::map<std::string, std::string> properties;  ///< as they are then
};

struct AcmiObject {
  std::vector<AcmiSample> samples;  ///< one for every moment in which anything of it changed
  double removed_s = -1;            ///< negative: never

  const std::string& property(const std::string& name) const {
    return samples.back().properties.at(name);
  }
};

struct AcmiEvent {
  double time_s = 0;
  std::string kind;
  std::vector<std::uint64_t> objects;
  std::string text;
};

struct AcmiDocument {
  std::map<std::string, std::string> properties;  ///< of the whole recording
  std::map<std::uint64_t, AcmiObject> objects;
  std::vector<AcmiEvent> events;
};

/// Throws std::runtime_error with the line on whatever the description does not know.
AcmiDocument ReadAcmi(const std::string& text);

}  // namespace skein
