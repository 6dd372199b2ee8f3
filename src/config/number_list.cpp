// SPDX-License-Identifier: Apache-2.0
#include "src/config/number_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/config/whole_number.h"

namespace skein {
namespace {

constexpr double kMostNumbers = 10000;

std::optional<std::vector<double>> ReadSpaced(const std::string& text, std::size_t dots) {
  const std::size_t colon = text.find(':', dots);
  if (colon == std::string::npos) return std::nullopt;
  const auto from = ReadNumber(text.substr(0, dots));
  const auto to = ReadNumber(text.substr(dots + 2, colon - dots - 2));
  const auto step = ReadNumber(text.substr(colon + 1));
  if (!from || !to || !step || !(*step > 0) || !(*to >= *from)) return std::nullopt;
  // A step of 0.1 is not one: what the last number misses by rounding is not missed.
  const double count = std::floor((*to - *from) / *step * (1 + 1e-12) + 1e-9) + 1;
  if (!(count <= kMostNumbers)) return std::nullopt;
  std::vector<double> numbers;
  for (int i = 0; i < static_cast<int>(count); ++i) numbers.push_back(*from + i * *step);
  return numbers;
}

}  // namespace

std::optional<std::vector<double>> ReadNumberList(const std::string& text) {
  const std::size_t dots = text.find("..");
  if (dots != std::string::npos) return ReadSpaced(text, dots);
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
