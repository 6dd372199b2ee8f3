// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "src/evaluation/comparison.h"
#include "src/evaluation/evaluation_report.h"
#include "src/files/csv_text.h"
#include "src/files/text_table.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

// 100 columns: what a row is of, and three agents.
constexpr std::size_t kLabelWidth = 28, kCellWidth = 24, kAgentsPerTable = 3;

std::string Label(const Quantity& quantity) {
  if (quantity.symbol.empty()) return quantity.label;
  return quantity.section == QuantitySection::kFlight
             ? fmt::format("{:6}{}", quantity.symbol, quantity.label)
             : fmt::format("{} {}", quantity.symbol, quantity.label);
}

std::string PValue(double p) { return p < 0.001 ? "p < 0.001" : fmt::format("p = {:.3f}", p); }

/// The agents [begin, end) of the comparison.
class AgentColumns {
 public:
  AgentColumns(const Comparison& comparison, std::size_t begin, std::size_t end)
      : comparison_(comparison), begin_(begin), end_(end) {}

  template <typename CellOf>
  void Row(const std::string& label, const CellOf& cell_of, std::string* text) const {
    TextTable table(kLabelWidth, kCellWidth, text);
    table.Begin(label);
    for (std::size_t i = begin_; i < end_; ++i) table.Cell(cell_of(comparison_.agents[i]));
    table.End();
  }

  void Flights(std::string* text) const {
    std::vector<std::string> names;
    for (std::size_t i = begin_; i < end_; ++i) names.push_back(comparison_.agents[i].name);
    TextTable(kLabelWidth, kCellWidth, text).Headings(names);
    QuantitySection section = QuantitySection::kOutcome;
    for (std::size_t k = 0; k < comparison_.quantities.size(); ++k) {
      const Quantity& quantity = comparison_.quantities[k];
      if (!HasOwnPlace(quantity)) continue;
      if (quantity.section != section) Title(quantity.section, text);
      section = quantity.section;
      const auto cell = [k](const ComparedAgent& agent) { return FormatFigure(agent.summary, k); };
      Row(Label(quantity), cell, text);
    }
    for (std::size_t kind = 1; kind < kNumTerminations; ++kind) {
      const auto count = [kind](const ComparedAgent& agent) {
        return agent.summary.result.terminations[kind];
      };
      const std::string label = EndLabel(comparison_.agents[begin_].summary.is_mission, kind);
      if (label.empty()) continue;
      if (std::none_of(comparison_.agents.begin(), comparison_.agents.end(), count)) continue;
      const auto cell = [&](const ComparedAgent& agent) { return fmt::format("{}", count(agent)); };
      Row(label, cell, text);
    }
  }

  void Differences(std::string* text) const {
    for (std::size_t k = 0; k < comparison_.quantities.size(); ++k) {
      const Quantity& quantity = comparison_.quantities[k];
      if (!quantity.is_headline || quantity.statistic == Statistic::kPerHour) continue;
      const auto cell = [&](const ComparedAgent& agent) {
        return IsFirst(agent) ? "-" : FormatEstimate(quantity, agent.against[0].estimates[k]);
      };
      Row("  " + quantity.label, cell, text);
      if (k == kSuccessQuantity) Row("    McNemar's test", McNemar, text);
      if (k == kTimeQuantity) Row("    episodes both reached", BothReached, text);
    }
  }

 private:
  static bool IsFirst(const ComparedAgent& agent) { return agent.against.empty(); }

  static std::string McNemar(const ComparedAgent& agent) {
    return IsFirst(agent) ? "-" : PValue(agent.against[0].success_p_value);
  }

  static std::string BothReached(const ComparedAgent& agent) {
    return IsFirst(agent) ? "-"
                          : fmt::format("{}", agent.against[0].estimates[kTimeQuantity].count);
  }

  static void Title(QuantitySection section, std::string* text) {
    const std::string title = TitleOf(section);
    if (!title.empty()) *text += title + ":\n";
  }

