// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "src/plot/picture.h"

namespace skein {

/// The picture as an SVG file: text stays text, places are in tenths of points.
std::string SvgFile(const Picture& picture);

}  // namespace skein
