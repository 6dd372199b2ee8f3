// SPDX-License-Identifier: Apache-2.0
#include "bench/lookup_layouts.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <utility>

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/lookup_layouts.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/kernels/plant_kernel_block-inl.h"
#include "envs/kernels/plant_kernel_motion-inl.h"
#include "envs/kernels/plant_kernel_tables-inl.h"
#include "simd/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

using namespace plant_kernel;  // NOLINT: as in plant_kernel.cpp
using namespace bench;         // NOLINT: this file's own names

HWY_INLINE V Get(const Tile& places, int column, int lane) {
  return hn::LoadU(FloatTag(), places[column] + lane);
}

/// Keeps the compiler from doing once what stands in a loop over stages.
HWY_INLINE void NewStage() { benchmark::ClobberMemory(); }

using Readings = V[kNumReadingColumns];

HWY_INLINE void Store(const Readings& sums, const Tile& readings, int lane) {
  for (int k = 0; k < kNumReadingColumns; ++k) {
    hn::StoreU(sums[k], FloatTag(), readings[k] + lane);
  }
}

/// The plant kernel's own reading.
template <bool kEveryStage>
void ReadPatchLines(const KernelAircraft& aircraft, Tile places, Tile readings) {
  const FloatTag d;
  const IntTag di;
  Block block;
  const auto read = [&](int first, int lane) HWY_ATTR {
    const int at = first + lane;
    const V slot =
        hn::MulAdd(Get(places, kPlaceBetaCell, at), Constant(aircraft.slots_per_beta),
                   hn::Mul(Get(places, kPlaceAlphaCell, at), Constant(aircraft.slots_per_cell)));
    hn::Store(TruncateToInt(d, slot), di, block.cell_slot + lane);
    ReadPatches<kLateral>(aircraft, lane, &block);
    ReadPatches<kLongitudinal>(aircraft, lane, &block);
  };
  for (int first = 0; first < places.count; first += kBlock) {
    for (int lane = 0; lane < kBlock; lane += kLanes) {
      const int at = first + lane;
      const V flap_up = Get(places, kPlaceFlapUp, at), aileron = Get(places, kPlaceAileron, at);
      hn::Store(flap_up, d, block.flap_up + lane);
      hn::Store(aileron, d, block.aileron + lane);
      hn::Store(hn::Mul(aileron, flap_up), d, block.aileron_flap + lane);
      hn::Store(Get(places, kPlaceRudder, at), d, block.rudder + lane);
      hn::Store(Get(places, kPlaceElevatorFraction, at), d, block.elevator_fraction + lane);
      const V slot = hn::MulAdd(Get(places, kPlaceElevatorCell, at),
                                Constant(kNumElevatorLines * PatchLine::kNumSlots),
                                Constant(kNumSurfaceLines * PatchLine::kNumSlots));
      hn::Store(TruncateToInt(d, slot), di, block.elevator_slot + lane);
      if (!kEveryStage) read(first, lane);
    }
    for (int lane = 0; lane < kBlock; lane += kLanes) {
      const int at = first + lane;
      Readings sums;
      for (V& sum : sums) sum = hn::Zero(d);
      for (int stage = 0; stage < kStages; ++stage) {
        NewStage();
        if (kEveryStage) read(first, lane);
        const CoefficientReader c{block, lane, Get(places, kPlaceAlphaFraction + stage, at),
                                  Get(places, kPlaceBetaFraction + stage, at)};
        sums[kReadCy] = hn::Add(sums[kReadCy], c.Patch<kLateral>(kPatchCy));
        sums[kReadCn] = hn::Add(sums[kReadCn], c.Patch<kLateral>(kPatchCn));
        sums[kReadCl] = hn::Add(sums[kReadCl], c.Patch<kLateral>(kPatchCl));
        sums[kReadCmFlap] = hn::Add(sums[kReadCmFlap], c.Patch<kLateral>(kPatchCmFlap));
        sums[kReadCx] = hn::Add(sums[kReadCx], c.Patch<kLongitudinal>(kPatchCx));
        sums[kReadCz] = hn::Add(sums[kReadCz], c.Patch<kLongitudinal>(kPatchCz));
        sums[kReadCm] = hn::Add(sums[kReadCm], c.Patch<kLongitudinal>(kPatchCm));
      }
      Store(sums, readings, at);
    }
  }
}

