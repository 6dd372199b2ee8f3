// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein {

/// A zip archive of one file, deflated, without a time of day, so that equal contents are equal
/// archives (PKWARE's APPNOTE 6.3.10, sections 4.3.7, 4.3.12 and 4.3.16). Throws Error if it would
/// be larger than the format's 4 GiB or there is no memory.
std::string ZipArchive(const std::string& name, const std::string& content);

}  // namespace skein
