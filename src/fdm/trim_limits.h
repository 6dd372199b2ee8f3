// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/reference/trim.h"

namespace skein {

/// What keeps an aircraft or its model from a steady flight; what comes first explains the rest.
enum class FlightLimit {
  kStall,         ///< the wing cannot carry the weight
  kControls,      ///< no balance within the range of the surfaces
  kAlphaTables,   ///< alpha outside the aerodynamic tables
  kThrust,        ///< needs more thrust than the engine has
  kIdle,          ///< needs less than it gives when idle
  kEngineTables,  ///< altitude or Mach number outside the engine's tables
};

/// A limit that a flight exceeds.
struct ExceededLimit {
  FlightLimit limit;
  std::string words;  ///< "needs more thrust than the engine has (...)"
};

std::vector<std::string> WordsOf(const std::vector<ExceededLimit>& limits);

/// The limits of the aircraft and of its model that a steady flight exceeds. Empty if there are
/// none.
std::vector<ExceededLimit> ExceededLimits(const Plant& plant, const TrimRequest& request,
                                          const TrimPoint& trim);

/// "is below stall speed (...)" if the wing cannot carry the weight, turn and pull-up included;
/// else empty.
std::vector<ExceededLimit> BelowStall(const Plant& plant, const TrimRequest& request);

/// What keeps the aircraft from the steady flight that was asked for, as far as that can be told
/// without it: flight below stall speed, or outside the engine's tables. Empty otherwise.
std::vector<ExceededLimit> LimitsOnTheWay(const Plant& plant, const TrimRequest& request);

/// Trims. Throws ChoiceError if there is no such flight, which says first what limit may be why.
TrimPoint TrimOrExplain(const Plant& plant, const TrimRequest& request);

}  // namespace skein
