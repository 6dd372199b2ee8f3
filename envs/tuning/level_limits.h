// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace skein {

/// Of aeroplanes, MIL-F-8785C, 1.3: small and light; medium weight, low to medium manoeuvrability
/// (here land-based, II-L); large and heavy; high manoeuvrability.
enum class AirplaneClass { kI, kII, kIII, kIV };

/// Of flight phases, MIL-F-8785C, 1.4: rapid manoeuvres, precise tracking or flight path (A);
/// gradual manoeuvres (B); take-off and landing (C).
enum class FlightPhaseCategory { kA, kB, kC };

/// One limit of the levels 1, 2 and 3. Where there is none: 0 of a least figure, infinity of a
/// greatest one.
using LevelLimit = std::array<double, 3>;

/// Where the levels of MIL-F-8785C end, by paragraph.
struct LevelLimits {
  /// 3.2.2.1.1, figures 1 to 3: of frequency^2 over n/alpha, 1/(g s^2); of the frequency, rad/s; of
  /// n/alpha, g/rad.
  LevelLimit anticipation_min, anticipation_max, short_period_frequency_min,
      load_factor_by_alpha_min;
  LevelLimit short_period_damping_min, short_period_damping_max;  ///< 3.2.2.1.2, table IV
  /// 3.2.1.1: least time to double of airspeed that diverges aperiodically, s; infinity: none may.
  LevelLimit airspeed_double_min_s;
  /// 3.2.1.2: of levels 1 and 2; of level 3 the least time to double, s.
  std::array<double, 2> phugoid_damping_min;
  double phugoid_double_min_s;
  /// 3.3.1.1, table VI, without what category A asks of air combat and ground attack: damping
  /// ratio, its product with the frequency, frequency, rad/s.
  LevelLimit dutch_roll_damping_min, dutch_roll_product_min, dutch_roll_frequency_min;
  LevelLimit roll_time_max_s;      ///< 3.3.1.2, table VII
  LevelLimit spiral_double_min_s;  ///< 3.3.1.3, table VIII
  /// 3.3.4 (class I and II), 3.3.4.1 (class IV), 3.3.4.2 (class III), table IX: greatest time from
  /// full roll stick to a change of bank, of classes III and IV in the middle of their speeds.
  const char* roll_paragraph;
  double bank_deg;
  LevelLimit bank_time_max_s;
  LevelLimit equivalent_delay_max_s;  ///< 3.5.3, table XIV
};

/// Of aeroplanes of that class, in flight phases of that category.
LevelLimits LimitsOf(AirplaneClass airplane, FlightPhaseCategory category);

/// The level of figures alone, by the limits of the same names: 1 to 3, or 4 beyond level 3, as of
/// figures that are no numbers.
int AnticipationLevel(const LevelLimits& limits, double anticipation, double frequency_rad_s,
                      double load_factor_by_alpha);
int ShortPeriodDampingLevel(const LevelLimits& limits, double damping_ratio);
int AirspeedDivergenceLevel(const LevelLimits& limits, double time_to_double_s);
int PhugoidLevel(const LevelLimits& limits, double damping_ratio, double time_to_double_s);
int DutchRollLevel(const LevelLimits& limits, double damping_ratio, double frequency_rad_s);
int RollModeLevel(const LevelLimits& limits, double time_constant_s);
int SpiralLevel(const LevelLimits& limits, double time_to_double_s);
int RollPerformanceLevel(const LevelLimits& limits, double bank_time_s);
int EquivalentDelayLevel(const LevelLimits& limits, double delay_s);

}  // namespace skein
