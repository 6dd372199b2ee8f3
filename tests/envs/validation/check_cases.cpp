// SPDX-License-Identifier: Apache-2.0
#include "tests/envs/validation/check_cases.h"

#include <fstream>

namespace skein::validation {

const nlohmann::json& CheckCases() {
  static const nlohmann::json cases = [] {
    std::ifstream file(SKEIN_TEST_DATA "/nesc.json");
    return nlohmann::json::parse(file);
  }();
  return cases;
}

std::vector<double> Simulated(const nlohmann::json& check_case, const std::string& quantity,
                              std::size_t index) {
  return check_case.at(quantity).at(index).get<std::vector<double>>();
}

}  // namespace skein::validation
