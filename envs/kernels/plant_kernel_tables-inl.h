// SPDX-License-Identifier: Apache-2.0
// The plant kernel's reading of the aerodynamic tables. Each aircraft's lines are loaded whole and
// added up with vectors across functions; transpositions then bring vectors across aircraft back.

#if defined(SKEIN_ENVS_KERNELS_PLANT_KERNEL_TABLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_KERNELS_PLANT_KERNEL_TABLES_INL_H_
#undef SKEIN_ENVS_KERNELS_PLANT_KERNEL_TABLES_INL_H_
#else
#define SKEIN_ENVS_KERNELS_PLANT_KERNEL_TABLES_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <utility>

#include "envs/kernels/plant_kernel_block-inl.h"
#include "simd/transpose-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace plant_kernel {

/// What the surfaces' positions mean to the tables, and gravity unless it falls with altitude; held
/// during a step.
template <class Plant>
HWY_INLINE void LocateSurfaces(const KernelAircraft& aircraft, const BlockControls& controls,
                               const Plant& plant, int lane, KernelBlock* block) {
  const FloatTag d;
  const IntTag di;
  const KernelConstants& k = aircraft.constants;
  const auto read = [&](const float* column) HWY_ATTR { return hn::LoadU(d, column + lane); };
  const V flap_up = hn::NegMulAdd(read(controls.leading_edge_flap_deg),
                                  Constant(k.inverse_flap_reference), Constant(1.0f));
  const V aileron =
      plant.Scaled(kPlantAileron, lane,
                   hn::Mul(read(controls.aileron_deg), Constant(k.inverse_aileron_reference)));
  const V rudder = plant.Scaled(
      kPlantRudder, lane, hn::Mul(read(controls.rudder_deg), Constant(k.inverse_rudder_reference)));
  hn::Store(flap_up, d, block->flap_up + lane);
  hn::Store(aileron, d, block->aileron + lane);
  hn::Store(hn::Mul(aileron, flap_up), d, block->aileron_flap + lane);
  hn::Store(rudder, d, block->rudder + lane);

  const Cell elevator =
      Locate(aircraft.elevator, plant.Scaled(kPlantElevator, lane, read(controls.elevator_deg)));
  const CellTable& effect = aircraft.elevator_effect;
  hn::Store(elevator.fraction, d, block->elevator_fraction + lane);
  hn::Store(hn::MulAdd(elevator.fraction, Lookup32(d, effect.step, elevator.index),
                       Lookup32(d, effect.value, elevator.index)),
            d, block->elevator_effect + lane);
  const V slot = hn::MulAdd(elevator.start, Constant(kNumElevatorLines * PatchLine::kNumSlots),
                            Constant(kNumSurfaceLines * PatchLine::kNumSlots));
  hn::Store(TruncateToInt(d, slot), di, block->elevator_slot + lane);
  hn::Store(Constant(k.gravity), d, block->gravity + lane);
}

/// Slots `slot` to `slot + kLanes` of the set's patches for one aircraft of the block.
template <PatchSet kSet>
HWY_INLINE V AddUpSlots(const KernelAircraft& aircraft, const KernelBlock& block, int i, int slot) {
  const FloatTag d;
  const float* surfaces = aircraft.slots.data() + block.cell_slot[i] + slot;
  const float* elevator = surfaces + block.elevator_slot[i];
  const auto line = [&](const float* lines, int which)
                        HWY_ATTR { return hn::Load(d, lines + which * PatchLine::kNumSlots); };
  const V fraction = Constant(block.elevator_fraction[i]), flap_up = Constant(block.flap_up[i]);
  if constexpr (kSet == kLongitudinal) {
    V sum = line(elevator, kLongitudinalBase);
    sum = hn::MulAdd(fraction, line(elevator, kLongitudinalElevator), sum);
    return hn::MulAdd(flap_up, line(surfaces, kLongitudinalFlap), sum);
  } else {
    V sum = line(elevator, kLateralBase);
    sum = hn::MulAdd(fraction, line(elevator, kLateralElevator), sum);
    sum = hn::MulAdd(flap_up, line(surfaces, kLateralFlap), sum);
    sum = hn::MulAdd(Constant(block.aileron[i]), line(surfaces, kLateralAileron), sum);
    sum = hn::MulAdd(Constant(block.aileron_flap[i]), line(surfaces, kLateralAileronFlap), sum);
    return hn::MulAdd(Constant(block.rudder[i]), line(surfaces, kLateralRudder), sum);
  }
}

