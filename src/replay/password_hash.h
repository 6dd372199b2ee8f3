// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace skein {

/// What a client of Tacview's real-time telemetry may send for a password, lower-case hexadecimal
/// without leading zeros: CRC-64/WE, CRC-64/ECMA-182 and, as older ones do, CRC-32, of the text in
/// UTF-16, little-endian. "0" for no password. They keep out who connects by mistake: none of them
/// is a secret's hash. Throws Error if `password` is not UTF-8.
std::vector<std::string> TelemetryPasswordHashes(const std::string& password);

}  // namespace skein
