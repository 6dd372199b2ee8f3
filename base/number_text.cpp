// SPDX-License-Identifier: Apache-2.0
#include "base/number_text.h"

#include <charconv>

namespace skein {

std::string ShortestText(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string RoundedText(double value, int digits) {
  char text[32];
  const auto general = std::chars_format::general;
  return {text, std::to_chars(text, text + sizeof text, value, general, digits).ptr};
}

}  // namespace skein