/// One row per aircraft, unrolled so that the rows stay in registers.
template <PatchSet kSet, std::size_t... kAircraft>
HWY_INLINE void AddUpRows(const KernelAircraft& aircraft, const KernelBlock& block, int lane,
                          int slot, V* rows, std::index_sequence<kAircraft...> /*aircraft*/) {
  ((rows[kAircraft] = AddUpSlots<kSet>(aircraft, block, lane + static_cast<int>(kAircraft), slot)),
   ...);
}

/// The set's patches of the aircraft in lanes `lane` to `lane + kLanes`.
template <PatchSet kSet>
HWY_INLINE void ReadPatches(const KernelAircraft& aircraft, int lane, KernelBlock* block) {
  const FloatTag d;
  for (int slot = 0; slot < PatchLine::kNumSlots; slot += kLanes) {
    V rows[kLanes];
    AddUpRows<kSet>(aircraft, *block, lane, slot, rows, std::make_index_sequence<kLanes>());
    Transpose(d, rows);
    for (int j = 0; j < kLanes; ++j) {
      if (kSet == kLongitudinal && (slot + j) % kPatchesPerLine >= kNumLongitudinalPatches)
        continue;
      hn::Store(rows[j], d, block->patch[kSet][slot + j] + lane);
    }
  }
}

/// The same for one aircraft.
template <PatchSet kSet>
HWY_INLINE void ReadPatchesOf(const KernelAircraft& aircraft, int i, KernelBlock* block) {
  alignas(64) float slots[PatchLine::kNumSlots];
  for (int slot = 0; slot < PatchLine::kNumSlots; slot += kLanes) {
    hn::Store(AddUpSlots<kSet>(aircraft, *block, i, slot), FloatTag(), slots + slot);
  }
  for (int slot = 0; slot < PatchLine::kNumSlots; ++slot) block->patch[kSet][slot][i] = slots[slot];
}

/// The functions of alpha, at the flap's position, in vectors of aircraft.
HWY_INLINE void ReadAlphaFunctions(const KernelAircraft& aircraft, VI alpha_cell, int lane,
                                   KernelBlock* block) {
  const FloatTag d;
  const V flap_up = hn::Load(d, block->flap_up + lane);
  for (int k = 0; k < kNumAlphaFunctions; ++k) {
    const CellTable& function = aircraft.alpha_functions[k];
    V value = Lookup32(d, function.value, alpha_cell);
    V step = Lookup32(d, function.step, alpha_cell);
    if (k < kNumDampings) {
      const CellTable& flap = aircraft.flap_dampings[k];
      value = hn::MulAdd(flap_up, Lookup32(d, flap.value, alpha_cell), value);
      step = hn::MulAdd(flap_up, Lookup32(d, flap.step, alpha_cell), step);
    }
    hn::Store(value, d, block->alpha_value[k] + lane);
    hn::Store(step, d, block->alpha_step[k] + lane);
  }
}

/// Reads the tables of those aircraft in lanes `lane` to `lane + kLanes` that changed their cell.
inline HWY_NOINLINE void ReadChangedTables(const KernelAircraft& aircraft, VI cell_slot,
                                           VI alpha_cell, int lane, KernelBlock* block) {
  const IntTag di;
  alignas(64) std::int32_t found[kLanes];
  hn::Store(cell_slot, di, found);
  for (int j = 0; j < kLanes; ++j) {
    const int i = lane + j;
    if (found[j] == block->cell_slot[i]) continue;
    block->cell_slot[i] = found[j];
    ReadPatchesOf<kLateral>(aircraft, i, block);
    ReadPatchesOf<kLongitudinal>(aircraft, i, block);
  }
  if (!hn::AllTrue(di, hn::Eq(alpha_cell, hn::Load(di, block->alpha_cell + lane)))) {
    hn::Store(alpha_cell, di, block->alpha_cell + lane);
    ReadAlphaFunctions(aircraft, alpha_cell, lane, block);
  }
}

/// Reads the tables of all aircraft of the block in the cells that MeasureFlowAngles has found, at
/// the surfaces' positions that LocateSurfaces has.
HWY_INLINE void ReadTables(const KernelAircraft& aircraft, KernelBlock* block) {
  for (int lane = 0; lane < kLanesPerBlock; lane += kLanes) {
    ReadPatches<kLateral>(aircraft, lane, block);
    ReadPatches<kLongitudinal>(aircraft, lane, block);
    ReadAlphaFunctions(aircraft, hn::Load(IntTag(), block->alpha_cell + lane), lane, block);
  }
}

}  // namespace plant_kernel
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_KERNELS_PLANT_KERNEL_TABLES_INL_H_
