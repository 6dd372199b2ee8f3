// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/flying_qualities_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "base/number_text.h"
#include "src/config/usage_error.h"
#include "src/files/json_number.h"
#include "src/files/text_table.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

std::string Figure(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-";
}

std::string LevelText(const Requirement& requirement) {
  const int level = requirement.level;
  return (level > 3 ? "below 3" : fmt::format("level {}", level)) +
         (requirement.is_doubtful ? "?" : "");
}

/// How near an equivalent system of `order` ("first", "second") is.
std::string FitText(double mismatch, const char* order) {
  if (mismatch <= kMostMismatch) return fmt::format("mismatch {:.1f}", mismatch);
  return fmt::format("mismatch {:.1f}, above {}: the response is not of {} order", mismatch,
                     kMostMismatch, order);
}

/// Below a table with doubtful levels.
std::string DoubtNote() {
  return fmt::format(
      "?: of an equivalent system with a mismatch above {} (MIL-STD-1797A): the aircraft has none, "
      "and the level says little\n",
      kMostMismatch);
}

bool HasDoubt(const FlyingQualities& qualities) {
  const auto& all = qualities.requirements;
  return std::any_of(all.begin(), all.end(),
                     [](const Requirement& requirement) { return requirement.is_doubtful; });
}

std::string DescribeStep(const char* name, const StepResponse& step, const char* unit) {
  return fmt::format("{} step of {:.0f} %: {} {}, rise {} s, overshoot {} %\n", name,
                     100 * step.size, Figure(step.reached), unit, Figure(step.rise_s),
                     Figure(100 * step.overshoot));
}

const char* NameOf(LoopBreak where) { return kLoopBreaks[static_cast<std::size_t>(where)].second; }

/// "elevator"; "elevator, rudder" where gain and phase are least in different loops.
std::string LimitingLoops(const LoopAt& least_gain, const LoopAt& least_phase) {
  const std::string name = NameOf(least_gain.where);
  return least_gain.where == least_phase.where ? name : name + ", " + NameOf(least_phase.where);
}

std::string DescribeLoops(const FlyingQualities& qualities) {
  std::vector<std::vector<std::string>> rows = {{"loop broken at", "gain margin (increase)",
                                                 "gain margin (decrease)", "phase margin",
                                                 "crossover", "delay margin"}};
  for (const LoopAt& loop : qualities.loops) {
    const LoopMargins& margins = loop.margins;
    rows.push_back({NameOf(loop.where), Figure(margins.gain_up_db) + " dB",
                    Figure(margins.gain_down_db) + " dB", Figure(margins.phase_deg) + " deg",
                    Figure(margins.crossover_rad_s) + " rad/s", Figure(margins.delay_s) + " s"});
  }
  return InColumns(rows);
}

/// The equivalent systems, or why there are none.
std::string DescribeEquivalents(const FlyingQualities& qualities) {
  if (const auto& mode = qualities.unstable_mode) {
    return fmt::format(
        "the closed loop is unstable: {}time to double {:.3g} s; margins and equivalent systems "
        "have no meaning\n",
        mode->is_oscillatory() ? Figure(mode->frequency_rad_s()) + " rad/s, " : "",
        mode->time_to_double_s());
  }
  const EquivalentShortPeriod& pitch = qualities.short_period;
  return fmt::format(
      "equivalent short period: {:.2f} rad/s, damping {:.2f}, delay {:.3f} s ({}); n/alpha "
      "{:.1f} g/rad\n"
      "equivalent roll mode: {:.2f} s, delay {:.3f} s ({})\n",
      pitch.frequency_rad_s, pitch.damping_ratio, pitch.delay_s, FitText(pitch.mismatch, "second"),
      qualities.load_factor_by_alpha, qualities.roll.time_constant_s, qualities.roll.delay_s,
      FitText(qualities.roll.mismatch, "first"));
}

/// The least gain margin and phase margin of a line of a table, and the loops that have them; of an
/// unstable closed loop there are none.
std::vector<std::string> MarginCells(const FlyingQualities& qualities) {
  const std::vector<LoopAt>& loops = qualities.loops;
  if (loops.empty()) return {"unstable", "unstable", "-"};
  const auto gain = [](const LoopAt& loop) {
    return std::min(loop.margins.gain_up_db, loop.margins.gain_down_db);
  };
  const auto least_gain =
      std::min_element(loops.begin(), loops.end(),
                       [&](const LoopAt& a, const LoopAt& b) { return gain(a) < gain(b); });
  const auto least_phase = std::min_element(
      loops.begin(), loops.end(),
      [](const LoopAt& a, const LoopAt& b) { return a.margins.phase_deg < b.margins.phase_deg; });
  return {Figure(gain(*least_gain)), Figure(least_phase->margins.phase_deg),
          LimitingLoops(*least_gain, *least_phase)};
}

