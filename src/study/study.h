// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/config/program_config.h"

namespace skein {

/// Conditions (NAME=LEVEL, as of --condition) and assignments (KEY=VALUE, as of --set) on top.
struct StudySettings {
  std::vector<std::string> conditions, assignments;
};

/// One level of the conditions under which agents are evaluated.
struct StudyLevel {
  std::string name;
  StudySettings settings;
};

/// What `skein study` trains and evaluates: every task under every level with every seed.
struct Study {
  std::vector<std::string> tasks;
  std::vector<std::uint64_t> seeds;    ///< of trainings
  std::vector<StudyLevel> levels;      ///< that are carried out
  std::vector<StudyLevel> all_levels;  ///< of the file
  std::vector<std::string> agents;     ///< flown beside the trained policies
  std::string preset = "default";
  std::string aircraft;   ///< what flies, a name or a file; empty: as the presets say
  std::string low_level;  ///< for tasks of a high-level policy (ChooseLowLevelPolicy)
  std::vector<std::string> assignments;  ///< for trainings and evaluations
  struct Training {
    std::optional<double> steps;  ///< control steps; else the preset's
    /// What they start from, a run or a policy for each of the tasks; empty: fresh networks.
    std::vector<std::string> from;
    StudySettings settings;  ///< for trainings alone
    bool per_level = true;   ///< a training for every level, under it; else one for all
  } training;
  struct Evaluation {
    int episodes = 1000;
    std::uint64_t seed = 0;
    /// Flights go on for so long after their target was reached, but for tasks of points.
    std::optional<double> hold_s;
    std::optional<double> mission_min;  ///< or are missions of so long
  } evaluation;
};

/// What a user asks for beside the file; what is empty leaves the file as it is.
struct StudyChoice {
  std::vector<std::string> levels;   ///< names of the file's levels: these alone
  std::vector<std::uint64_t> seeds;  ///< instead of the file's
  std::optional<double> steps;       ///< budget of a training, control steps
  std::string aircraft;              ///< what flies
};

/// Reads the TOML file of a study (docs/reference/commands.md). Throws Error with file and line on
/// unknown keys, wrong types and lists that are empty or name something twice, and on a choice of
/// levels that the file has not.
Study ReadStudy(const std::string& path, const StudyChoice& choice = {});

/// What a training under `level` runs with. Throws Error on a configuration that cannot be.
ProgramConfig TrainingConfig(const Study& study, const std::string& task, const StudyLevel& level,
                             std::uint64_t seed);

/// The environment in which agents are evaluated under `level`.
ProgramConfig LevelConfig(const Study& study, const std::string& task, const StudyLevel& level);

}  // namespace skein
