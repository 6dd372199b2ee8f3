// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

/// Whether this build has the address or the thread sanitizer in it: it is many times slower, and
/// has calls of its own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

}  // namespace skein
