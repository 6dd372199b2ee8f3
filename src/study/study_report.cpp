// SPDX-License-Identifier: Apache-2.0
#include "src/study/study_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "src/evaluation/flight_summary.h"
#include "src/files/csv_text.h"
#include "src/files/text_table.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

double NumberOf(const Json& json) { return json.is_number() ? json.get<double>() : std::nan(""); }

bool Has(const Json& comparison, const Quantity& quantity) {
  return comparison["agents"][0]["estimates"].contains(quantity.key);
}

/// What the i-th agent of a comparison did; NaN of what it was not measured by.
Estimate EstimateOf(const Json& comparison, std::size_t agent, const Quantity& quantity) {
  if (!Has(comparison, quantity)) return EstimateMean({});
  const Json& estimate = comparison["agents"][agent]["estimates"][quantity.key];
  return {NumberOf(estimate["value"]), NumberOf(estimate["low"]), NumberOf(estimate["high"]),
          estimate["count"].get<int>()};
}

std::vector<double> ValuesOfSeeds(const Json& comparison, std::size_t trained,
                                  const Quantity& quantity) {
  std::vector<double> values;
  for (std::size_t i = 0; i < trained; ++i) {
    values.push_back(EstimateOf(comparison, i, quantity).value);
  }
  return values;
}

/// The mean of the seeds; of shares with the part of the interval that they can lie in.
Estimate MeanOfSeeds(const Json& comparison, std::size_t trained, const Quantity& quantity) {
  Estimate mean = EstimateMean(ValuesOfSeeds(comparison, trained, quantity));
  if (quantity.statistic == Statistic::kShare) {
    mean.low = std::clamp(mean.low, 0.0, 1.0);
    mean.high = std::clamp(mean.high, 0.0, 1.0);
  }
  return mean;
}

/// "99.8 (99.5 to 100.0)": the mean of the seeds, and the lowest and highest of them.
std::string Spread(const Quantity& quantity, const std::vector<double>& values) {
  Estimate mean = EstimateMean(values);
  mean.low = mean.high = std::nan("");
  std::string text = FormatEstimate(quantity, mean);
  std::vector<double> known;
  std::copy_if(values.begin(), values.end(), std::back_inserter(known),
               [](double value) { return !std::isnan(value); });
  if (known.size() < 2) return text;
  const auto [low, high] = std::minmax_element(known.begin(), known.end());
  return text + fmt::format(" ({:.{}f} to {:.{}f})", *low * quantity.shown_per_unit,
                            quantity.decimals, *high * quantity.shown_per_unit, quantity.decimals);
}

/// That of an agent called `name`.
std::uint64_t SeedIn(const std::string& name) {
  const char* const end = name.data() + name.size();
  std::uint64_t seed = 0;
  const auto [stop, failure] = std::from_chars(name.data() + kSeedPrefix.size(), end, seed);
  if (failure != std::errc() || stop != end) {
    throw Error(fmt::format("a comparison names an agent '{}', which is no seed (want '{}1')", name,
                            kSeedPrefix));
  }
  return seed;
}

}  // namespace

std::vector<std::uint64_t> SeedsOf(const Json& comparison) {
  std::vector<std::uint64_t> seeds;
  for (const Json& agent : comparison.at("agents")) {
    const auto name = agent.at("name").get<std::string>();
    if (name.rfind(kSeedPrefix, 0) != 0) break;
    seeds.push_back(SeedIn(name));
  }
  return seeds;
}

std::string StudyCsv(const Json& results, const std::vector<Quantity>& quantities) {
  std::string text = "task,level,agent,episodes,seeds";
  for (const Quantity& quantity : quantities) {
    text += fmt::format(",{0},{0}_low,{0}_high", quantity.key);
  }
  text += "\n";
  for (const Json& result : results) {
    const Json& comparison = result["comparison"];
    const std::size_t trained = SeedsOf(comparison).size();
    const auto begin = [&](const std::string& agent, const std::string& seeds) {
      text += fmt::format("{},{},{},{},{}", CsvText(result["task"].get<std::string>()),
                          CsvText(result["level"].get<std::string>()), CsvText(agent),
                          comparison["episodes"].get<int>(), seeds);
    };
    begin("trained", fmt::format("{}", trained));
    for (const Quantity& quantity : quantities) {
      text += CsvCells(MeanOfSeeds(comparison, trained, quantity));
    }
    text += "\n";
    for (std::size_t i = 0; i < comparison["agents"].size(); ++i) {
      begin(comparison["agents"][i]["name"].get<std::string>(), i < trained ? "1" : "");
      for (const Quantity& quantity : quantities) {
        text += CsvCells(EstimateOf(comparison, i, quantity));
      }
      text += "\n";
    }
  }
  return text;
}

std::string StudyText(const Json& results, const std::vector<Quantity>& quantities) {
  constexpr std::size_t kLabelWidth = 30, kCellWidth = 24;
  const Json none = {{"agents", Json::array()}};
  const Json& first = results.empty() ? none : results[0]["comparison"];
  const std::size_t trained = SeedsOf(first).size();
  std::string text;
  TextTable table(kLabelWidth, kCellWidth, &text);
  for (std::size_t k = 0; k < quantities.size(); ++k) {
    const Quantity& quantity = quantities[k];
    if (!quantity.is_headline || k == kReturnQuantity) continue;
    table.Begin(quantity.label);
    table.Cell(fmt::format("trained ({})", Counted(static_cast<int>(trained), "seed")));
    for (std::size_t i = trained; i < first["agents"].size(); ++i) {
      table.Name(first["agents"][i]["name"].get<std::string>());
    }
    table.End();
    for (const Json& result : results) {
      const Json& comparison = result["comparison"];
      if (!Has(comparison, quantity)) continue;
      table.Begin(fmt::format("  {}, {}", result["task"].get<std::string>(),
                              result["level"].get<std::string>()));
      table.Cell(Spread(quantity, ValuesOfSeeds(comparison, trained, quantity)));
      for (std::size_t i = trained; i < comparison["agents"].size(); ++i) {
        table.Cell(FormatEstimate(quantity, EstimateOf(comparison, i, quantity)));
      }
      table.End();
    }
  }
  text += "trained: the mean of the seeds, and the lowest and highest of them";
  return text;
}

}  // namespace skein