/// The worst level of the requirements of a paragraph that begins with `prefix`; "-" without any.
std::string WorstLevel(const FlyingQualities& qualities, const std::string& prefix) {
  int worst = 0;
  bool is_doubtful = false;
  for (const Requirement& requirement : qualities.requirements) {
    if (std::string(requirement.paragraph).rfind(prefix, 0) == 0) {
      worst = std::max(worst, requirement.level);
      is_doubtful = is_doubtful || requirement.is_doubtful;
    }
  }
  if (worst == 0) return "-";
  return (worst > 3 ? ">3" : std::to_string(worst)) + (is_doubtful ? "?" : "");
}

Json ToJson(const StepResponse& step, const char* reached) {
  return {{"stick", step.size},
          {reached, NumberOrNull(step.reached)},
          {"rise_s", NumberOrNull(step.rise_s)},
          {"overshoot", NumberOrNull(step.overshoot)}};
}

Json ToJson(const std::optional<LinearMode>& unstable_mode) {
  if (!unstable_mode) return nullptr;
  const std::complex<double> eigenvalue = unstable_mode->eigenvalue;
  return {{"eigenvalue_per_s", {eigenvalue.real(), eigenvalue.imag()}},
          {"frequency_rad_s", unstable_mode->frequency_rad_s()},
          {"time_to_double_s", unstable_mode->time_to_double_s()}};
}

Json ToJson(const LoopAt& loop) {
  const LoopMargins& margins = loop.margins;
  return {{"broken_at", NameOf(loop.where)},
          {"gain_up_db", NumberOrNull(margins.gain_up_db)},
          {"gain_up_rad_s", NumberOrNull(margins.gain_up_rad_s)},
          {"gain_down_db", NumberOrNull(margins.gain_down_db)},
          {"phase_deg", NumberOrNull(margins.phase_deg)},
          {"crossover_rad_s", NumberOrNull(margins.crossover_rad_s)},
          {"delay_s", NumberOrNull(margins.delay_s)}};
}

Json ToJson(const Requirement& requirement) {
  return {{"paragraph", requirement.paragraph},
          {"what", requirement.what},
          {"unit", requirement.unit},
          {"value", NumberOrNull(requirement.value)},
          {"level", requirement.level},
          {"limits", requirement.limits},
          {"is_doubtful", requirement.is_doubtful}};
}

/// The place of `name` among `names`.
std::size_t IndexOf(const std::string& name, const std::vector<std::string>& names,
                    const char* what) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  throw UsageError(fmt::format("{} \"{}\": {} are known", what, name, fmt::join(names, ", ")));
}

}  // namespace

std::vector<std::string> AirplaneClassNames() { return {"I", "II", "III", "IV"}; }

std::vector<std::string> FlightPhaseCategoryNames() { return {"A", "B", "C"}; }

LevelLimits LimitsNamed(const std::string& airplane_class, const std::string& category) {
  return LimitsOf(
      static_cast<AirplaneClass>(IndexOf(airplane_class, AirplaneClassNames(), "class")),
      static_cast<FlightPhaseCategory>(IndexOf(category, FlightPhaseCategoryNames(), "category")));
}

AssessedFlight AssessSteadyFlight(const Plant& plant, const SteadyFlightRequest& request,
                                  const LevelLimits& limits) {
  if (!request.IsStraight()) {
    throw UsageError("flying qualities are of flight with level wings, without a pull-up");
  }
  const SteadyFlight flight = FindSteadyFlight(plant, request);
  for (const ExceededLimit& limit : flight.exceeded_limits) {
    if (limit.limit == FlightLimit::kEngineTables) continue;
    throw Error(fmt::format("flight at {} ft and {:.6g} ft/s {}", request.altitude_ft,
                            request.true_airspeed_ft_s, limit.words));
  }
  return {request, AssessFlyingQualities(plant, flight.trim, limits)};
}

