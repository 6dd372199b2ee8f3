#pragma once

#include <cstdint>
#include <vector>

#include "envs/air/atmosphere.h"
#include "envs/aircraft/aircraft.h"

namespace skein {

/// An axis on which the cell of a value is arithmetic instead of a search: its cells have one width
/// in the middle and one outside. cell + fraction = offset + cells_per_unit (x limited to [low,
/// high])
/// + inner_more_cells_per_unit (x limited to [inner_low, inner_high]).
struct KernelAxis {
  float low = 0, high = 0;
  float inner_low = 0, inner_high = 0;
  float cells_per_unit = 0, inner_more_cells_per_unit = 0;
  float offset = 0;
  std::int32_t last_cell = 0;
};

/// Throws Error if `nodes` (strictly increasing, at least two) are not of that form.
KernelAxis MakeKernelAxis(const std::vector<double>& nodes, const char* name);

/// Sixteen coefficients at one node of the alpha x beta grid, and what each gains towards the next
/// alpha.
struct alignas(64) NodeLine {
  float value[16] = {};
  float alpha_step[16] = {};
};

/// Slots of a node's first line: what does not depend on the elevator. Base side force; increments
/// by full leading-edge flap (up), aileron, aileron with flap up, rudder.
enum PlaneSlot : int {
  kPlaneCy,
  kPlaneCyFlap,
  kPlaneCyAileron,
  kPlaneCyAileronFlap,
  kPlaneCyRudder,
  kPlaneCxFlap,
  kPlaneCzFlap,
  kPlaneCmFlap,
  kPlaneCnFlap,
  kPlaneCnAileron,
  kPlaneCnAileronFlap,
  kPlaneCnRudder,
  kPlaneClFlap,
  kPlaneClAileron,
  kPlaneClAileronFlap,
  kPlaneClRudder,
  kNumPlaneSlots
};

/// Slots of a node's further lines, one line per elevator interval: the coefficient at the
/// interval's lower end and its gain over the interval. The order leaves two groups of four out of
/// the 16 x 16 transposition's last stages.
enum ElevatorSlot : int {
  kElevatorCx,
  kElevatorCz,
  kElevatorCm,
  kElevatorCn,
  kElevatorCl,
  kElevatorClStep,
  kElevatorCxStep = 8,
  kElevatorCzStep,
  kElevatorCmStep,
  kElevatorCnStep,
  kNumElevatorSlots
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

/// Functions of alpha. `Flap` ones are multiplied by how far the flap is up.
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
  kAlphaCxqFlap,
  kAlphaCzqFlap,
  kAlphaCmqFlap,
  kAlphaCypFlap,
  kAlphaCyrFlap,
  kAlphaCnpFlap,
  kAlphaCnrFlap,
  kAlphaClpFlap,
  kAlphaClrFlap,
  kAlphaCm,
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

/// Thrust of the three power levels, each bilinear in altitude and Mach number by cell:
/// c[0] + c[1] a + c[2] m + c[3] a m with the fractions a and m of the cell.
struct KernelEngine {
  enum Level : int { kIdle, kMilitary, kMaximum, kNumLevels };
  KernelAxis altitude, mach;
  float mach_cells = 0;  ///< cell number = altitude cell * mach_cells + Mach cell
  KernelCells thrust_lbf[kNumLevels];
};

/// Constants of the coefficients' build-up and of the equations of motion, folded for float32.
struct KernelConstants {
  float inverse_aileron_reference = 0, inverse_rudder_reference = 0, inverse_flap_reference = 0;
  float half_span = 0, half_chord = 0;  ///< ft
  float cg_shift = 0;                   ///< (reference cg - cg) in chords: Cm gains Cz times this
  float cg_shift_yaw = 0;               ///< cg_shift chord / span: Cn loses Cy times this
  float half_wing_area = 0;             ///< ft^2
  float inverse_mass = 0, inverse_weight = 0;
  float gravity = 0;
  /// p' = qS (p_Cl Cl + p_Cn Cn) + p_qr q r + p_pq p q + p_q q, and likewise r'.
  float p_Cl = 0, p_Cn = 0, p_qr = 0, p_pq = 0, p_q = 0;
  float r_Cl = 0, r_Cn = 0, r_qr = 0, r_pq = 0, r_q = 0;
  /// q' = qS q_Cm Cm + q_pr p r - q_pp (p^2 - r^2) + q_r r.
  float q_Cm = 0, q_pr = 0, q_pp = 0, q_r = 0;
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
  /// Line of node (alpha i, beta j): (j num_alpha + i) lines_per_node; elevator interval k: + 1 +
  /// k.
  float lines_per_node = 0, lines_per_beta = 0;
  std::vector<NodeLine> lines;
  CellTable alpha_functions[kNumAlphaFunctions];
  CellTable elevator_effect;  ///< factor of Cm by elevator

  KernelEngine engine;
  KernelAtmosphere atmosphere;
  KernelConstants constants;
};

}  // namespace skein
