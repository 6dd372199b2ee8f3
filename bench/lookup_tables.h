// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "envs/kernels/kernel_aircraft.h"

namespace skein::bench {

/// The functions of alpha and beta alone, at nodes: the side force without deflections, then
/// increments by what multiplies them.
enum PlaneFunction : int {
  kPlaneCy,
  kPlaneFlapCy,
  kPlaneFlapCn,
  kPlaneFlapCl,
  kPlaneFlapCm,
  kPlaneAileronCy,
  kPlaneAileronCn,
  kPlaneAileronCl,
  kPlaneAileronFlapCy,
  kPlaneAileronFlapCn,
  kPlaneAileronFlapCl,
  kPlaneRudderCy,
  kPlaneRudderCn,
  kPlaneRudderCl,
  kPlaneFlapCx,
  kPlaneFlapCz,
  kNumPlaneFunctions
};

/// The functions of alpha, beta and elevator.
enum ElevatorFunction : int {
  kElevatorCn,
  kElevatorCl,
  kElevatorCx,
  kElevatorCz,
  kElevatorCm,
  kNumElevatorFunctions
};

/// Sixteen numbers of one node.
struct alignas(64) NodeLine {
  float slot[16] = {};
};
static_assert(kNumPlaneFunctions == 16, "a node's plane functions fill its line");

/// The aerodynamic tables of a KernelAircraft by node of the alpha x beta grid, node = beta *
/// alpha_nodes + alpha: arrangements that the plant kernel does without.
struct LookupTables {
  int alpha_nodes = 0, beta_nodes = 0, elevator_nodes = 0;

  /// One array for each function, for gathers: [function][node].
  std::vector<float> plane;
  /// [function][elevator node][node].
  std::vector<float> elevator;

  /// One line for each node, [node], by PlaneFunction.
  std::vector<NodeLine> plane_lines;
  /// [node][elevator interval]: functions at the interval's start, by ElevatorFunction, then from
  /// kElevatorGain on what they gain over it.
  static constexpr int kElevatorGain = 8;
  std::vector<NodeLine> elevator_lines;

  int nodes() const { return alpha_nodes * beta_nodes; }
};

LookupTables MakeLookupTables(const KernelAircraft& aircraft);

}  // namespace skein::bench
