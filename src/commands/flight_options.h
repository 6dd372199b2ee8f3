// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/config/program_config.h"
#include "train/policy/record_flights.h"

namespace skein {

/// What the commands that fly episodes have in common: the environment and the episodes.
struct FlightOptions {
  std::string task;
  std::string preset = "default";
  CLI::Option* preset_option = nullptr;
  std::string config;
  std::vector<std::string> conditions, assignments;
  std::optional<double> hold_s, mission_min;
  int episodes = 1000;
  std::uint64_t seed = 0;
  int threads = 0;
  std::string json;
  std::string flights;
  int flights_count = 8;
  bool flights_observations = false;
};

/// What of their help the commands say differently.
struct FlightOptionTexts {
  std::string task, preset, json, flights;
};

/// Adds the options to a command; `options` must live as long as it.
void AddFlightOptions(CLI::App* command, const FlightOptionTexts& texts, FlightOptions* options);

/// The environment of `config` with --config, --condition, --set, --hold and --mission on top.
/// Throws UsageError if they cannot be, or name another task than --task (without it: than
/// `config`).
void ApplyOverrides(const FlightOptions& options, ProgramConfig* config);

/// Records the first episodes to `path`, and says so. `manner` is how they were flown.
void WriteFlights(const FlightOptions& options, const std::string& path, const std::string& manner,
                  const Agent& agent, const EnvConfig& env, WorkerPool& pool);

}  // namespace skein