/// What the surfaces' positions multiply.
struct Surfaces {
  HWY_INLINE Surfaces(const Tile& places, int at)
      : elevator_fraction(Get(places, kPlaceElevatorFraction, at)),
        flap_up(Get(places, kPlaceFlapUp, at)),
        aileron(Get(places, kPlaceAileron, at)),
        aileron_flap(hn::Mul(aileron, flap_up)),
        rudder(Get(places, kPlaceRudder, at)) {}

  /// Adds the functions of one stage to the sums; `plane` and `elevator` by PlaneFunction and
  /// ElevatorFunction.
  HWY_INLINE void AddUp(const V* plane, const V* elevator, Readings& sums) const {
    const auto lateral = [&](V base, PlaneFunction flap, PlaneFunction by_aileron,
                             PlaneFunction by_both, PlaneFunction by_rudder) HWY_ATTR {
      V sum = hn::MulAdd(flap_up, plane[flap], base);
      sum = hn::MulAdd(aileron, plane[by_aileron], sum);
      sum = hn::MulAdd(aileron_flap, plane[by_both], sum);
      return hn::MulAdd(rudder, plane[by_rudder], sum);
    };
    const V Cy = lateral(plane[kPlaneCy], kPlaneFlapCy, kPlaneAileronCy, kPlaneAileronFlapCy,
                         kPlaneRudderCy);
    const V Cn = lateral(elevator[kElevatorCn], kPlaneFlapCn, kPlaneAileronCn, kPlaneAileronFlapCn,
                         kPlaneRudderCn);
    const V Cl = lateral(elevator[kElevatorCl], kPlaneFlapCl, kPlaneAileronCl, kPlaneAileronFlapCl,
                         kPlaneRudderCl);
    sums[kReadCy] = hn::Add(sums[kReadCy], Cy);
    sums[kReadCn] = hn::Add(sums[kReadCn], Cn);
    sums[kReadCl] = hn::Add(sums[kReadCl], Cl);
    sums[kReadCmFlap] = hn::MulAdd(flap_up, plane[kPlaneFlapCm], sums[kReadCmFlap]);
    sums[kReadCx] =
        hn::Add(sums[kReadCx], hn::MulAdd(flap_up, plane[kPlaneFlapCx], elevator[kElevatorCx]));
    sums[kReadCz] =
        hn::Add(sums[kReadCz], hn::MulAdd(flap_up, plane[kPlaneFlapCz], elevator[kElevatorCz]));
    sums[kReadCm] = hn::Add(sums[kReadCm], elevator[kElevatorCm]);
  }

  V elevator_fraction, flap_up, aileron, aileron_flap, rudder;
};

HWY_INLINE V Between(V low, V high, V fraction) {
  return hn::MulAdd(fraction, hn::Sub(high, low), low);
}

/// Slots `slot` to `slot + kLanes` of the lines at a cell's four nodes, blended. Lines of
/// neighbouring alphas are `along_alpha` apart, of betas `along_beta`.
HWY_INLINE V BlendLines(const NodeLine* corner, int along_alpha, int along_beta, V alpha_fraction,
                        V beta_fraction, int slot) {
  const FloatTag d;
  const auto line = [&](int offset) HWY_ATTR { return hn::Load(d, corner[offset].slot + slot); };
  return Between(Between(line(0), line(along_alpha), alpha_fraction),
                 Between(line(along_beta), line(along_beta + along_alpha), alpha_fraction),
                 beta_fraction);
}

