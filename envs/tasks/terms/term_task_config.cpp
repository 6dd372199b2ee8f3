// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/terms/term_task_config.h"

#include <algorithm>
#include <cmath>

namespace skein {

bool TermTaskConfig::has_point() const {
  return std::any_of(targets.begin(), targets.end(), [](const TermTarget& target) {
    return target.draw_from == TermTarget::Draw::kPoint;
  });
}

TermValue TermTaskConfig::ValueReadBy(const TermNumber& number) const {
  if (number.value != TermValue::kTargetError) return number.value;
  return targets[static_cast<std::size_t>(number.target)].quantity.value;
}

double TermTaskConfig::TerrainAt(double north_ft, double east_ft) const {
  double height = terrain_base_ft;
  for (const TerrainWave& wave : terrain) {
    const double north = wave.wavelength_north_ft == 0 ? 0 : north_ft / wave.wavelength_north_ft;
    const double east = wave.wavelength_east_ft == 0 ? 0 : east_ft / wave.wavelength_east_ft;
    height += wave.height_ft * std::sin(2 * M_PI * (north + east) + wave.phase_rad);
  }
  return height;
}

TermTaskConfig TermTaskConfig::ForEvaluation() const {
  TermTaskConfig evaluated = *this;
  evaluated.training_tolerance_min = evaluated.training_tolerance_max = 1;
  return evaluated;
}

}  // namespace skein
