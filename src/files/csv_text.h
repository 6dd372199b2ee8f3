// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein {

/// A cell of CSV, in quotes where it must be.
std::string CsvText(const std::string& text);

}  // namespace skein
