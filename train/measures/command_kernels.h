// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "envs/actions.h"

namespace skein {

/// Numbers by command: throttle, pitch, roll, yaw.
using CommandNumbers = std::array<double, kActionSize>;

/// Stick actions in consecutive control steps. What measures them clips them to [-1, 1].
struct ActionRows {
  const float* values = nullptr;  ///< row-major [count][kActionSize], not clipped
  std::size_t count = 0;
};

/// What commands have done until now.
struct CommandHistory {
  CommandNumbers last;             ///< the latest commands
  CommandNumbers lowest, highest;  ///< since each took its direction
  CommandNumbers direction{};      ///< 1 up, -1 down, 0 until it has moved by the dead band
  CommandNumbers variation{};      ///< sum of |changes|
  CommandNumbers reversals{};      ///< how often it turned back by more than the dead band
  CommandNumbers saturated{};      ///< how often it was at a stop, -1 or 1
};

/// Of commands that begin with the first of `rows`, which is not empty: it counts as the latest,
/// but not as flown.
CommandHistory HistoryBefore(const ActionRows& rows);

/// Goes on with `history` over `rows`. A command turns back when it has come by more than
/// `dead_band` from the farthest that it had come.
void Follow(const ActionRows& rows, double dead_band, CommandHistory* history);

/// Writes commands less their means, row-major [count][kActionSize], and returns the sums of their
/// squares.
CommandNumbers Centre(const ActionRows& rows, double* centred);

/// By command, the sum of |X(k)|^2 over k = 1 to `last` of the discrete Fourier transform of
/// `centred`, row-major [count][kActionSize], by Goertzel's recurrence (American Mathematical
/// Monthly 65, 1958).
CommandNumbers SquaresUpTo(std::size_t last, const double* centred, std::size_t count);

}  // namespace skein
