// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/range.h"
#include "envs/tasks/terms/term_values.h"

namespace skein {

/// One of the aircraft's ReferenceUnits, or 1.
enum class ReferenceUnit : std::uint8_t { kNone, kAltitudeError, kAltitude, kSpeed };

/// What a number is divided by.
struct TermUnit {
  ReferenceUnit reference = ReferenceUnit::kNone;
  double number = 1;
};

/// A number that terms read: `per_value` times a value, in its unit.
struct TermNumber {
  std::string name;  ///< as the file has it
  TermValue value = TermValue::kOne;
  int target = -1;       ///< of kTargetError: the index of the target
  double per_value = 1;  ///< 180 / pi for the degrees of an angle
  TermUnit unit;
};

/// What is drawn when an episode begins.
struct TermTarget {
  /// From where its value is drawn.
  enum class Draw : std::uint8_t {
    kAroundStart,  ///< what it is at the start + U(draw.min, draw.max)
    kBetween,      ///< U(draw.min, draw.max)
    kPoint,        ///< a point away from the start: three targets, north, east and altitude
  };
  std::string name;
  TermNumber quantity;  ///< what it is compared with
  Draw draw_from = Draw::kAroundStart;
  Range draw;     ///< ft, ft/s, rad, or as the value has it
  TermUnit unit;  ///< of its normalised error
  Range distance_ft;
  double azimuth_deg = 0, elevation_deg = 0;  ///< to either side of the nose
};

/// Holds while a number is where it says.
struct TermCondition {
  /// What must hold of the number x.
  enum class Kind : std::uint8_t {
    kWithin,  ///< abs(x) < limit; of what is reached: times the episode's share of its tolerances
    kBelow,
    kAbove,
    kBeyond,  ///< abs(x) > limit
    kBox,     ///< the path of the control step touches the box of the point
  };
  TermNumber number;
  Kind kind = Kind::kWithin;
  double limit = 0;  ///< in the number's unit
};

/// A part of the reward: weight times shape of a number, or of the root of the sum of squares of
/// several, over `unit`.
struct TermReward {
  /// What is made of the number x.
  enum class Shape : std::uint8_t {
    kLinear,     ///< x
    kAbsolute,   ///< abs(x)
    kSquared,    ///< x^2
    kGaussian,   ///< exp(-x^2 / (2 width^2))
    kTolerance,  ///< 1 up to abs(x) = width, falling to 0 at width + margin
  };
  double weight = 1;
  std::vector<TermNumber> numbers;
  TermUnit unit;
  Shape shape = Shape::kLinear;
  double width = 1, margin = 0;
};

/// An end beside the limits of every task.
struct TermEnd {
  TermCondition condition;
  int termination = 0;  ///< Termination
};

/// A wave of a procedural terrain: height_ft sin(2 pi (north / wavelength_north + east /
/// wavelength_east) + phase). A wavelength of 0 is infinite.
struct TerrainWave {
  double height_ft = 0;
  double wavelength_north_ft = 0, wavelength_east_ft = 0;
  double phase_rad = 0;
};

/// A task that is made of terms (docs/reference/task-files.md), as its file says.
struct TermTaskConfig {
  static constexpr int kMaxTargets = 8, kMaxNumbers = 24, kMaxRewards = 24, kMaxConditions = 16;
  static constexpr int kMaxOfNorm = 8, kMaxWaves = 16;

  std::string name;
  std::string text;       ///< the file's, as it was read
  std::string hash;       ///< of the text
  std::string interface;  ///< hash of what a policy observes: those of one interface can fly it

  std::vector<TermTarget> targets;
  std::vector<TermNumber> observed;
  bool observes_flight = true;  ///< observations 3 to 21 of the built-in tasks
  bool observes_actions = false;
  std::vector<TermReward> rewards;
  std::vector<TermCondition> reached;
  double dwell_s = 0;
  int earliest_step = 0;
  double training_tolerance_min = 1;  ///< share of tolerances: U(x, 1)
  double training_tolerance_max = 1;  ///< of a box: exp(U(0, ln x)) times as wide
  std::vector<TermEnd> ends;
  double terrain_base_ft = 0;
  std::vector<TerrainWave> terrain;
  /// Whether its targets are a point, which is passed, and not a state, which can be held.
  bool has_point() const;
  /// What the number reads of the flight: of a target's error what the target is compared with.
  TermValue ValueReadBy(const TermNumber& number) const;
  bool has_terrain() const { return !terrain.empty() || terrain_base_ft != 0; }  ///< not flat at 0
  /// Height of the terrain, ft.
  double TerrainAt(double north_ft, double east_ft) const;
  /// Without what only serves training.
  TermTaskConfig ForEvaluation() const;
};

}  // namespace skein
