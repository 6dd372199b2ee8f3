// SPDX-License-Identifier: Apache-2.0
#include "src/files/plain_line.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace skein {
namespace {

bool IsControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

}  // namespace

bool IsOneLine(const std::string& text) {
  return std::none_of(text.begin(), text.end(), IsControl);
}

std::string PlainLine(const std::string& text) {
  using Json = nlohmann::json;
  auto line = Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace))
                  .get<std::string>();
  std::replace_if(line.begin(), line.end(), IsControl, ' ');
  return line;
}

}  // namespace skein
