// SPDX-License-Identifier: Apache-2.0
#include "src/bench/figure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/median.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostSamples = 1000;

/// An estimate of what `share` of all values are below, not of the samples alone: definition 8 of
/// Hyndman and Fan (The American Statistician 50, 1996), which few samples bias little. NaN of
/// none.
double Quantile(std::vector<double> samples, double share) {
  if (samples.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(samples.begin(), samples.end());
  const auto count = static_cast<double>(samples.size());
  const double place =
      std::clamp(share * (count + 1.0 / 3) + 1.0 / 3, 1.0, count) - 1;  // from 0 on
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, samples.size() - 1);
  const double from_below = place - static_cast<double>(below);
  return samples[below] + from_below * (samples[above] - samples[below]);
}

}  // namespace

std::vector<double> MediansOfParts(const std::vector<double>& samples, std::size_t most) {
  const std::size_t parts = std::min(samples.size(), most);
  std::vector<double> medians;
  for (std::size_t part = 0; part < parts; ++part) {
    const auto at = [&](std::size_t index) {
      return samples.begin() + static_cast<std::ptrdiff_t>(index * samples.size() / parts);
    };
    medians.push_back(Median({at(part), at(part + 1)}));
  }
  return medians;
}

Json ToJson(const std::vector<Figure>& figures) {
  Json json = Json::object();
  for (const Figure& figure : figures) {
    const double median = Median(figure.samples);
    const double spread = Quantile(figure.samples, 0.75) - Quantile(figure.samples, 0.25);
    json[figure.name] = {{"better", figure.more_is_better ? "more" : "less"},
                         {"median", median},
                         {"spread", spread / median},
                         {"samples", MediansOfParts(figure.samples, kMostSamples)}};
  }
  return json;
}

std::vector<Figure> ReadFigures(const Json& figures, const std::string& path) {
  std::vector<Figure> read;
  try {
    for (const auto& [name, json] : figures.items()) {
      Figure figure{name, json.at("better") == "more", json.at("samples")};
      for (const double sample : figure.samples) {
        if (!(sample > 0) || std::isinf(sample)) throw Error("a sample is not above 0");
      }
      if (figure.samples.empty()) throw Error("there is no sample");
      read.push_back(std::move(figure));
    }
  } catch (const std::exception& error) {
    throw Error(path + ": figures cannot be read: " + error.what());
  }
  return read;
}

}  // namespace skein
