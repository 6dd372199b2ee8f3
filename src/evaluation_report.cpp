#include "src/evaluation_report.h"

#include <fmt/format.h>

#include <cmath>

#include "src/settings.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

std::string Line(const char* mode, const EvaluationResult& result) {
  std::string line = fmt::format("{:14}success {:5.1f} %   return {:8.1f}   time to target {}\n",
                                 mode, 100 * result.success_rate, result.return_mean,
                                 std::isfinite(result.time_to_target_mean_s)
                                     ? fmt::format("{:.1f} s", result.time_to_target_mean_s)
                                     : "-");
  line += fmt::format("{:14}ended by", "");
  for (std::size_t kind = 1; kind < kNumTerminations; ++kind) {
    if (result.terminations[kind] > 0) {
      line += fmt::format(" {} {}", kTerminationNames[kind], result.terminations[kind]);
    }
  }
  return line;
}

}  // namespace

EvaluationReport EvaluateBothWays(const Policy& policy, const EnvConfig& env, int episodes,
                                  std::uint64_t seed, WorkerPool& pool) {
  EvaluationOptions options;
  options.episodes = episodes;
  options.seed = seed;
  EvaluationReport report;
  options.deterministic = true;
  report.deterministic = Evaluate(policy, env, options, pool);
  options.deterministic = false;
  report.sampled = Evaluate(policy, env, options, pool);
  return report;
}

Json ToJson(const EvaluationResult& result) {
  Json terminations = Json::object();
  for (std::size_t kind = 1; kind < kNumTerminations; ++kind) {
    terminations[kTerminationNames[kind]] = result.terminations[kind];
  }
  Json json = {{"episodes", result.episodes},
               {"success_rate", result.success_rate},
               {"return_mean", result.return_mean},
               {"time_to_target_mean", nullptr},
               {"terminations", terminations}};
  if (std::isfinite(result.time_to_target_mean_s)) {
    json["time_to_target_mean"] = result.time_to_target_mean_s;
  }
  return json;
}

Json ToJson(const EvaluationReport& report, const std::string& policy, const ProgramConfig& config,
            std::uint64_t seed, bool deterministic) {
  Json json = {{"policy", policy},
               {"task", config.train.env.task},
               {"mode", deterministic ? "deterministic" : "sampled"},
               {"seed", seed}};
  json.update(ToJson(deterministic ? report.deterministic : report.sampled));
  json["success_rate_deterministic"] = report.deterministic.success_rate;
  json["success_rate_sampled"] = report.sampled.success_rate;
  json["deterministic"] = ToJson(report.deterministic);
  json["sampled"] = ToJson(report.sampled);
  Json& environment = json["environment"] = Json::object();
  for (const Setting& setting : Settings()) {
    if (setting.key.compare(0, 4, "env.") == 0) {
      // Scalars of TOML, as FormatValue writes them, are JSON too.
      environment[setting.key] = Json::parse(FormatValue(setting, config));
    }
  }
  return json;
}

std::string ToText(const EvaluationReport& report) {
  return Line("deterministic", report.deterministic) + "\n" + Line("sampled", report.sampled);
}

}  // namespace skein
