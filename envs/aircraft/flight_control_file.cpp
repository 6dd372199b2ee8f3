// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/flight_control_file.h"

namespace skein {
namespace {

nlohmann::ordered_json Json(double value) { return value; }
nlohmann::ordered_json Json(const FirstOrder& law) { return {law.b1, law.b0, law.a0}; }
nlohmann::ordered_json Json(const Ramp& ramp) {
  return {ramp.x_low, ramp.y_low, ramp.x_high, ramp.y_high};
}

void ReadChannels(Section& section, FlightControlGains* gains) {
  VisitFlightControlGains(*gains, [&](const char* key, auto* value) { section.Read(key, value); });
  // The loop gains are divided by dynamic pressures of at least these.
  for (const char* key :
       {"pitch_gain_pressure_psf", "roll_gain_pressure_psf", "yaw_gain_pressure_psf"}) {
    double pressure_psf = 0;
    section.ReadPositive(key, &pressure_psf);
  }
}

}  // namespace

void ReadFlightControl(Section section, FlightControlGains* gains) {
  ReadChannels(section, gains);
  section.Finish();
}

void ReadFlightControlWithFlap(Section section, FlightControlGains* gains) {
  ReadChannels(section, gains);
  VisitFlapGains(*gains, [&](const char* key, auto* value) { section.Read(key, value); });
  section.Finish();
}

nlohmann::ordered_json FlightControlJson(const FlightControlGains& gains) {
  nlohmann::ordered_json section;
  VisitFlightControlGains(gains,
                          [&](const char* key, const auto* value) { section[key] = Json(*value); });
  return section;
}

}  // namespace skein
