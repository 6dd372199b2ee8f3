// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "src/plot/picture.h"

namespace skein {

/// Throws UsageError if the name ends neither in .svg nor in .pdf, and Error if no PDF can be
/// written.
void CheckPictureFile(const std::string& path);

/// Writes the picture as its name's ending says. Text that is not UTF-8 or cannot be drawn is
/// replaced. Throws Error if it cannot be written.
void WritePicture(const std::string& path, Picture picture);

}  // namespace skein
