// SPDX-License-Identifier: Apache-2.0
#include "src/config/number_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/config/whole_number.h"

namespace skein {
namespace {

constexpr double kMostNumbers = 10000;

/// FROM..TO:STEP.
struct Spacing {
  double from = 0, to = 0, step = 0;

  double Count() const {
    // A step of 0.1 is not one: what the last number misses by rounding is not missed.
    return std::floor((to - from) / step * (1 + 1e-12) + 1e-9) + 1;
  }
  /// What is wrong with it; empty if nothing is.
  std::string Fault() const {
    if (!(step > 0)) return "STEP must be above 0";
    if (!(to >= from)) return "TO must not be below FROM";
    if (!(Count() <= kMostNumbers)) return fmt::format("more than {:.0f} numbers", kMostNumbers);
    return "";
  }
};

std::optional<Spacing> ReadSpacing(const std::string& text) {
  const std::size_t dots = text.find(".."), colon = text.find(':', dots);
  if (dots == std::string::npos || colon == std::string::npos) return std::nullopt;
  const auto from = ReadNumber(text.substr(0, dots));
  const auto to = ReadNumber(text.substr(dots + 2, colon - dots - 2));
  const auto step = ReadNumber(text.substr(colon + 1));
  if (!from || !to || !step) return std::nullopt;
  return Spacing{*from, *to, *step};
}

std::optional<std::vector<double>> ReadSpaced(const std::string& text) {
  const std::optional<Spacing> spacing = ReadSpacing(text);
  if (!spacing || !spacing->Fault().empty()) return std::nullopt;
  std::vector<double> numbers;
  for (int i = 0; i < static_cast<int>(spacing->Count()); ++i) {
    // As people would write it: 0.3 + 3 * 0.6 is 2.1, and not 2.0999999999999996.
    numbers.push_back(*ReadNumber(fmt::format("{:.12g}", spacing->from + i * spacing->step)));
  }
  return numbers;
}

}  // namespace

std::optional<std::vector<double>> ReadNumberList(const std::string& text) {
  if (text.find("..") != std::string::npos) return ReadSpaced(text);
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const auto number = ReadNumber(text.substr(at, end - at));
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers.push_back(*number);
    at = end + 1;
  }
  if (numbers.size() > kMostNumbers) return std::nullopt;
  return numbers;
}

CLI::Option* AddNumberList(CLI::App* command, const std::string& name, std::vector<double>* numbers,
                           double min, const std::string& kind, const std::string& description) {
  const auto is_list = [min, kind](const std::string& text) -> std::string {
    const auto list = ReadNumberList(text);
    if (list && std::all_of(list->begin(), list->end(), [min](double x) { return x > min; })) {
      return "";
    }
    const std::optional<Spacing> spacing = ReadSpacing(text);
    if (spacing && !spacing->Fault().empty()) {
      return fmt::format("'{}': {}", text, spacing->Fault());
    }
    return fmt::format("'{}' is not a {}, several of them (A,B,C) or FROM..TO:STEP", text, kind);
  };
  return command
      ->add_option_function<std::string>(
          name,
          [numbers](const std::string& text) {
            *numbers = *ReadNumberList(text);
            std::sort(numbers->begin(), numbers->end());
            numbers->erase(std::unique(numbers->begin(), numbers->end()), numbers->end());
          },
          description)
      ->check(CLI::Validator(is_list, ""))
      ->type_name("NUMBERS");
}

}  // namespace skein
