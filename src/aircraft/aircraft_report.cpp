// SPDX-License-Identifier: Apache-2.0
#include "src/aircraft/aircraft_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/nearest_name.h"
#include "envs/aircraft/aircraft_document.h"
#include "envs/aircraft/derivative_aircraft_file.h"
#include "envs/aircraft/engine.h"
#include "envs/aircraft/registry.h"
#include "envs/aircraft/units.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/reference/linear_flight.h"
#include "envs/state/state.h"
#include "envs/tuning/linear_modes.h"
#include "src/files/text_table.h"

namespace skein {
namespace {

constexpr std::size_t kLabelWidth = 20, kCellWidth = 11;
constexpr AtmosphereModel kAtmosphere = AtmosphereModel::kStandard1976;

double Speed(const TrimPoint& trim) { return trim.state.segment<3>(kU).norm() * kMetresPerFoot; }

EnvelopeLimits LimitsOfEnvelope(const FlightLimits& limits, const Aircraft& aircraft) {
  EnvelopeLimits envelope;
  envelope.max_speed_ft_s = limits.max_speed_m_s * kFeetPerMetre;
  envelope.max_altitude_ft =
      std::min(limits.max_altitude_m * kFeetPerMetre, aircraft.engine.altitude_ft.back());
  return envelope;
}

/// Of an aircraft whose file says none: what its flight control is made for, and one g more.
FlightLimits LimitsOfGains(const FlightControlGains& gains) {
  FlightLimits limits;
  limits.max_load_factor_g = gains.max_load_factor_command + 2;
  limits.min_load_factor_g = gains.min_load_factor_command.y_high;
  return limits;
}

CheckedAircraft Checked(const AircraftDocument& document, const Aircraft& aircraft,
                        const FlightLimits& limits) {
  return {document,
          Plant(aircraft, kAtmosphere),
          {limits.max_load_factor_g, limits.min_load_factor_g, LimitsOfEnvelope(limits, aircraft)},
          true,
          {}};
}

AircraftDocument DocumentOf(const std::string& aircraft) {
  if (IsAircraftPath(aircraft)) return ReadAircraftDocumentFile(aircraft);
  for (const AircraftFile& file : AircraftFiles()) {
    if (aircraft == file.name) {
      return ReadAircraftDocument(aircraft, *file.text, "aircraft " + aircraft);
    }
  }
  LoadAircraft(aircraft);  // says which names are known
  throw Error("aircraft " + aircraft + " has no file to check");
}

void Row(const std::string& label, const std::vector<std::string>& cells, std::string* text) {
  TextTable table(kLabelWidth, kCellWidth, text);
  table.Begin(label);
  for (const std::string& cell : cells) table.Cell(cell);
  table.End();
}

std::string Number(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

std::string ModeText(std::complex<double> mode) {
  return mode.imag() == 0 ? fmt::format("{:.2f}", mode.real())
                          : fmt::format("{:.2f}{:+.2f}i", mode.real(), mode.imag());
}

/// The best rate of climb at full throttle from any of the trims, ft/min; the weight's share of
/// the excess thrust.
double BestClimb(const Plant& plant, const EnvelopeRow& row) {
  const Aircraft& aircraft = plant.aircraft();
  double best = 0;
  for (const TrimPoint& trim : row.trims) {
    const double speed = trim.state.segment<3>(kU).norm();
    const double mach = speed / AirAt(kAtmosphere, row.altitude_ft).sound_speed_ft_s;
    const double excess =
        Thrust(aircraft.engine, kMaximumPower, row.altitude_ft, mach) - trim.controls.thrust_lbf;
    best = std::max(best, 60 * speed * excess / (aircraft.airframe.mass_slug * kGravityFtS2));
  }
  return best;
}

std::string DescribeEnvelope(const Plant& plant, const FlightEnvelope& envelope) {
  std::string text = fmt::format(
      "level flight: speeds in m/s, best climb in ft/min; greatest lift {:.2f} at alpha {} deg\n",
      envelope.greatest_lift.coefficient, envelope.greatest_lift.alpha_deg);
  Row("altitude, ft", {"stall", "slowest", "fastest", "climb"}, &text);
  for (const EnvelopeRow& row : envelope.rows) {
    std::vector<std::string> cells = {fmt::format("{:.1f}", row.stall_speed_ft_s * kMetresPerFoot)};
    if (!row.trims.empty()) {
      cells.push_back(fmt::format("{:.1f}", Speed(row.trims.front())));
      cells.push_back(fmt::format("{:.1f}", Speed(row.trims.back())));
      cells.push_back(fmt::format("{:.0f}", BestClimb(plant, row)));
    }
    Row(fmt::format("{:.0f}", row.altitude_ft), cells, &text);
  }
  return text;
}

std::string DescribeModes(const Plant& plant, const FlightEnvelope& envelope) {
  std::string text = "\nmodes without flight control, 1/s, at the ground\n";
  constexpr std::size_t kModeWidth = 15;
  const auto row = [&](const std::string& label, const std::vector<std::string>& cells) {
    TextTable table(kLabelWidth, kModeWidth, &text);
    table.Begin(label);
    for (const std::string& cell : cells) table.Cell(cell);
    table.End();
  };
  row("speed, m/s", {"short period", "phugoid", "roll", "Dutch roll", "spiral"});
  for (const TrimPoint& trim : envelope.rows.front().trims) {
    std::vector<std::string> cells(5);
    for (const FlightMode& mode :
         FindFlightModes(LineariseFlight(plant, trim, FlapMotion::kFixed))) {
      std::string& cell = cells[static_cast<std::size_t>(mode.family)];
      cell += (cell.empty() ? "" : ", ") + ModeText(mode.eigenvalue);
    }
    row(fmt::format("{:.1f}", Speed(trim)), cells);
  }
  return text;
}

/// That the presets that are to serve it are of an aircraft that has some.
std::vector<Finding> CheckPresets(const AircraftDocument& document) {
  const std::vector<std::string> known = AircraftNames();
  const std::string& name = document.presets_of;
  if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return {};
  return {{Finding::kError, fmt::format("presets_of: unknown aircraft {}{}; known: {}", name,
                                        DidYouMean(name, known), fmt::join(known, ", "))}};
}

/// That the float32 kernels, by which all flies but `skein fdm` in double precision, take its
/// tables.
std::vector<Finding> CheckKernels(const Aircraft& aircraft) {
  try {
    MakeKernelAircraft(aircraft, AtmosphereModel::kStevensLewis);
  } catch (const Error& error) {
    return {{Finding::kError, error.what()}};
  }
  return {};
}

}  // namespace

CheckedAircraft LoadForCheck(const std::string& aircraft) {
  const AircraftDocument document = DocumentOf(aircraft);
  if (document.model == "tables") {
    const Aircraft tables = MakeAircraft(document);
    CheckedAircraft checked = Checked(document, tables, LimitsOfGains(tables.flight_control));
    checked.findings = CheckAirframe(tables.airframe);
    return checked;
  }
  const DerivativeAircraft model =
      ReadDerivativeAircraft(document.name, document.text, FlightControlSection::kOptional);
  CheckedAircraft checked = Checked(document, MakeAircraft(model), model.limits);
  checked.has_flight_control = model.has_flight_control;
  checked.findings = CheckDerivatives(model);
  return checked;
}

FlightEnvelope ReportEnvelope(const Plant& plant, const TuningLimits& limits) {
  constexpr int kAltitudes = 3, kSpeeds = 4;
  return FindEnvelope(plant, limits.envelope, kAltitudes, kSpeeds);
}

std::string DescribeHandling(const Plant& plant, const TuningLimits& limits,
                             const FlightEnvelope& envelope, std::vector<Finding>* findings) {
  std::string text =
      "\nwith flight control: least damping of pitch, of roll and yaw; slow modes' seconds to\n"
      "double; a pitch step's rise, s, and overshoot, %; deg/s of full roll; most sideslip and\n"
      "alpha, deg; g\n";
  constexpr std::size_t kWide = 22, kNarrow = 8;
  const auto row = [&](const std::string& label, const std::vector<std::string>& cells) {
    TextTable table(kWide, kNarrow, &text);
    table.Begin(label);
    for (const std::string& cell : cells) table.Cell(cell);
    table.End();
  };
  row("altitude, speed",
      {"pitch", "lat", "double", "rise", "over", "roll", "beta", "alpha", "min g", "max g"});
  for (const TrimPoint& trim : envelope.AllTrims()) {
    const Handling h = AssessHandling(plant, trim);
    row(fmt::format("{:.0f} ft, {:.1f} m/s", -trim.state[kDown], Speed(trim)),
        {Number(h.pitch_damping, 2), Number(h.lateral_damping, 2), Number(h.time_to_double_s, 0),
         Number(h.pitch_rise_s, 1), Number(100 * h.pitch_overshoot, 0),
         Number(h.roll_rate_deg_s, 0), Number(h.max_sideslip_deg, 1), Number(h.max_alpha_deg, 1),
         Number(h.min_load_factor_g, 1), Number(h.max_load_factor_g, 1)});
    for (Finding& finding : CheckHandling(limits, envelope.greatest_lift.alpha_deg, trim, h)) {
      findings->push_back(std::move(finding));
    }
  }
  return text;
}

AircraftReport CheckAircraft(const CheckedAircraft& aircraft) {
  AircraftReport report;
  const auto append = [&](std::vector<Finding> more) {
    report.findings.insert(report.findings.end(), more.begin(), more.end());
  };
  append(CheckPresets(aircraft.document));
  append(CheckKernels(aircraft.plant.aircraft()));
  const FlightEnvelope envelope = ReportEnvelope(aircraft.plant, aircraft.limits);
  append(CheckEnvelope(aircraft.plant, aircraft.limits, envelope));
  const bool is_of_derivatives = aircraft.document.model == "derivatives";
  append(
      CheckDrag(aircraft.plant, envelope, is_of_derivatives ? " (longitudinal.CD_elevator?)" : ""));
  append(CheckModes(aircraft.plant, envelope));
  report.figures =
      DescribeEnvelope(aircraft.plant, envelope) + DescribeModes(aircraft.plant, envelope);
  if (aircraft.has_flight_control) {
    report.figures += DescribeHandling(aircraft.plant, aircraft.limits, envelope, &report.findings);
  } else {
    append({{Finding::kError,
             "there is no section flight_control; `skein aircraft tune` derives one"}});
  }
  return report;
}

}  // namespace skein
