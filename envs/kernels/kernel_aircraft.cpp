// SPDX-License-Identifier: Apache-2.0
#include "envs/kernels/kernel_aircraft.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "base/error.h"
#include "envs/air/atmosphere_constants.h"
#include "envs/aircraft/engine.h"
#include "envs/kernels/kernel_airframe.h"
#include "envs/kernels/kernel_tables.h"
#include "envs/kernels/plant_kernel.h"

namespace skein {
namespace {

/// Fills the density cells from the float64 model: cubics through four Chebyshev-Lobatto points, so
/// that neighbours meet. `tropopause_ft`, where the law of density may change, is an end of cells.
void FillDensity(AtmosphereModel model, double tropopause_ft, KernelAtmosphere* air) {
  constexpr double kLowFt = -5000;
  constexpr int kCellsBelowTropopause = 9;
  const double width = (tropopause_ft - kLowFt) / kCellsBelowTropopause;
  const double high = kLowFt + width * CellTable::kMaxCells;
  air->sea_level_density = static_cast<float>(AirAt(model, 0).density_slug_ft3);
  air->low_ft = static_cast<float>(kLowFt);
  air->high_ft = static_cast<float>(high);
  air->cells_per_ft = static_cast<float>(1 / width);
  air->offset = static_cast<float>(-kLowFt / width);
  for (int cell = 0; cell < CellTable::kMaxCells; ++cell) {
    const auto density = [&](double fraction) {
      return AirAt(model, kLowFt + width * (cell + fraction)).density_slug_ft3;
    };
    // The cubic a + b f + c f^2 + e f^3 through f = 0, 1/4, 3/4, 1.
    const double y0 = density(0), y1 = density(0.25), y2 = density(0.75), y3 = density(1);
    const double s1 = 4 * (y1 - y0), s2 = (4.0 / 3) * (y2 - y0), s3 = y3 - y0;
    const double t1 = 2 * (s2 - s1), t2 = (4.0 / 3) * (s3 - s1);
    const double e = 4 * (t2 - t1);
    const double c = t1 - e;
    const double b = s1 - c / 4 - e / 16;
    air->density.c[0][cell] = static_cast<float>(y0);
    air->density.c[1][cell] = static_cast<float>(b);
    air->density.c[2][cell] = static_cast<float>(c);
    air->density.c[3][cell] = static_cast<float>(e);
  }
}

KernelAtmosphere MakeAtmosphere(AtmosphereModel model) {
  KernelAtmosphere air;
  double tropopause_ft = 0;  // geometric
  if (model == AtmosphereModel::kStevensLewis) {
    const StevensLewisConstants& k = kStevensLewis;
    tropopause_ft = k.tropopause_ft;
    air.tropopause_ft = static_cast<float>(k.tropopause_ft);
    air.sea_level_temperature = static_cast<float>(k.sea_level_temperature_degR);
    air.lapse_per_ft = static_cast<float>(k.sea_level_temperature_degR * k.lapse_per_ft);
    air.stratosphere_temperature = static_cast<float>(k.stratosphere_temperature_degR);
    air.sound_constant = static_cast<float>(kSpecificHeatRatio * k.sound_gas_constant);
    air.pressure_constant = static_cast<float>(k.pressure_gas_constant);
  } else {
    const Standard1976Constants& k = kStandard1976;
    tropopause_ft = k.tropopause_ft * k.earth_radius_ft / (k.earth_radius_ft - k.tropopause_ft);
    air.inverse_earth_radius = static_cast<float>(1 / k.earth_radius_ft);
    air.tropopause_ft = static_cast<float>(k.tropopause_ft);
    air.sea_level_temperature = static_cast<float>(k.sea_level_temperature_degR);
    air.lapse_per_ft = static_cast<float>(-k.lapse_degR_per_ft);
    air.stratosphere_temperature =
        static_cast<float>(k.sea_level_temperature_degR + k.lapse_degR_per_ft * k.tropopause_ft);
    air.sound_constant = static_cast<float>(kSpecificHeatRatio * k.gas_constant);
    air.pressure_constant = static_cast<float>(k.gas_constant);
  }
  FillDensity(model, tropopause_ft, &air);
  return air;
}

KernelConstants MakeConstants(const Airframe& a, const Gravity& gravity) {
  KernelConstants k;
  k.inverse_aileron_reference = static_cast<float>(1 / a.aileron_reference_deg);
  k.inverse_rudder_reference = static_cast<float>(1 / a.rudder_reference_deg);
  k.inverse_flap_reference = static_cast<float>(1 / a.leading_edge_flap_reference_deg);
  k.half_span = static_cast<float>(a.span_ft / 2);
  k.half_chord = static_cast<float>(a.chord_ft / 2);
  const double cg_shift = a.cg_reference - a.cg;
  k.cg_shift = static_cast<float>(cg_shift);
  k.cg_shift_yaw = static_cast<float>(cg_shift * a.chord_ft / a.span_ft);
  k.chord_per_span = static_cast<float>(a.chord_ft / a.span_ft);
  k.half_wing_area = static_cast<float>(a.wing_area_ft2 / 2);
  k.inverse_mass = static_cast<float>(1 / a.mass_slug);
  k.inverse_weight = static_cast<float>(1 / (a.mass_slug * kGravityFtS2));
  k.gravity = static_cast<float>(gravity.at_sea_level_ft_s2);
  if (gravity.falls_with_altitude) {
    k.gravity_inverse_radius = static_cast<float>(1 / kStandard1976.earth_radius_ft);
  }

  const double determinant = a.Ixx * a.Izz - a.Ixz * a.Ixz;
  const double h = a.engine_angular_momentum;
  k.p_Cl = static_cast<float>(a.span_ft * a.Izz / determinant);
  k.p_Cn = static_cast<float>(a.span_ft * a.Ixz / determinant);
  k.p_qr = static_cast<float>(((a.Iyy - a.Izz) * a.Izz - a.Ixz * a.Ixz) / determinant);
  k.p_pq = static_cast<float>((a.Ixx - a.Iyy + a.Izz) * a.Ixz / determinant);
  k.p_q = static_cast<float>(a.Ixz * h / determinant);
  k.r_Cl = static_cast<float>(a.span_ft * a.Ixz / determinant);
  k.r_Cn = static_cast<float>(a.span_ft * a.Ixx / determinant);
  k.r_qr = static_cast<float>(-(a.Ixx - a.Iyy + a.Izz) * a.Ixz / determinant);
  k.r_pq = static_cast<float>(((a.Ixx - a.Iyy) * a.Ixx + a.Ixz * a.Ixz) / determinant);
  k.r_q = static_cast<float>(a.Ixx * h / determinant);
  k.q_Cm = static_cast<float>(a.chord_ft / a.Iyy);
  k.q_pr = static_cast<float>((a.Izz - a.Ixx) / a.Iyy);
  k.q_pp = static_cast<float>(a.Ixz / a.Iyy);
  k.q_r = static_cast<float>(-h / a.Iyy);
  k.p_q_per_momentum = static_cast<float>(a.Ixz / determinant);
  k.r_q_per_momentum = static_cast<float>(a.Ixx / determinant);
  k.q_r_per_momentum = static_cast<float>(-1 / a.Iyy);
  return k;
}

void RequireEngineTable(const std::vector<double>& table, const char* name, int rows, int columns) {
  if (table.size() != static_cast<std::size_t>(rows * columns)) {
    throw Error(std::string("engine table ") + name + " has " + std::to_string(table.size()) +
                " values; its axes ask for " + std::to_string(rows * columns));
  }
}

/// Bilinear coefficients by cell of a row-major table.
void FillBilinear(const std::vector<double>& table, int rows, int columns, KernelCells* cells) {
  for (int i = 0; i + 1 < rows; ++i) {
    for (int j = 0; j + 1 < columns; ++j) {
      const double* node = table.data() + i * columns + j;
      const double here = node[0], faster = node[1], higher = node[columns];
      const int cell = i * (columns - 1) + j;
      cells->c[0][cell] = static_cast<float>(here);
      cells->c[1][cell] = static_cast<float>(higher - here);
      cells->c[2][cell] = static_cast<float>(faster - here);
      cells->c[3][cell] = static_cast<float>(node[columns + 1] - higher - faster + here);
    }
  }
}

KernelEngine MakeEngine(const EngineTables& tables, const PowerLag& lag) {
  KernelEngine engine;
  const auto uniform = [](const std::vector<double>& nodes, const char* name) {
    const KernelAxis axis = MakeKernelAxis(nodes, name);
    if (axis.inner_more_cells_per_unit != 0) {
      throw Error(std::string("axis ") + name + " must have cells of one width");
    }
    return axis;
  };
  engine.altitude = uniform(tables.altitude_ft, "engine altitude_ft");
  engine.mach = uniform(tables.mach, "engine mach");
  const int rows = static_cast<int>(tables.altitude_ft.size());
  const int columns = static_cast<int>(tables.mach.size());
  if ((rows - 1) * (columns - 1) > CellTable::kMaxCells) {
    throw Error("engine tables have " + std::to_string((rows - 1) * (columns - 1)) +
                " cells of altitude and Mach number; the kernels hold " +
                std::to_string(CellTable::kMaxCells));
  }
  engine.mach_cells = static_cast<float>(columns - 1);
  RequireEngineTable(tables.idle_lbf, "idle", rows, columns);
  RequireEngineTable(tables.military_lbf, "military", rows, columns);
  RequireEngineTable(tables.maximum_lbf, "maximum", rows, columns);
  const auto fill = [&](KernelEngine::Segment segment, const std::vector<double>& low,
                        const std::vector<double>& high, double power) {
    std::vector<double> gain(low.size());
    for (std::size_t i = 0; i < low.size(); ++i) gain[i] = (high[i] - low[i]) / power;
    FillBilinear(low, rows, columns, &engine.low_lbf[segment]);
    FillBilinear(gain, rows, columns, &engine.gain_lbf[segment]);
  };
  fill(KernelEngine::kDry, tables.idle_lbf, tables.military_lbf, kMilitaryPower);
  fill(KernelEngine::kAfterburner, tables.military_lbf, tables.maximum_lbf,
       kMaximumPower - kMilitaryPower);
  engine.max_rate_per_s = static_cast<float>(lag.max_rate_per_s);
  engine.min_rate_per_s = static_cast<float>(lag.min_rate_per_s);
  engine.rate_offset_per_s = static_cast<float>(lag.rate_offset_per_s);
  engine.rate_slope_per_s = static_cast<float>(lag.rate_slope_per_s);
  engine.afterburner_power = static_cast<float>(lag.afterburner_power);
  engine.light_up_power = static_cast<float>(lag.light_up_power);
  engine.blow_out_power = static_cast<float>(lag.blow_out_power);
  engine.afterburner_rate_per_s = static_cast<float>(lag.afterburner_rate_per_s);
  return engine;
}

/// `nothing` is the value of a function that does not act.
KernelMachFunction MakeMachFunction(const MachFunction& function, bool acts, float nothing) {
  KernelMachFunction kernel;
  kernel.start = nothing;
  if (!acts) return kernel;
  const std::size_t ramps = function.mach.size() - 1;
  if (function.mach.size() < 2 || ramps > KernelMachFunction::kMaxRamps ||
      function.value.size() != function.mach.size()) {
    throw Error("a function of the Mach number has " + std::to_string(function.mach.size()) +
                " nodes; the kernels hold 2 to " +
                std::to_string(KernelMachFunction::kMaxRamps + 1));
  }
  kernel.start = static_cast<float>(function.value[0]);
  kernel.num_ramps = static_cast<int>(ramps);
  for (std::size_t k = 0; k < ramps; ++k) {
    const double from = function.mach[k], to = function.mach[k + 1];
    if (!(from < to)) throw Error("a function of the Mach number has nodes out of order");
    kernel.from[k] = static_cast<float>(from);
    kernel.to[k] = static_cast<float>(to);
    kernel.slope[k] = static_cast<float>((function.value[k + 1] - function.value[k]) / (to - from));
  }
  return kernel;
}

}  // namespace

KernelAxis MakeKernelAxis(const std::vector<double>& nodes, const char* name) {
  constexpr double kSameWidth = 1e-9;  // relative: widths are differences of decimal numbers
  const auto fail = [&](const std::string& reason) {
    throw Error(std::string("axis ") + name + " " + reason +
                "; the kernels need cells of one width inside and one width outside");
  };
  const int cells = static_cast<int>(nodes.size()) - 1;
  if (cells < 1) fail("has fewer than two nodes");
  const auto width = [&](int cell) { return nodes[cell + 1] - nodes[cell]; };
  const auto same = [&](double a, double b) { return std::abs(a - b) <= kSameWidth * a; };
  double inner_width = width(0);
  for (int cell = 0; cell < cells; ++cell) {
    if (!(width(cell) > 0)) fail("is not strictly increasing");
    inner_width = std::min(inner_width, width(cell));
  }
  int first = 0, last = cells;  // the inner cells are [first, last)
  while (!same(width(first), inner_width)) ++first;
  while (!same(width(last - 1), inner_width)) --last;
  const double outer_width = first > 0 ? width(0) : last < cells ? width(cells - 1) : inner_width;
  for (int cell = 0; cell < cells; ++cell) {
    const bool is_inner = first <= cell && cell < last;
    if (!same(width(cell), is_inner ? inner_width : outer_width)) {
      fail("has a cell of width " + std::to_string(width(cell)) + " at " +
           std::to_string(nodes[cell]));
    }
  }
  KernelAxis axis;
  axis.low = static_cast<float>(nodes.front());
  axis.high = static_cast<float>(nodes.back());
  axis.inner_low = static_cast<float>(nodes[first]);
  axis.inner_high = static_cast<float>(nodes[last]);
  axis.cells_per_unit = static_cast<float>(1 / outer_width);
  axis.inner_more_cells_per_unit = static_cast<float>(1 / inner_width - 1 / outer_width);
  axis.offset = static_cast<float>(first - nodes[first] / inner_width);
  axis.last_cell = cells - 1;
  // As CellAt finds them: float32 must tell the cells apart.
  const auto is_at = [&](float x, float inner, int cell) {
    constexpr float kMostOff = 0.01f;
    const float position =
        x * axis.cells_per_unit + (inner * axis.inner_more_cells_per_unit + axis.offset);
    return std::abs(position - static_cast<float>(cell)) <= kMostOff;
  };
  if (!is_at(axis.low, axis.inner_low, 0) || !is_at(axis.inner_low, axis.inner_low, first) ||
      !is_at(axis.high, axis.inner_high, cells)) {
    throw Error(std::string("axis ") + name + " has cells too small for float32");
  }
  return axis;
}

std::shared_ptr<const KernelAircraft> MakeKernelAircraft(const Aircraft& aircraft,
                                                         AtmosphereModel atmosphere,
                                                         const Gravity& gravity) {
  auto kernel = std::make_shared<KernelAircraft>();
  kernel->source = aircraft;
  kernel->atmosphere_model = atmosphere;
  kernel->atmosphere = MakeAtmosphere(atmosphere);
  kernel->constants = MakeConstants(aircraft.airframe, gravity);
  kernel->depends_on_mach = aircraft.drag_rises || aircraft.engine.grows;
  try {
    FillAerodynamics(aircraft.aerodynamics, kernel.get());
    kernel->engine = MakeEngine(aircraft.engine, aircraft.power_lag);
    kernel->drag_rise = MakeMachFunction(aircraft.drag_rise, aircraft.drag_rises, 0);
    kernel->thrust_growth = MakeMachFunction(aircraft.engine.growth, aircraft.engine.grows, 1);
  } catch (const Error& error) {
    throw Error("aircraft " + aircraft.name + ": " + error.what());
  }
  return kernel;
}

std::shared_ptr<const KernelAircraft> WithAirframe(std::shared_ptr<const KernelAircraft> aircraft,
                                                   const Airframe& airframe,
                                                   const Gravity& gravity) {
  const std::shared_ptr<const KernelAircraft> given = std::move(aircraft);
  // Made as one that may change, by the two functions of this file.
  auto kernel = given.use_count() == 1 ? std::const_pointer_cast<KernelAircraft>(given)
                                       : std::make_shared<KernelAircraft>(*given);
  kernel->source.airframe = airframe;
  kernel->constants = MakeConstants(airframe, gravity);
  return kernel;
}

}  // namespace skein
