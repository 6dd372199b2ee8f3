// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "envs/reference/closed_loop.h"
#include "envs/tuning/linear_modes.h"

namespace skein {

/// The axis of a closed loop, which decouples from the other in level flight.
enum class LoopAxis { kLongitudinal, kLateral };

/// One control step of a closed loop about a trim, linear: x' = A x + B stick. x has those entries
/// of the loop's memory that belong to the axis, without position and heading.
struct ClosedLoopModel {
  Eigen::MatrixXd A;
  /// Columns: the pitch stick, or the roll stick and the pedals.
  Eigen::MatrixXd B;
  std::vector<int> columns;  ///< of the memory (ClosedLoopMemory), in the order of x
  double dt = 0;             ///< control interval, s

  /// What the loop's memory has in `column`, after every step of 1 in stick `input`.
  std::vector<double> StepResponse(int input, int column, double seconds) const;
  /// log(eigenvalues) / dt, 1/s, of those that are neither zero (delays) nor one (neutral).
  std::vector<std::complex<double>> Modes() const;
  /// The same of each pair once, the slowest first, with what they are made of.
  std::vector<LinearMode> ModesWithShares() const;
};

/// By central differences. `delayed` holds surface commands back by one step. Throws nothing; kinks
/// of limiters at the trim give the mean of both sides' slopes.
ClosedLoopModel LineariseClosedLoop(const Plant& plant, const TrimPoint& trim, LoopAxis axis,
                                    double dt, bool delayed);

}  // namespace skein
