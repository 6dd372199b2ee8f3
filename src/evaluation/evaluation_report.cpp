// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/evaluation_report.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "src/config/settings.h"
#include "src/files/text_table.h"
#include "train/ranks/shared_episodes.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

/// "success 99.6 (98.0, 99.9) %".
std::string Phrase(const Quantity& quantity, const Estimate& estimate) {
  const std::size_t unit = quantity.label.find(", ");
  const std::string value = FormatEstimate(quantity, estimate);
  if (unit == std::string::npos) return fmt::format("{} {}", quantity.label, value);
  return fmt::format("{} {} {}", quantity.label.substr(0, unit), value,
                     quantity.label.substr(unit + 2));
}

/// The headlines of what came of the episodes, and how they ended.
std::string Lines(const char* mode, const FlightSummary& summary) {
  const std::string begin = fmt::format("{:14}", mode);
  std::vector<std::string> phrases;
  for (std::size_t k = 0; k < summary.quantities.size(); ++k) {
    const Quantity& quantity = summary.quantities[k];
    if (quantity.section != QuantitySection::kOutcome || !quantity.is_headline) continue;
    phrases.push_back(Phrase(quantity, summary.estimates[k]));
  }
  const std::string lines = InLines(begin, phrases, "   "), ends = FormatEnds(summary);
  return ends.empty() ? lines : fmt::format("{}\n{:{}}{}", lines, "", begin.size(), ends);
}

}  // namespace

FlightSummary EvaluateAgent(const Agent& agent, const EnvConfig& env, int episodes,
                            std::uint64_t seed, WorkerPool& pool, Ranks& ranks) {
  EvaluationOptions options;
  options.episodes = episodes;
  options.seed = seed;
  options.flight_metrics = true;
  return SummariseFlights(FlyEpisodesOnRanks(agent, env, options, pool, ranks).episodes, env);
}

EvaluationReport EvaluateBothWays(const RecurrentPolicy& policy, const EnvConfig& env, int episodes,
                                  std::uint64_t seed, WorkerPool& pool, Ranks& ranks) {
  const auto fly = [&](const Agent& agent) {
    return EvaluateAgent(agent, env, episodes, seed, pool, ranks);
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

Json ToJson(const FlightSummary& summary, const std::string& agent, const ProgramConfig& config,
            std::uint64_t seed) {
  Json json = {{"agent", agent}, {"task", config.train.env.task}, {"seed", seed}};
  json.update(ToJson(summary));
  json["environment"] = EnvironmentJson(config);
  return json;
}

std::string ToText(const EvaluationReport& report, bool deterministic) {
  return fmt::format("{}\n{}\n{}, means over episodes with 95 % intervals:\n{}",
                     Lines("deterministic", report.deterministic), Lines("sampled", report.sampled),
                     deterministic ? "deterministic" : "sampled",
                     FormatFlightMetrics(deterministic ? report.deterministic : report.sampled));
}

std::string ToText(const FlightSummary& summary) {
  return fmt::format("{}\nmeans over episodes with 95 % intervals:\n{}", Lines("outcome", summary),
                     FormatFlightMetrics(summary));
}

std::string ToSummary(const EvaluationReport& report) {
  constexpr std::size_t kLabelWidth = 28, kCellWidth = 25;
  const FlightSummary &mean = report.deterministic, &sampled = report.sampled;
  std::string text;
  TextTable table(kLabelWidth, kCellWidth, &text);
  table.Begin("");
  table.Cell("mean action");
  table.Cell("sampled actions");
  table.End();
  for (std::size_t k = 0; k < mean.quantities.size(); ++k) {
    const Quantity& quantity = mean.quantities[k];
    if (!quantity.is_headline || std::isnan(mean.estimates[k].value)) continue;
    table.Begin(quantity.label);
    table.Cell(FormatEstimate(quantity, mean.estimates[k]));
    table.Cell(FormatEstimate(quantity, sampled.estimates[k]));
    table.End();
  }
  const std::string ends = FormatEnds(mean);
  if (ends.empty()) text.pop_back();  // the last row's newline
  return text + ends;
}

}  // namespace skein
