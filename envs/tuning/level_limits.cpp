// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/level_limits.h"

#include <limits>

namespace skein {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

bool IsNimble(AirplaneClass airplane) {
  return airplane == AirplaneClass::kI || airplane == AirplaneClass::kIV;
}

void SetShortPeriod(bool is_nimble, FlightPhaseCategory category, LevelLimits* limits) {
  limits->short_period_damping_min = {0.35, 0.25, 0.15};
  limits->short_period_damping_max = {1.3, 2, kNone};
  limits->short_period_frequency_min = limits->load_factor_by_alpha_min = {0, 0, 0};
  limits->anticipation_max = {3.6, 10, kNone};
  switch (category) {
    case FlightPhaseCategory::kA:
      limits->anticipation_min = {0.28, 0.16, 0.16};
      limits->short_period_frequency_min = {1, 0.6, 0};
      return;
    case FlightPhaseCategory::kB:
      limits->anticipation_min = {0.085, 0.038, 0.038};
      limits->short_period_damping_min = {0.3, 0.2, 0.15};
      limits->short_period_damping_max = {2, 2, kNone};
      return;
    case FlightPhaseCategory::kC:
      limits->anticipation_min = {0.16, 0.096, 0.096};
      limits->short_period_frequency_min = {is_nimble ? 0.87 : 0.7, is_nimble ? 0.6 : 0.4, 0};
      limits->load_factor_by_alpha_min = {is_nimble ? 2.7 : 2, is_nimble ? 1.8 : 1, 0};
      return;
  }
}

void SetDutchRoll(bool is_nimble, FlightPhaseCategory category, LevelLimits* limits) {
  limits->dutch_roll_damping_min = {0.08, 0.02, 0};
  limits->dutch_roll_product_min = {0.15, 0.05, 0};
  limits->dutch_roll_frequency_min = {is_nimble ? 1 : 0.4, 0.4, 0.4};
  switch (category) {
    case FlightPhaseCategory::kA:
      limits->dutch_roll_damping_min[0] = 0.19;
      limits->dutch_roll_product_min[0] = 0.35;
      return;
    case FlightPhaseCategory::kB:
      limits->dutch_roll_frequency_min[0] = 0.4;
      return;
    case FlightPhaseCategory::kC:
      if (!is_nimble) limits->dutch_roll_product_min[0] = 0.1;
      return;
  }
}

/// A change of bank, deg, and the times of the levels, s, by class and category.
struct RollPerformance {
  const char* paragraph;
  double bank_deg[3];
  LevelLimit time_s[3];
};
constexpr RollPerformance kRollPerformance[4] = {
    {"3.3.4", {60, 60, 30}, {{1.3, 1.7, 2.6}, {1.7, 2.5, 3.4}, {1.3, 1.8, 2.6}}},
    {"3.3.4", {45, 45, 30}, {{1.4, 1.9, 2.8}, {1.9, 2.8, 3.8}, {1.8, 2.5, 3.6}}},
    {"3.3.4.2", {30, 30, 30}, {{1.5, 2, 3}, {2, 3.3, 5}, {2.5, 4, 6}}},
    {"3.3.4.1", {90, 90, 30}, {{1.3, 1.7, 2.6}, {1.7, 2.5, 3.4}, {1.1, 1.3, 2}}}};

/// The first level whose limits `meets(level)` says are met.
template <typename Meets>
int FirstLevel(const Meets& meets) {
  for (std::size_t level = 0; level < 3; ++level) {
    if (meets(level)) return static_cast<int>(level) + 1;
  }
  return 4;
}

}  // namespace

LevelLimits LimitsOf(AirplaneClass airplane, FlightPhaseCategory category) {
  LevelLimits limits{};
  const bool is_nimble = IsNimble(airplane), is_gradual = category == FlightPhaseCategory::kB;
  SetShortPeriod(is_nimble, category, &limits);
  limits.airspeed_double_min_s = {kNone, kNone, 6};
  limits.phugoid_damping_min = {0.04, 0};
  limits.phugoid_double_min_s = 55;
  SetDutchRoll(is_nimble, category, &limits);
  limits.roll_time_max_s =
      is_nimble && !is_gradual ? LevelLimit{1, 1.4, 10} : LevelLimit{1.4, 3, 10};
  limits.spiral_double_min_s = {is_gradual ? 20.0 : 12.0, 8, 4};
  const RollPerformance& roll = kRollPerformance[static_cast<std::size_t>(airplane)];
  const auto phase = static_cast<std::size_t>(category);
  limits.roll_paragraph = roll.paragraph;
  limits.bank_deg = roll.bank_deg[phase];
  limits.bank_time_max_s = roll.time_s[phase];
  limits.equivalent_delay_max_s = {0.1, 0.2, 0.25};
  return limits;
}

int AnticipationLevel(const LevelLimits& limits, double anticipation, double frequency_rad_s,
                      double load_factor_by_alpha) {
  return FirstLevel([&](std::size_t level) {
    return anticipation >= limits.anticipation_min[level] &&
           anticipation <= limits.anticipation_max[level] &&
           frequency_rad_s >= limits.short_period_frequency_min[level] &&
           load_factor_by_alpha >= limits.load_factor_by_alpha_min[level];
  });
}

int ShortPeriodDampingLevel(const LevelLimits& limits, double damping_ratio) {
  return FirstLevel([&](std::size_t level) {
    return damping_ratio >= limits.short_period_damping_min[level] &&
           damping_ratio <= limits.short_period_damping_max[level];
  });
}

int AirspeedDivergenceLevel(const LevelLimits& limits, double time_to_double_s) {
  return FirstLevel(
      [&](std::size_t level) { return time_to_double_s >= limits.airspeed_double_min_s[level]; });
}

int PhugoidLevel(const LevelLimits& limits, double damping_ratio, double time_to_double_s) {
  return FirstLevel([&](std::size_t level) {
    return level < 2 ? damping_ratio >= limits.phugoid_damping_min[level]
                     : time_to_double_s >= limits.phugoid_double_min_s;
  });
}

int DutchRollLevel(const LevelLimits& limits, double damping_ratio, double frequency_rad_s) {
  return FirstLevel([&](std::size_t level) {
    return damping_ratio >= limits.dutch_roll_damping_min[level] &&
           damping_ratio * frequency_rad_s >= limits.dutch_roll_product_min[level] &&
           frequency_rad_s >= limits.dutch_roll_frequency_min[level];
  });
}

int RollModeLevel(const LevelLimits& limits, double time_constant_s) {
  return FirstLevel(
      [&](std::size_t level) { return time_constant_s <= limits.roll_time_max_s[level]; });
}

int SpiralLevel(const LevelLimits& limits, double time_to_double_s) {
  return FirstLevel(
      [&](std::size_t level) { return time_to_double_s >= limits.spiral_double_min_s[level]; });
}

int RollPerformanceLevel(const LevelLimits& limits, double bank_time_s) {
  return FirstLevel(
      [&](std::size_t level) { return bank_time_s <= limits.bank_time_max_s[level]; });
}

int EquivalentDelayLevel(const LevelLimits& limits, double delay_s) {
  return FirstLevel(
      [&](std::size_t level) { return delay_s <= limits.equivalent_delay_max_s[level]; });
}

}  // namespace skein
