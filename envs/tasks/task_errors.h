// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

/// Task errors at the head of every observation.
inline constexpr int kNumTaskErrors = 3;

}  // namespace skein
