// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

/// SI units of the unit of the flight dynamics, for data that come in SI. Exact but for rounding.
inline constexpr double kMetresPerFoot = 0.3048;
inline constexpr double kFeetPerMetre = 1 / kMetresPerFoot;
inline constexpr double kNewtonsPerLbf = 4.4482216152605;
inline constexpr double kKgPerSlug = kNewtonsPerLbf / kMetresPerFoot;
inline constexpr double kKgM2PerSlugFt2 = kKgPerSlug * kMetresPerFoot * kMetresPerFoot;
inline constexpr double kKgM3PerSlugFt3 =
    kKgPerSlug / (kMetresPerFoot * kMetresPerFoot * kMetresPerFoot);

}  // namespace skein
