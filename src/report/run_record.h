// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/config/program_config.h"
#include "src/files/csv_columns.h"

namespace skein {

/// What the directory of a run holds that a report shows.
struct RunRecord {
  std::string path;
  std::string name;    ///< the last part of the path
  std::string preset;  ///< as the run's log says it; empty if it does not
  ProgramConfig config;
  CsvColumns metrics, timing;
  nlohmann::ordered_json evaluation;  ///< evaluation.json; null before the run's end
  std::vector<std::string> notes;     ///< what is missing or damaged, for people
};

/// Reads without taking the run's lock, so that a training may go on meanwhile. What a crash has
/// cut short is left out, and noted. Throws Error on a directory that holds no run, or one whose
/// configuration this version does not know.
RunRecord ReadRunRecord(const std::string& path);

/// Every configuration key of the run's task: key, value, help, and preset (its value there) where
/// it differs from the preset that the run began with.
nlohmann::ordered_json ConfigurationJson(const RunRecord& run);

/// The configuration less its seed, as text: equal for runs that are repetitions of one another.
std::string Repetition(const RunRecord& run);

}  // namespace skein
