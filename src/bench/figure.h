// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace skein {

/// What a benchmark measures, several times in one run.
struct Figure {
  std::string name;  ///< "rk4_step_ms"
  bool more_is_better = false;
  std::vector<double> samples;  ///< in the order in which they were taken
};

/// The medians of at most `most` parts of equal length, to one, in their order: what is measured in
/// a row is alike for a while, and says as much as a few samples that are further apart.
std::vector<double> MediansOfParts(const std::vector<double>& samples, std::size_t most);

/// An object by name: `better` ("more" or "less"), `median`, `spread` (difference of the quartiles
/// over the median; of few samples an estimate that is hardly biased) and `samples`, of more than a
/// thousand the medians of a thousand parts.
nlohmann::ordered_json ToJson(const std::vector<Figure>& figures);

/// What ToJson wrote. Throws Error, which begins with `path`, on anything else.
std::vector<Figure> ReadFigures(const nlohmann::ordered_json& figures, const std::string& path);

}  // namespace skein
