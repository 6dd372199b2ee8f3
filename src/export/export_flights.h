// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "train/export/policy_trace.h"

namespace skein {

/// Flights that exported files are held to: some, each of so many policy steps, or control steps of
/// the flight control system.
inline constexpr int kExportFlights = 10, kExportSteps = 100, kFlightControlSteps = 500;

/// Where what was made in `made_in` is flown: in evaluations of the run's own environment if `path`
/// is the directory of a run, else of the preset of the task that has the aircraft. Throws Error if
/// there is no such preset.
EnvConfig ExportEnvironment(const std::string& path, const EnvConfig& made_in);

/// The flights of `policy` there.
PolicyTrace RecordExportFlights(const std::string& path, const RecurrentPolicy& policy,
                                const EnvConfig& made_in);

}  // namespace skein
