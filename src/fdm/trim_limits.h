// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/reference/trim.h"

namespace skein {

/// The limits of the aircraft and of its model that a steady flight exceeds, in words: "needs more
/// thrust than the engine has (...)", "is above the engine's tables (...)". Empty if there are
/// none.
std::vector<std::string> ExceededLimits(const Plant& plant, const TrimRequest& request,
                                        const TrimPoint& trim);

/// "is below stall speed (...)" if the wing cannot carry the weight, turn included; else empty.
std::vector<std::string> BelowStall(const Plant& plant, const TrimRequest& request);

/// What keeps the aircraft from the steady flight that was asked for, as far as that can be told
/// without it: flight below stall speed, or outside the engine's tables. Empty otherwise.
std::vector<std::string> LimitsOnTheWay(const Plant& plant, const TrimRequest& request);

/// Trims; an Error of it says what limit may be its cause, too.
TrimPoint TrimOrExplain(const Plant& plant, const TrimRequest& request);

}  // namespace skein
