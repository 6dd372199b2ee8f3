// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>

namespace skein {

/// Damages a text as a bad disk or a hostile hand would, the same for the same seed.
class Damage {
 public:
  explicit Damage(std::uint32_t seed) : random_(seed) {}

  /// One to three damages.
  std::string Of(std::string text) {
    constexpr void (Damage::*kWays[])(std::string*) = {
        &Damage::Truncate, &Damage::FlipBit,       &Damage::Remove,
        &Damage::Repeat,   &Damage::ReplaceNumber, &Damage::ReplaceNumber};
    const int damages = 1 + static_cast<int>(random_() % 3);
    for (int i = 0; i < damages && !text.empty(); ++i) {
      (this->*kWays[random_() % std::size(kWays)])(&text);
    }
    return text;
  }

  std::size_t Below(std::size_t size) { return random_() % std::max<std::size_t>(size, 1); }

 private:
  void Truncate(std::string* text) { text->resize(Below(text->size())); }

  void FlipBit(std::string* text) {
    char& byte = (*text)[Below(text->size())];
    byte = static_cast<char>(byte ^ (1 << random_() % 8));
  }

  void Remove(std::string* text) { text->erase(Below(text->size()), 1 + random_() % 40); }

  void Repeat(std::string* text) {
    const std::string part = text->substr(Below(text->size()), 1 + random_() % 200);
    text->insert(Below(text->size()), part);
  }

  /// Puts something that a reader may stumble over in place of a number.
  void ReplaceNumber(std::string* text) {
    static const char* const kValues[] = {"0",
                                          "-1",
                                          "1e-13",
                                          "1e13",
                                          "1e400",
                                          "-0.0",
                                          "null",
                                          "[]",
                                          "{}",
                                          "\"x\"",
                                          "true",
                                          "1e12",
                                          "-1e12",
                                          "1e-12",
                                          "[1,2]",
                                          "NaN",
                                          "99999999999999999999"};
    const std::size_t from = text->find_first_of("0123456789-", Below(text->size()));
    if (from == std::string::npos) return;
    std::size_t to = text->find_first_not_of("0123456789.-+eE", from);
    if (to == std::string::npos) to = text->size();
    text->replace(from, to - from, kValues[random_() % std::size(kValues)]);
  }

  std::mt19937 random_;
};

}  // namespace skein
