// Second phase of the plant kernel: the coefficients on the alpha x beta grid. Each aircraft's
// lines are loaded whole and blended with vectors across coefficients; transpositions then bring
// vectors across aircraft back.

#if defined(SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_TABLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_TABLES_INL_H_
#undef SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_TABLES_INL_H_
#else
#define SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_TABLES_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <utility>

#include "envs/dynamics/plant_kernel_block-inl.h"
#include "simd/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace plant_kernel {

/// The `slot`th and following coefficients of one aircraft at its alpha and beta.
HWY_INLINE V BlendLines(const NodeLine* line, std::size_t lines_per_beta, int slot, float alpha,
                        float beta) {
  const FloatTag d;
  const V a = Constant(alpha);
  const NodeLine* next = line + lines_per_beta;
  const V low =
      hn::MulAdd(a, hn::Load(d, line->alpha_step + slot), hn::Load(d, line->value + slot));
  const V high =
      hn::MulAdd(a, hn::Load(d, next->alpha_step + slot), hn::Load(d, next->value + slot));
  return hn::MulAdd(Constant(beta), hn::Sub(high, low), low);
}

/// One row per aircraft, unrolled so that the rows stay in registers.
template <std::size_t... kAircraft>
HWY_INLINE void BlendRows(const KernelAircraft& aircraft, const Block& block,
                          const std::int32_t* line, int slot, int lane, V* rows,
                          std::index_sequence<kAircraft...>) {
  const NodeLine* lines = aircraft.lines.data();
  const std::size_t lines_per_beta = static_cast<std::size_t>(aircraft.lines_per_beta);
  ((rows[kAircraft] =
        BlendLines(lines + line[lane + kAircraft], lines_per_beta, slot,
                   block.alpha_fraction[lane + kAircraft], block.beta_fraction[lane + kAircraft])),
   ...);
}

/// Slots `slot` to `slot + kLanes` of the lines at `line`, for the aircraft in lanes `lane` to
/// `lane + kLanes`; stores those below kNumSlots.
template <int kNumSlots>
HWY_INLINE void ReadSlots(const KernelAircraft& aircraft, const Block& block,
                          const std::int32_t* line, int slot, int lane,
                          float (*coefficients)[kBlock]) {
  const FloatTag d;
  V rows[kLanes];
  BlendRows(aircraft, block, line, slot, lane, rows, std::make_index_sequence<kLanes>());
  Transpose(d, rows);
  for (int j = 0; j < kLanes && slot + j < kNumSlots; ++j) {
    hn::Store(rows[j], d, coefficients[slot + j] + lane);
  }
}

/// For the aircraft in lanes `lane` to `lane + kLanes` of `block`.
HWY_INLINE void ReadTables(const KernelAircraft& aircraft, int lane, Block* block) {
  for (int slot = 0; slot < kNumPlaneSlots; slot += kLanes) {
    ReadSlots<kNumPlaneSlots>(aircraft, *block, block->plane_line, slot, lane, block->plane);
  }
  for (int slot = 0; slot < kNumElevatorSlots; slot += kLanes) {
    ReadSlots<kNumElevatorSlots>(aircraft, *block, block->elevator_line, slot, lane,
                                 block->by_elevator);
  }
}

}  // namespace plant_kernel
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_TABLES_INL_H_
