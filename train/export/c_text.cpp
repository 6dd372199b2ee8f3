// SPDX-License-Identifier: Apache-2.0
#include "train/export/c_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "base/error.h"

namespace skein {

std::string CNumber(float value) {
  char buffer[32];
  std::string text(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "f";
}

std::string CArray(const std::string& name, const std::vector<float>& values) {
  constexpr std::size_t kPerLine = 8;
  std::string text = "static const float " + name + "[" + std::to_string(values.size()) + "] = {";
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += i % kPerLine == 0 ? "\n  " : " ";
    text += CNumber(values[i]) + ",";
  }
  text.back() = '}';
  return text + ";\n";
}

std::string FillIn(std::string_view text, const std::map<std::string, std::string>& values) {
  std::string filled;
  for (;;) {
    const std::size_t begin = text.find('@');
    filled += text.substr(0, begin);
    if (begin == std::string_view::npos) return filled;
    const std::size_t end = text.find('@', begin + 1);
    const std::string key(text.substr(begin + 1, end - begin - 1));
    const auto found = values.find(key);
    if (found == values.end()) throw Error("a template has no value for @" + key + "@");
    filled += found->second;
    text.remove_prefix(end + 1);
  }
}

std::string UpperCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string CommentLines(const std::string& text) {
  std::string lines = " * ";
  for (const char c : text) {
    if (c == '/' && lines.back() == '*') lines += ' ';
    lines += c;
    if (c == '\n') lines += " * ";
  }
  return lines;
}

}  // namespace skein
