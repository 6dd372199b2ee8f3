#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "envs/vec_env.h"
#include "simd/error.h"
#include "src/commands.h"
#include "src/conditions.h"
#include "src/configuration.h"
#include "src/controller_option.h"
#include "src/evaluation_report.h"
#include "src/flight_file.h"
#include "src/output_file.h"
#include "src/policy_file.h"
#include "src/presets.h"
#include "src/run_directory.h"
#include "train/policy.h"
#include "train/record_flights.h"

namespace skein {
namespace {

constexpr const char* kUntrained = "untrained";

struct EvalOptions {
  std::string policy, task;
  std::string preset = "default";
  CLI::Option* preset_option = nullptr;
  std::string config;
  std::vector<std::string> conditions, assignments;
  std::string controller;
  int episodes = 1000;
  bool deterministic = false;
  std::uint64_t seed = 0;
  int threads = 0;
  std::string json;
  std::string flights;
  int flights_count = 8;
};

/// What the policy was made for: the run's own configuration if it is given as a run, else the
/// preset's.
ProgramConfig BaseConfig(const EvalOptions& options, bool is_run) {
  if (!is_run || options.preset_option->count() > 0) {
    if (options.task.empty()) {
      throw Error("--task is needed to evaluate a policy that is not given as a run");
    }
    return ResolveConfig({options.task, options.preset, "", {}});
  }
  ProgramConfig config;
  ApplyTomlFile(options.policy + "/config.toml", &config);
  return config;
}

void ApplyOverrides(const EvalOptions& options, ProgramConfig* config) {
  const std::string task = options.task.empty() ? config->train.env.task : options.task;
  if (!options.config.empty()) ApplyTomlFile(options.config, config);
  ApplyConditionsAndAssignments(options.conditions, options.assignments, config);
  if (config->train.env.task != task) {
    throw Error(fmt::format("the configuration says env.task = {}, but --task is {}",
                            config->train.env.task, task));
  }
  CheckConsistent(*config);
}

/// Of a planned task a planner, or without a controller a pilot.
Policy UntrainedPolicy(const ProgramConfig& config, const EvalOptions& options) {
  std::shared_ptr<const Pilot> controller;
  if (!options.controller.empty()) {
    controller = ChooseController(config.train.env, options.controller).pilot;
  }
  const VecEnv env(config.train.env, 1, options.seed, 1, controller);
  return Policy::Untrained(config.train.network, env.observation_size(), env.action_size(),
                           options.seed, config.train.env.action_repeat, controller);
}

/// Writes the first episodes of the mode that is reported first.
void WriteFlights(const EvalOptions& options, const Policy& policy, const EnvConfig& env,
                  WorkerPool& pool) {
  const EvaluationOptions evaluation{options.episodes, options.seed, options.deterministic};
  const std::vector<RecordedFlight> flights =
      RecordFlights(policy, env, evaluation, options.flights_count, pool);
  WriteFile(options.flights, FlightsCsv(env, flights));
  fmt::print("{}: {} flights with {}\n", options.flights, flights.size(),
             options.deterministic ? "the mean action" : "sampled actions");
}

std::string Rates(const Policy& policy, const EnvConfig& env) {
  const std::string own = fmt::format("an action every {} control steps", env.action_repeat);
  if (policy.controller() == nullptr) return own;
  return fmt::format("{} for a controller with one every {}", own,
                     policy.controller()->action_repeat());
}

void Evaluate(const EvalOptions& options) {
  const std::string path = PolicyFileOf(options.policy);
  ProgramConfig config = BaseConfig(options, IsRunDirectory(options.policy));
  if (path != kUntrained && !options.controller.empty()) {
    throw Error("--controller is for --policy untrained: a trained planner brings its own");
  }
  std::optional<Policy> policy;
  if (path != kUntrained) {
    policy = Policy::Load(path);
    config.train.env.action_repeat = policy->action_repeat();
  }
  ApplyOverrides(options, &config);
  if (!policy) policy = UntrainedPolicy(config, options);
  policy = policy->WithBackend(config.train.learner.backend);
  WorkerPool pool(options.threads);
  const EvaluationReport report =
      EvaluateBothWays(*policy, config.train.env, options.episodes, options.seed, pool);
  if (!options.json.empty()) {
    WriteFile(options.json,
              ToJson(report, path, config, options.seed, options.deterministic).dump(1) + "\n");
  }
  fmt::print("{} on {}, {} episodes, seed {}, {}; {}\n{}\n", path, config.train.env.task,
             options.episodes, options.seed, Rates(*policy, config.train.env),
             Describe(policy->backend()), ToText(report));
  if (!options.flights.empty()) WriteFlights(options, *policy, config.train.env, pool);
}

}  // namespace

void AddEvalCommand(CLI::App* app) {
  auto options = std::make_shared<EvalOptions>();
  CLI::App* command = app->add_subcommand("eval", "Fly a policy over fresh episodes");
  command
      ->add_option("--policy", options->policy,
                   "policy file, checkpoint, directory of a run (its best policy), or the word "
                   "untrained (freshly initialised networks)")
      ->type_name("FILE_OR_RUN")
      ->required();
  command->add_option(
      "--task", options->task,
      fmt::format("what to fly: {} (default: the run's task)", fmt::join(PresetTasks(), ", ")));
  options->preset_option =
      command
          ->add_option("--preset", options->preset,
                       "environment settings to begin with (default: the run's own; for a policy "
                       "file, default)")
          ->type_name("NAME");
  command->add_option("--config", options->config, "TOML file on top of them")->type_name("FILE");
  command->add_option("--condition", options->conditions, ConditionHelp())
      ->type_name("NAME=LEVEL")
      ->allow_extra_args(false);
  command
      ->add_option("--set", options->assignments,
                   "one configuration key, such as env.observation_noise=0.03; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      ->add_option("--controller", options->controller,
                   "with --policy untrained: the policy of task control, or autopilot[:VARIANT], "
                   "that flies what the planner asks for; without it the sticks are flown")
      ->type_name("RUN_OR_POLICY");
  command->add_option("--episodes", options->episodes, "number of episodes")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  command->add_flag("--deterministic", options->deterministic,
                    "report the mean action first (default: sampled actions; both are flown)");
  command->add_option("--seed", options->seed, "seed of the episodes")
      ->check(CLI::Range(0.0, 0x1p53))
      ->capture_default_str();
  command
      ->add_option("--threads", options->threads,
                   "worker threads; results do not depend on it (default: one per CPU)")
      ->check(CLI::Range(1, 1024));
  command->add_option("--json", options->json, "write the results here")->type_name("FILE");
  CLI::Option* flights =
      command
          ->add_option("--flights", options->flights,
                       "write the first episodes here, a CSV row for every control step, for "
                       "scripts/plot flights (mean or sampled actions, as --deterministic says)")
          ->type_name("FILE");
  command
      ->add_option("--flights-count", options->flights_count,
                   "how many of them (all, if there are fewer)")
      ->check(CLI::Range(1, 1000))
      ->needs(flights)
      ->capture_default_str();
  command->footer(
      "A policy file knows for how many control steps it holds an action; --set "
      "env.action_repeat=N\n"
      "flies it at another rate. Success counts episodes that reach the target.\n"
      "Example: skein eval --policy runs/short --task heading --episodes 1000 --deterministic "
      "--json result.json\n"
      "         skein eval --policy runs/short --deterministic --flights flights.csv\n"
      "         skein eval --policy runs/short --condition windy=60fps,moderate --condition "
      "noisy=0.03");
  command->callback([options] { Evaluate(*options); });
}

}  // namespace skein
