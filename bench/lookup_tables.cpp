// SPDX-License-Identifier: Apache-2.0
#include "bench/lookup_tables.h"

#include <algorithm>
#include <cstddef>

namespace skein::bench {
namespace {

struct PlaneSource {
  SurfaceLine line;
  int place;  // in the line's set
};

// PlaneFunction from kPlaneFlapCy on: kPlaneCy comes with the elevator's functions.
constexpr PlaneSource kPlaneSources[] = {
    {kLateralFlap, kPatchCy},        {kLateralFlap, kPatchCn},
    {kLateralFlap, kPatchCl},        {kLateralFlap, kPatchCmFlap},
    {kLateralAileron, kPatchCy},     {kLateralAileron, kPatchCn},
    {kLateralAileron, kPatchCl},     {kLateralAileronFlap, kPatchCy},
    {kLateralAileronFlap, kPatchCn}, {kLateralAileronFlap, kPatchCl},
    {kLateralRudder, kPatchCy},      {kLateralRudder, kPatchCn},
    {kLateralRudder, kPatchCl},      {kLongitudinalFlap, kPatchCx},
    {kLongitudinalFlap, kPatchCz},
};
static_assert(sizeof kPlaneSources / sizeof kPlaneSources[0] == kNumPlaneFunctions - 1, "");

struct ElevatorSource {
  ElevatorLine line, gain;
  int place;
};

constexpr ElevatorSource kElevatorSources[kNumElevatorFunctions] = {
    {kLateralBase, kLateralElevator, kPatchCn},
    {kLateralBase, kLateralElevator, kPatchCl},
    {kLongitudinalBase, kLongitudinalElevator, kPatchCx},
    {kLongitudinalBase, kLongitudinalElevator, kPatchCz},
    {kLongitudinalBase, kLongitudinalElevator, kPatchCm},
};

/// Reads functions at nodes from the patches of a cell that has the node as a corner.
class NodeReader {
 public:
  explicit NodeReader(const KernelAircraft& aircraft)
      : aircraft_(aircraft),
        lines_per_cell_(kNumSurfaceLines + kNumElevatorLines * (aircraft.elevator.last_cell + 1)) {}

  float Surface(int alpha, int beta, PlaneSource source) const {
    return At(alpha, beta, source.line, source.place);
  }
  float Elevator(int alpha, int beta, int interval, ElevatorLine line, int place) const {
    return At(alpha, beta, kNumSurfaceLines + interval * kNumElevatorLines + line, place);
  }

 private:
  float At(int alpha, int beta, int line, int place) const {
    const int i = std::min(alpha, static_cast<int>(aircraft_.alpha.last_cell));
    const int j = std::min(beta, static_cast<int>(aircraft_.beta.last_cell));
    const int cell = j * (aircraft_.alpha.last_cell + 1) + i;
    const float* slot =
        aircraft_.lines[static_cast<std::size_t>(cell * lines_per_cell_ + line)].slot;
    const auto term = [&](PatchTerm which) { return slot[which * kPatchesPerLine + place]; };
    float value = term(kCorner);
    if (alpha > i) value += term(kAlongAlpha);
    if (beta > j) value += term(kAlongBeta);
    if (alpha > i && beta > j) value += term(kAlongBoth);
    return value;
  }

  const KernelAircraft& aircraft_;
  int lines_per_cell_;
};

}  // namespace

LookupTables MakeLookupTables(const KernelAircraft& aircraft) {
  const NodeReader read(aircraft);
  LookupTables tables;
  tables.alpha_nodes = aircraft.alpha.last_cell + 2;
  tables.beta_nodes = aircraft.beta.last_cell + 2;
  tables.elevator_nodes = aircraft.elevator.last_cell + 2;
  const int nodes = tables.nodes(), intervals = tables.elevator_nodes - 1;
  const auto size = static_cast<std::size_t>(nodes);
  tables.plane.resize(size * kNumPlaneFunctions);
  tables.elevator.resize(size * kNumElevatorFunctions *
                         static_cast<std::size_t>(tables.elevator_nodes));
  tables.plane_lines.resize(size);
  tables.elevator_lines.resize(size * static_cast<std::size_t>(intervals));
  for (int j = 0; j < tables.beta_nodes; ++j) {
    for (int i = 0; i < tables.alpha_nodes; ++i) {
      const int node = j * tables.alpha_nodes + i;
      for (int f = 0; f < kNumPlaneFunctions; ++f) {
        const float value = f == kPlaneCy ? read.Elevator(i, j, 0, kLateralBase, kPatchCy)
                                          : read.Surface(i, j, kPlaneSources[f - 1]);
        tables.plane[static_cast<std::size_t>(f * nodes + node)] = value;
        tables.plane_lines[static_cast<std::size_t>(node)].slot[f] = value;
      }
      for (int f = 0; f < kNumElevatorFunctions; ++f) {
        const ElevatorSource& source = kElevatorSources[f];
        for (int k = 0; k < intervals; ++k) {
          const float start = read.Elevator(i, j, k, source.line, source.place);
          const float gain = read.Elevator(i, j, k, source.gain, source.place);
          float* const line =
              tables.elevator_lines[static_cast<std::size_t>(node * intervals + k)].slot;
          line[f] = start;
          line[LookupTables::kElevatorGain + f] = gain;
          float* const column =
              tables.elevator.data() + (f * tables.elevator_nodes + k) * nodes + node;
          column[0] = start;
          if (k + 1 == intervals) column[nodes] = start + gain;
        }
      }
    }
  }
  return tables;
}

}  // namespace skein::bench
