// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/quantities.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace skein {
namespace {

std::vector<std::string> LabelsOf(const EnvConfig& env) {
  std::vector<std::string> labels;
  for (const Quantity& quantity : QuantitiesOf(env)) labels.push_back(quantity.label);
  return labels;
}

TEST(QuantitiesOf, MissionsOfTrainingAreNotThoseOfEvaluations) {
  EnvConfig points;
  points.task = "tracking";
  EnvConfig trained = points;
  trained.mission.training_length_s = 60;
  EXPECT_EQ(LabelsOf(trained), LabelsOf(points));
  EnvConfig missions = points;
  missions.mission.length_s = 60;
  EXPECT_NE(LabelsOf(missions), LabelsOf(points));
}

}  // namespace
}  // namespace skein