std::string Describe(const FlyingQualities& qualities, const std::string& standard) {
  std::string text = DescribeStep("pitch stick", qualities.pitch_step, "g") +
                     DescribeStep("roll stick", qualities.roll_step, "deg/s");
  text += DescribeEquivalents(qualities) + "\n";
  std::vector<std::vector<std::string>> rows = {
      {"MIL-F-8785C", standard, "", "", "limits of levels 1; 2; 3"}};
  for (const Requirement& requirement : qualities.requirements) {
    const std::string unit = requirement.unit == std::string("1") ? "" : requirement.unit;
    rows.push_back({requirement.paragraph, requirement.what,
                    Figure(requirement.value) + (unit.empty() ? "" : " " + unit),
                    LevelText(requirement), requirement.limits});
  }
  text += InColumns(rows) + (HasDoubt(qualities) ? DoubtNote() : "");
  return qualities.loops.empty() ? text : text + "\n" + DescribeLoops(qualities);
}

std::string DescribeLevels(const std::vector<AssessedFlight>& flights) {
  std::vector<std::vector<std::string>> rows = {{"altitude", "speed", "short period", "airspeed",
                                                 "phugoid", "Dutch roll", "roll", "spiral", "bank",
                                                 "delay", "GM, dB", "PM, deg", "limiting loop"}};
  for (const AssessedFlight& flight : flights) {
    const FlyingQualities& qualities = flight.qualities;
    rows.push_back({ShortestText(flight.request.altitude_ft),
                    fmt::format("{:.6g}", flight.request.true_airspeed_ft_s),
                    WorstLevel(qualities, "3.2.2.1"), WorstLevel(qualities, "3.2.1.1"),
                    WorstLevel(qualities, "3.2.1.2"), WorstLevel(qualities, "3.3.1.1"),
                    WorstLevel(qualities, "3.3.1.2"), WorstLevel(qualities, "3.3.1.3"),
                    WorstLevel(qualities, "3.3.4"), WorstLevel(qualities, "3.5.3")});
    const std::vector<std::string> margins = MarginCells(qualities);
    rows.back().insert(rows.back().end(), margins.begin(), margins.end());
  }
  const bool has_doubt =
      std::any_of(flights.begin(), flights.end(),
                  [](const AssessedFlight& flight) { return HasDoubt(flight.qualities); });
  return InColumns(rows) + (has_doubt ? DoubtNote() : "");
}

Json ToJson(const AssessedFlight& flight) {
  const FlyingQualities& qualities = flight.qualities;
  const LinearMode& dutch_roll = qualities.dutch_roll;
  const EquivalentShortPeriod& pitch = qualities.short_period;
  Json json = {{"altitude_ft", flight.request.altitude_ft},
               {"speed_fps", flight.request.true_airspeed_ft_s},
               {"unstable_mode", ToJson(qualities.unstable_mode)},
               {"pitch_step", ToJson(qualities.pitch_step, "load_factor_g")},
               {"roll_step", ToJson(qualities.roll_step, "p_deg_s")},
               {"load_factor_by_alpha_g_per_rad", qualities.load_factor_by_alpha},
               {"equivalent_short_period",
                {{"frequency_rad_s", NumberOrNull(pitch.frequency_rad_s)},
                 {"damping_ratio", NumberOrNull(pitch.damping_ratio)},
                 {"delay_s", NumberOrNull(pitch.delay_s)},
                 {"mismatch", NumberOrNull(pitch.mismatch)}}},
               {"equivalent_roll",
                {{"time_constant_s", NumberOrNull(qualities.roll.time_constant_s)},
                 {"delay_s", NumberOrNull(qualities.roll.delay_s)},
                 {"mismatch", NumberOrNull(qualities.roll.mismatch)}}},
               {"dutch_roll",
                {{"eigenvalue_per_s", {dutch_roll.eigenvalue.real(), dutch_roll.eigenvalue.imag()}},
                 {"frequency_rad_s", dutch_roll.frequency_rad_s()},
                 {"damping_ratio", dutch_roll.damping_ratio()}}},
               {"bank_deg", qualities.bank_deg},
               {"bank_s", NumberOrNull(qualities.bank_s)}};
  for (const Requirement& requirement : qualities.requirements) {
    json["requirements"].push_back(ToJson(requirement));
  }
  json["loops"] = Json::array();
  for (const LoopAt& loop : qualities.loops) json["loops"].push_back(ToJson(loop));
  return json;
}

}  // namespace skein
