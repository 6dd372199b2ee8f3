// SPDX-License-Identifier: Apache-2.0
#include "src/commands/flight_options.h"

#include <fmt/format.h>

#include "src/config/conditions.h"
#include "src/config/configuration.h"
#include "src/config/usage_error.h"
#include "src/config/whole_number.h"
#include "src/evaluation/flight_file.h"
#include "src/files/output_file.h"

namespace skein {

void AddFlightOptions(CLI::App* command, const FlightOptionTexts& texts, FlightOptions* options) {
  command->add_option("--task", options->task, texts.task)->type_name("TASK");
  options->preset_option =
      command->add_option("--preset", options->preset, texts.preset)->type_name("PRESET");
  command->add_option("--config", options->config, "TOML file on top of them")->type_name("FILE");
  command->add_option("--condition", options->conditions, ConditionHelp())
      ->type_name("NAME=LEVEL")
      ->allow_extra_args(false);
  command
      ->add_option("--set", options->assignments,
                   "one configuration key, such as env.observation_noise=0.03; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  CLI::Option* hold =
      command
          ->add_option("--hold", options->hold_s,
                       "go on for so long after the target was reached, and measure how it is held "
                       "(env.hold_s)")
          ->type_name("SECONDS")
          ->transform(NumberAboveZero());
  command
      ->add_option("--mission", options->mission_min,
                   "fly for so long, a new target whenever one was held "
                   "(env.mission.length_s)")
      ->type_name("MINUTES")
      ->transform(NumberAboveZero())
      ->excludes(hold);
  command->add_option("--episodes", options->episodes, "number of episodes")
      ->transform(WholeNumber(1, 10000000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "seed of the episodes")
      ->transform(WholeNumber(0, 0x1p53))
      ->capture_default_str();
  command
      ->add_option("--threads", options->threads,
                   "worker threads; results do not depend on it (default: one per CPU)")
      ->transform(WholeNumber(1, 1024));
  command->add_option("--json", options->json, texts.json)->type_name("FILE");
  CLI::Option* flights =
      command->add_option("--flights", options->flights, texts.flights)->type_name("FILE");
  command
      ->add_option("--flights-count", options->flights_count,
                   "how many of them (all, if there are fewer)")
      ->transform(WholeNumber(1, 1000))
      ->needs(flights)
      ->capture_default_str();
  command
      ->add_flag("--flights-observations", options->flights_observations,
                 "write what the policy observed, too (22 columns)")
      ->needs(flights);
}

void ApplyOverrides(const FlightOptions& options, ProgramConfig* config) {
  for (const std::string& assignment : options.assignments) {
    for (const char* table : {"run.", "ppo.", "evaluation.", "checkpoint."}) {
      if (KeyOf(assignment).rfind(table, 0) != 0) continue;
      throw UsageError(fmt::format("--set {}: is for trainings and changes no flight", assignment));
    }
  }
  const ProgramConfig base = *config;
  const std::string& task = options.task.empty() ? base.train.env.task : options.task;
  AsUsage([&] {
    if (!options.config.empty()) ApplyTomlFile(options.config, config);
    ApplyConditionsAndAssignments(options.conditions, options.assignments, config);
    ApplyConditionsAndAssignments({}, FlightLengthAssignments(options.hold_s, options.mission_min),
                                  config);
    RequireTask(*config, task);
    RequireOwnSpeeds(base, *config);
    CheckConsistent(*config);
  });
}

void WriteFlights(const FlightOptions& options, const std::string& path, const std::string& manner,
                  const Agent& agent, const EnvConfig& env, WorkerPool& pool) {
  EvaluationOptions evaluation;
  evaluation.episodes = options.episodes;
  evaluation.seed = options.seed;
  const std::vector<RecordedFlight> flights =
      RecordFlights(agent, env, evaluation, options.flights_count, pool);
  WriteFile(path, FlightsCsv(env, flights,
                             options.flights_observations ? FlightColumns::kStatesAndObservations
                                                          : FlightColumns::kStates));
  fmt::print("{}: {} flights {}\n", path, flights.size(), manner);
}

}  // namespace skein
