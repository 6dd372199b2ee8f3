// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/evaluation_report.h"

#include <fmt/format.h>

#include "src/config/settings.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

std::string Line(const char* mode, const FlightSummary& summary) {
  const auto figure = [&](int quantity) {
    const auto k = static_cast<std::size_t>(quantity);
    return FormatEstimate(Quantities()[k], summary.estimates[k]);
  };
  return fmt::format("{:14}success {} %   return {}   time to target {} s\n{:14}ended by {}", mode,
                     figure(kSuccessQuantity), figure(kReturnQuantity), figure(kTimeQuantity), "",
                     FormatTerminations(summary.result));
}

}  // namespace

EvaluationReport EvaluateBothWays(const RecurrentPolicy& policy, const EnvConfig& env, int episodes,
                                  std::uint64_t seed, WorkerPool& pool) {
  EvaluationOptions options;
  options.episodes = episodes;
  options.seed = seed;
  options.flight_metrics = true;
  const auto fly = [&](const Agent& agent) {
    return SummariseFlights(FlyEpisodes(agent, env, options, pool).episodes,
                            env.control_interval_s);
  };
  return {fly(Agent::MeanOf(policy)), fly(Agent::SamplingFrom(policy))};
}

Json EnvironmentJson(ProgramConfig config) {
  config.train.env = EvaluationConfig(config.train.env);
  Json environment = Json::object();
  for (const Field& field : FieldsOf(config)) {
    if (field.key.compare(0, 4, "env.") != 0) continue;
    // Scalars of TOML, as TomlText writes them, are JSON too.
    environment[field.key] = Json::parse(TomlText(field));
  }
  return environment;
}

Json ToJson(const EvaluationReport& report, const std::string& policy, const ProgramConfig& config,
            std::uint64_t seed, bool deterministic) {
  Json json = {{"policy", policy},
               {"task", config.train.env.task},
               {"mode", deterministic ? "deterministic" : "sampled"},
               {"seed", seed}};
  json.update(ToJson(deterministic ? report.deterministic : report.sampled));
  json["success_rate_deterministic"] = report.deterministic.result.success_rate;
  json["success_rate_sampled"] = report.sampled.result.success_rate;
  json["deterministic"] = ToJson(report.deterministic);
  json["sampled"] = ToJson(report.sampled);
  json["environment"] = EnvironmentJson(config);
  return json;
}

std::string ToText(const EvaluationReport& report, bool deterministic) {
  return fmt::format("{}\n{}\n{}, means over episodes with 95 % intervals:\n{}",
                     Line("deterministic", report.deterministic), Line("sampled", report.sampled),
                     deterministic ? "deterministic" : "sampled",
                     FormatFlightMetrics(deterministic ? report.deterministic : report.sampled));
}

}  // namespace skein