/// Sixteen functions of kLanes aircraft, blended line by line. `spacing` lines lie between nodes.
struct NodeBlend {
  const Tile& places;
  const LookupTables& tables;
  int stage, at;

  HWY_INLINE V Row(const NodeLine* lines, int spacing, std::int32_t line, int i, int slot) const {
    return BlendLines(lines + line, spacing, spacing * tables.alpha_nodes,
                      Constant(places[kPlaceAlphaFraction + stage][at + i]),
                      Constant(places[kPlaceBetaFraction + stage][at + i]), slot);
  }

  template <std::size_t... kAircraft>
  HWY_INLINE void Rows(const NodeLine* lines, int spacing, const std::int32_t* line, int slot,
                       V* rows, std::index_sequence<kAircraft...> /*aircraft*/) const {
    ((rows[kAircraft] = Row(lines, spacing, line[kAircraft], static_cast<int>(kAircraft), slot)),
     ...);
  }

  /// functions[s] gets slot s of all aircraft.
  HWY_INLINE void Functions(const NodeLine* lines, int spacing, const std::int32_t* line,
                            V (&functions)[16]) const {
    for (int slot = 0; slot < 16; slot += kLanes) {
      Rows(lines, spacing, line, slot, functions + slot, std::make_index_sequence<kLanes>());
      Transpose(FloatTag(), functions + slot);
    }
  }
};

void ReadNodeLines(const LookupTables& tables, Tile places, Tile readings) {
  const FloatTag d;
  const IntTag di;
  const int intervals = tables.elevator_nodes - 1;
  for (int at = 0; at < places.count; at += kLanes) {
    const Surfaces surfaces(places, at);
    const V node = hn::MulAdd(Get(places, kPlaceBetaCell, at),
                              Constant(static_cast<float>(tables.alpha_nodes)),
                              Get(places, kPlaceAlphaCell, at));
    const V elevator_line = hn::MulAdd(node, Constant(static_cast<float>(intervals)),
                                       Get(places, kPlaceElevatorCell, at));
    alignas(64) std::int32_t plane_lines[kLanes], elevator_lines[kLanes];
    hn::Store(TruncateToInt(d, node), di, plane_lines);
    hn::Store(TruncateToInt(d, elevator_line), di, elevator_lines);
    Readings sums;
    for (V& sum : sums) sum = hn::Zero(d);
    for (int stage = 0; stage < kStages; ++stage) {
      NewStage();
      const NodeBlend blend{places, tables, stage, at};
      V plane[16], elevator[16];
      blend.Functions(tables.plane_lines.data(), 1, plane_lines, plane);
      blend.Functions(tables.elevator_lines.data(), intervals, elevator_lines, elevator);
      for (int f = 0; f < kNumElevatorFunctions; ++f) {
        elevator[f] = hn::MulAdd(surfaces.elevator_fraction,
                                 elevator[LookupTables::kElevatorGain + f], elevator[f]);
      }
      surfaces.AddUp(plane, elevator, sums);
    }
    Store(sums, readings, at);
  }
}

