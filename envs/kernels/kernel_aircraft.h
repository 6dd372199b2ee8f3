// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"
#include "envs/air/atmosphere.h"
#include "envs/aircraft/aircraft.h"

namespace skein {

/// An axis on which the cell of a value is arithmetic instead of a search: its cells have one width
/// in the middle and one outside. cell + fraction = offset + cells_per_unit (x limited to [low,
/// high]) + inner_more_cells_per_unit (x limited to [inner_low, inner_high]).
struct KernelAxis {
  float low = 0, high = 0;
  float inner_low = 0, inner_high = 0;
  float cells_per_unit = 0, inner_more_cells_per_unit = 0;
  float offset = 0;
  std::int32_t last_cell = 0;
};

/// Throws Error if `nodes` (strictly increasing, at least two) are not of that form, or have cells
/// that float32 cannot tell apart.
KernelAxis MakeKernelAxis(const std::vector<double>& nodes, const char* name);

/// A bilinear patch: a function in one cell of the alpha x beta grid, as what it is at the cell's
/// first corner and what it gains along alpha, along beta and along both, by the fractions a and b
/// of the cell: kCorner + a kAlongAlpha + b (kAlongBeta + a kAlongBoth).
enum PatchTerm : int { kCorner, kAlongAlpha, kAlongBeta, kAlongBoth, kNumPatchTerms };

/// Functions of alpha and beta come in sets of four, and what makes them up in lines of their
/// patches: slot = term * kPatchesPerLine + place in the set.
inline constexpr int kPatchesPerLine = 4;
struct PatchLine {
  static constexpr int kNumSlots = kNumPatchTerms * kPatchesPerLine;
  float slot[kNumSlots] = {};
};

/// The lateral coefficients, and Cm's increment by the flap, which the elevator does not scale.
enum LateralPatch : int { kPatchCy, kPatchCn, kPatchCl, kPatchCmFlap };
/// The longitudinal coefficients; kPatchCm is what the elevator's effect on Cm scales.
enum LongitudinalPatch : int { kPatchCx, kPatchCz, kPatchCm, kNumLongitudinalPatches };

/// A cell's lines: increments by what the surfaces' positions multiply them with...
enum SurfaceLine : int {
  kLateralFlap,  ///< by how far the flap is up
  kLateralAileron,
  kLateralAileronFlap,  ///< by the product
  kLateralRudder,
  kLongitudinalFlap,
  kNumSurfaceLines
};
/// ... and, for each elevator interval, the functions at its lower end and what they gain over it.
enum ElevatorLine : int {
  kLateralBase,
  kLateralElevator,
  kLongitudinalBase,
  kLongitudinalElevator,
  kNumElevatorLines
};

/// A function of one axis by cell: value at the cell's start and gain over the cell. Small enough
/// to be looked up in registers.
struct alignas(64) CellTable {
  static constexpr int kMaxCells = 32;
  float value[kMaxCells] = {};
  float step[kMaxCells] = {};
};

/// Four coefficients by cell.
struct alignas(64) KernelCells {
  float c[4][CellTable::kMaxCells] = {};
};

/// Functions of alpha.
enum AlphaFunction : int {
  kAlphaCxq,
  kAlphaCzq,
  kAlphaCmq,
  kAlphaCyp,
  kAlphaCyr,
  kAlphaCnp,
  kAlphaCnr,
  kAlphaClp,
  kAlphaClr,
  kNumDampings,  ///< those above depend on the flap, too
  kAlphaCm = kNumDampings,
  kNumAlphaFunctions
};

/// An atmosphere model by altitude: density as a cubic in each cell, temperature linear up to the
/// tropopause and constant above.
struct KernelAtmosphere {
  /// Density, slug/ft^3, in cell i at fraction f: c[0] + c[1] f + c[2] f^2 + c[3] f^3.
  KernelCells density;
  float sea_level_density = 0;    ///< slug/ft^3
  float low_ft = 0, high_ft = 0;  ///< ends of the cells; density is constant beyond
  float cells_per_ft = 0, offset = 0;
  float inverse_earth_radius = 0;  ///< 1/ft; 0 where altitude is taken as geopotential
  float tropopause_ft = 0;
  float sea_level_temperature = 0, lapse_per_ft = 0, stratosphere_temperature = 0;  ///< degR
  float sound_constant = 0;     ///< sound speed^2 / temperature, ft^2 / (s^2 degR)
  float pressure_constant = 0;  ///< pressure / (density temperature), ft lbf / (slug degR)
};

/// Thrust as low + (power - start) gain, in one of two segments of power (dry: from idle to
/// military; afterburner: to maximum), each of `low` and `gain` bilinear in altitude and Mach
/// number by cell: c[0] + c[1] a + c[2] m + c[3] a m with the fractions a and m of the cell; and
/// the lag of power.
struct KernelEngine {
  enum Segment : int { kDry, kAfterburner, kNumSegments };
  KernelAxis altitude, mach;
  float mach_cells = 0;  ///< cell number = altitude cell * mach_cells + Mach cell
  KernelCells low_lbf[kNumSegments];
  KernelCells gain_lbf[kNumSegments];  ///< per unit of power
  /// As PowerLag.
  float max_rate_per_s = 0, min_rate_per_s = 0;
  float rate_offset_per_s = 0, rate_slope_per_s = 0;
  float afterburner_power = 0, light_up_power = 0, blow_out_power = 0, afterburner_rate_per_s = 0;
};

/// A MachFunction as its first value and ramps: start + sum of slope (Mach number limited to
/// [from, to] - from). Without ramps it is `start` everywhere.
struct KernelMachFunction {
  static constexpr int kMaxRamps = 4;
  float start = 0;
  int num_ramps = 0;
  float from[kMaxRamps] = {}, to[kMaxRamps] = {}, slope[kMaxRamps] = {};
};

/// Constants of the coefficients' build-up and of the equations of motion, folded for float32.
struct KernelConstants {
  float inverse_aileron_reference = 0, inverse_rudder_reference = 0, inverse_flap_reference = 0;
  float half_span = 0, half_chord = 0;  ///< ft
  float cg_shift = 0;                   ///< (reference cg - cg) in chords: Cm gains Cz times this
  float cg_shift_yaw = 0;               ///< cg_shift chord / span: Cn loses Cy times this
  float chord_per_span = 0;
  float half_wing_area = 0;  ///< ft^2
  float inverse_mass = 0, inverse_weight = 0;
  float gravity = 0;                 ///< at sea level, ft/s^2
  float gravity_inverse_radius = 0;  ///< 1/ft; 0: it is the same at every altitude
  /// p' = qS (p_Cl Cl + p_Cn Cn) + p_qr q r + p_pq p q + p_q q, and likewise r'.
  float p_Cl = 0, p_Cn = 0, p_qr = 0, p_pq = 0, p_q = 0;
  float r_Cl = 0, r_Cn = 0, r_qr = 0, r_pq = 0, r_q = 0;
  /// q' = qS q_Cm Cm + q_pr p r - q_pp (p^2 - r^2) + q_r r.
  float q_Cm = 0, q_pr = 0, q_pp = 0, q_r = 0;
  /// p_q, r_q and q_r per unit of the engine's angular momentum, ft^-2 slug^-1.
  float p_q_per_momentum = 0, r_q_per_momentum = 0, q_r_per_momentum = 0;
};

/// An aircraft arranged for the SIMD kernels; see plant_kernel.h. Tables lie on one alpha x beta
/// grid: the flap tables are held at their last increments beyond their range, the coarse elevator
/// axis is refined to the fine one, base tables are taken off at the nodes and the products of
/// sideslip with dCn_beta, dCl_beta are folded into Cn and Cl: all exact for (multi)linear
/// interpolation.
struct KernelAircraft {
  Aircraft source;
  AtmosphereModel atmosphere_model = AtmosphereModel::kStevensLewis;

  KernelAxis alpha, beta, elevator;
  /// Sideslip is limited as a tangent, before the arctangent.
  float tan_beta_low = 0, tan_beta_high = 0;
  /// The slots of lines of patches by cell, beta by beta; a cell has the lines of SurfaceLine, then
  /// those of ElevatorLine for each elevator interval.
  AlignedVector<float> slots;
  float slots_per_cell = 0, slots_per_beta = 0;  ///< from cell to cell, and from beta to beta
  CellTable alpha_functions[kNumAlphaFunctions];
  CellTable flap_dampings[kNumDampings];  ///< increments by how far the flap is up
  CellTable elevator_effect;              ///< factor of Cm by elevator

  KernelEngine engine;
  KernelAtmosphere atmosphere;
  KernelConstants constants;

  /// Whether what follows acts: the coefficient of axial force gained and the factor of thrust.
  bool depends_on_mach = false;
  KernelMachFunction drag_rise, thrust_growth;
};

}  // namespace skein
