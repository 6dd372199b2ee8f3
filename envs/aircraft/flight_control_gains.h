#pragma once

namespace skein {

/// Gains of the four-channel flight control system. Its laws are in envs/aircraft/flight_control.h;
/// sources in docs/flight-control.md.
struct FlightControlGains {};

}  // namespace skein
