// What the phases of the plant kernel share: the scratch memory of one block of aircraft and the
// state at one stage of the integration.

#if defined(SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_BLOCK_INL_H_
#undef SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_BLOCK_INL_H_
#else
#define SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_BLOCK_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "envs/dynamics/kernel_aircraft.h"
#include "envs/dynamics/state.h"
#include "simd/lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace plant_kernel {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::RebindToSigned<FloatTag>;
using V = hn::Vec<FloatTag>;
using VI = hn::Vec<IntTag>;

inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(FloatTag()));
/// Aircraft that go through each phase together: the loads of one half's tables overlap with the
/// arithmetic of the other's.
inline constexpr int kBlock = 32;
/// Integrated columns: the rigid body and the engine's power, kPower.
inline constexpr int kNumIntegrated = kPower + 1;

HWY_INLINE V Constant(float value) { return hn::Set(FloatTag(), value); }

/// What one phase leaves for the next, for each aircraft of a block.
struct alignas(64) Block {
  /// Cells and fractions of the table axes; lines of the tables.
  float alpha_fraction[kBlock], beta_fraction[kBlock], elevator_fraction[kBlock];
  std::int32_t alpha_cell[kBlock], elevator_cell[kBlock];
  std::int32_t plane_line[kBlock], elevator_line[kBlock];
  float speed_squared[kBlock];  // ft^2/s^2
  float mach[kBlock];
  float inverse_speed[kBlock];  // s/ft
  float force[kBlock];          // dynamic pressure times wing area, lbf
  float thrust[kBlock];         // lbf
  float plane[kNumPlaneSlots][kBlock];
  float by_elevator[kNumElevatorSlots][kBlock];
  float coefficients[6][kBlock];  // Cx, Cy, Cz, Cl, Cm, Cn
  float rates[4][kNumIntegrated][kBlock];
};

/// Columns of a block's controls, at its first aircraft. `thrust_lbf` where thrust is given, power
/// command where the engine makes it.
struct BlockControls {
  const float* thrust_lbf;
  const float* power_command;
  const float* elevator_deg;
  const float* aileron_deg;
  const float* rudder_deg;
  const float* leading_edge_flap_deg;
};

/// The state at one stage: that at the start of the step plus `step` times the previous stage's
/// rates, recomputed wherever it is read (cheaper than storing it).
template <bool kFirst>
struct StageState {
  const float* base;
  std::size_t stride;
  const float (*previous_rates)[kBlock];
  float step;

  HWY_INLINE V Get(int column, int lane) const {
    const FloatTag d;
    const V start = hn::LoadU(d, base + static_cast<std::size_t>(column) * stride + lane);
    if constexpr (kFirst) {
      return start;
    } else {
      return hn::MulAdd(Constant(step), hn::Load(d, previous_rates[column] + lane), start);
    }
  }
};

struct Cell {
  VI index;
  V start;     // index as float
  V fraction;  // in [0, 1] for finite values
};

/// Always a cell of the axis, also for NaN: tables are never read outside.
HWY_INLINE Cell FindCell(const KernelAxis& axis, V x) {
  const FloatTag d;
  const IntTag di;
  const V whole = hn::Min(hn::Max(x, Constant(axis.low)), Constant(axis.high));
  const V inner = hn::Min(hn::Max(x, Constant(axis.inner_low)), Constant(axis.inner_high));
  const V position = hn::MulAdd(
      whole, Constant(axis.cells_per_unit),
      hn::MulAdd(inner, Constant(axis.inner_more_cells_per_unit), Constant(axis.offset)));
  Cell cell;
  cell.index =
      hn::Min(hn::Max(TruncateToInt(d, position), hn::Zero(di)), hn::Set(di, axis.last_cell));
  cell.start = hn::ConvertTo(d, cell.index);
  cell.fraction = hn::Sub(position, cell.start);
  return cell;
}

}  // namespace plant_kernel
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_BLOCK_INL_H_
