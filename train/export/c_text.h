// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace skein {

/// A float32 as a C constant that is read back as the same: "0.25f".
std::string CNumber(float value);

/// "static const float NAME[N] = {...};" over as many lines as it takes.
std::string CArray(const std::string& name, const std::vector<float>& values);

/// `text` with every "@KEY@" replaced by the value of KEY. Throws Error on a key without a value.
std::string FillIn(std::string_view text, const std::map<std::string, std::string>& values);

/// `text` in capitals.
std::string UpperCase(std::string text);

/// `text` as lines of a C comment's body, each behind " * ": nothing in it ends the comment.
std::string CommentLines(const std::string& text);

}  // namespace skein