void ReadGathers(const LookupTables& tables, Tile places, Tile readings) {
  const FloatTag d;
  const int along_beta = tables.alpha_nodes, nodes = tables.nodes();
  for (int at = 0; at < places.count; at += kLanes) {
    const Surfaces surfaces(places, at);
    const V node_number =
        hn::MulAdd(Get(places, kPlaceBetaCell, at), Constant(static_cast<float>(along_beta)),
                   Get(places, kPlaceAlphaCell, at));
    const VI node = TruncateToInt(d, node_number);
    const VI elevator_node =
        TruncateToInt(d, hn::MulAdd(Get(places, kPlaceElevatorCell, at),
                                    Constant(static_cast<float>(nodes)), node_number));
    Readings sums;
    for (V& sum : sums) sum = hn::Zero(d);
    for (int stage = 0; stage < kStages; ++stage) {
      NewStage();
      const V alpha = Get(places, kPlaceAlphaFraction + stage, at);
      const V beta = Get(places, kPlaceBetaFraction + stage, at);
      const auto corners = [&](const float* table, VI index) HWY_ATTR {
        const auto at_node = [&](int offset)
                                 HWY_ATTR { return hn::GatherIndex(d, table + offset, index); };
        return Between(Between(at_node(0), at_node(1), alpha),
                       Between(at_node(along_beta), at_node(along_beta + 1), alpha), beta);
      };
      V plane[kNumPlaneFunctions], elevator[kNumElevatorFunctions];
      for (int f = 0; f < kNumPlaneFunctions; ++f) {
        plane[f] = corners(tables.plane.data() + f * nodes, node);
      }
      for (int f = 0; f < kNumElevatorFunctions; ++f) {
        const float* const table = tables.elevator.data() + f * tables.elevator_nodes * nodes;
        elevator[f] = Between(corners(table, elevator_node), corners(table + nodes, elevator_node),
                              surfaces.elevator_fraction);
      }
      surfaces.AddUp(plane, elevator, sums);
    }
    Store(sums, readings, at);
  }
}

void ReadByLayoutKernel(LookupLayout layout, const KernelAircraft& aircraft,
                        const LookupTables& tables, Tile places, Tile readings) {
  switch (layout) {
    case LookupLayout::kPatchesOnceAStep:
      ReadPatchLines<false>(aircraft, places, readings);
      break;
    case LookupLayout::kPatchesEveryStage:
      ReadPatchLines<true>(aircraft, places, readings);
      break;
    case LookupLayout::kNodeLines:
      ReadNodeLines(tables, places, readings);
      break;
    case LookupLayout::kGathers:
      ReadGathers(tables, places, readings);
      break;
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(ReadByLayoutKernel);

void bench::ReadByLayout(LookupLayout layout, const KernelAircraft& aircraft,
                         const LookupTables& tables, Tile places, Tile readings) {
  SKEIN_DISPATCH(ReadByLayoutKernel)(layout, aircraft, tables, places, readings);
}

bench::Cost bench::CostOf(LookupLayout layout) {
  constexpr double kFloat = sizeof(float), kLine = sizeof(NodeLine);
  constexpr double kSums = 7, kFractions = 2 * kFloat;
  // Patches: lines added up for 16 slots of two sets; seven bilinear functions of four terms.
  constexpr Cost kAddUp{16 * (5 + 2) * 2, 9 * kLine + 11 * kFloat};
  constexpr Cost kEvaluate{7 * 6 + kSums, 28 * kFloat + kFractions};
  // Nodes: three interpolations of three operations for a function of two variables, seven for one
  // of three; then the increments by the surfaces.
  constexpr double kPlane = 9, kIncrements = 3 * 8 + 3 * 2 + kSums - 1;
  switch (layout) {
    case LookupLayout::kPatchesOnceAStep:
      return {kAddUp.flops + kStages * kEvaluate.flops,
              kAddUp.bytes_loaded + kStages * kEvaluate.bytes_loaded};
    case LookupLayout::kPatchesEveryStage:
      return {kStages * (kAddUp.flops + kEvaluate.flops),
              kStages * (kAddUp.bytes_loaded + kEvaluate.bytes_loaded)};
    case LookupLayout::kNodeLines:
      return {kStages * ((16 + 10) * kPlane + 5 * 2 + kIncrements),
              kStages * (2 * (4 * kLine + kFloat + kFractions))};
    case LookupLayout::kGathers:
      break;
  }
  return {kStages * (16 * kPlane + 5 * (2 * kPlane + 3) + kIncrements),
          kStages * ((16 * 4 + 5 * 8) * kFloat + kFractions)};
}

}  // namespace skein
#endif