  const Comparison& comparison_;
  std::size_t begin_, end_;
};

std::string CsvHeader(const std::vector<Quantity>& quantities) {
  std::string header = "task,conditions,agent,episodes,seed,policy_step_s";
  for (const char* against : {"", "_less_first"}) {
    for (const Quantity& quantity : quantities) {
      header += fmt::format(",{0}{1},{0}{1}_low,{0}{1}_high", quantity.key, against);
    }
  }
  header += ",success_p_value";
  for (std::size_t kind = 1; kind < kNumTerminations; ++kind) {
    header += fmt::format(",ended_{}", kTerminationNames[kind]);
  }
  return header + "\n";
}

Json DifferencesJson(const PairedDifferences& paired, const std::vector<Quantity>& quantities) {
  Json estimates = Json::object();
  for (std::size_t k = 0; k < quantities.size(); ++k) {
    estimates[quantities[k].key] = ToJson(paired.estimates[k]);
  }
  return {{"estimates", estimates}, {"success_p_value", paired.success_p_value}};
}

}  // namespace

std::string ToText(const Comparison& comparison) {
  std::string text =
      fmt::format("{}, the same {} for all (seed {}); means with 95 % intervals\n{}\n",
                  comparison.task, Counted(comparison.episodes, "episode"), comparison.seed,
                  InLines("  ", comparison.conditions));
  for (const ComparedAgent& agent : comparison.agents) {
    text += fmt::format("  {}: acts every {:.4g} s\n", agent.name,
                        agent.action_repeat * comparison.control_interval_s);
  }
  for (std::size_t begin = 0; begin < comparison.agents.size(); begin += kAgentsPerTable) {
    const std::size_t end = std::min(begin + kAgentsPerTable, comparison.agents.size());
    const AgentColumns columns(comparison, begin, end);
    text += "\n";
    columns.Flights(&text);
    if (comparison.agents.size() == 1) continue;
    text += fmt::format("paired differences, agent minus {}:\n", comparison.agents[0].name);
    columns.Differences(&text);
  }
  text.pop_back();
  return text;
}

std::string ToCsv(const Comparison& comparison) {
  std::string rows = CsvHeader(comparison.quantities);
  for (const ComparedAgent& agent : comparison.agents) {
    rows += fmt::format("{},{},{},{},{},{}", CsvText(comparison.task),
                        CsvText(comparison.conditions), CsvText(agent.name), comparison.episodes,
                        comparison.seed, agent.action_repeat * comparison.control_interval_s);
    for (const Estimate& estimate : agent.summary.estimates) rows += CsvCells(estimate);
    if (agent.against.empty()) {
      rows += std::string(3 * comparison.quantities.size() + 1, ',');
    } else {
      for (const Estimate& estimate : agent.against[0].estimates) rows += CsvCells(estimate);
      rows += fmt::format(",{}", agent.against[0].success_p_value);
    }
    for (std::size_t kind = 1; kind < kNumTerminations; ++kind) {
      rows += fmt::format(",{}", agent.summary.result.terminations[kind]);
    }
    rows += "\n";
  }
  return rows;
}

Json ToJson(const Comparison& comparison, const ProgramConfig& config) {
  Json agents = Json::array();
  for (const ComparedAgent& agent : comparison.agents) {
    Json json = {{"name", agent.name}, {"action_repeat", agent.action_repeat}};
    json.update(ToJson(agent.summary));
    if (!agent.against.empty()) {
      Json against = Json::array();
      for (const PairedDifferences& paired : agent.against) {
        against.push_back(DifferencesJson(paired, comparison.quantities));
      }
      json["against_first"] = against[0];
      json["against"] = against;
    }
    agents.push_back(std::move(json));
  }
  return {{"task", comparison.task},
          {"episodes", comparison.episodes},
          {"seed", comparison.seed},
          {"starts", fmt::format("{:016x}", comparison.starts)},
          {"conditions", comparison.conditions},
          {"agents", agents},
          {"environment", EnvironmentJson(config)}};
}

}  // namespace skein
