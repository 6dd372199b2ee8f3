// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace skein {

/// Whether `text` ends in `end`, which may be all of it, or nothing.
inline bool EndsWith(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

}  // namespace skein
