// SPDX-License-Identifier: Apache-2.0
#include "train/files/legacy_names.h"

#include <gtest/gtest.h>

#include "train/files/tensor_access.h"

namespace skein {
namespace {

TEST(LegacyNamesTest, BecomeThoseOfToday) {
  TensorFile file;
  file.metadata = {{"config.env.planner.yaw_change_rad", "a"},
                   {"controller.autopilot", "b"},
                   {"controller.policy.task", "c"},
                   {"policy.env.planner.averages_observations", "d"},
                   {"policy.task", "e"}};
  const float value = 1;
  for (const char* name : {"controller/actor/head.bias", "recurrent/keep", "recurrent/actor"}) {
    StoreTensor(file, name, {1}, &value, 1);
  }
  TakeCurrentNames(file);
  const std::map<std::string, std::string> expected{
      {"config.env.high_level.yaw_change_rad", "a"},
      {"low_level.autopilot", "b"},
      {"low_level.policy.task", "c"},
      {"policy.env.high_level.averages_observations", "d"},
      {"policy.task", "e"}};
  EXPECT_EQ(file.metadata, expected);
  for (const char* name : {"low_level/actor/head.bias", "recurrent/not_done", "recurrent/actor"}) {
    EXPECT_EQ(file.tensors.count(name), 1u) << name;
  }
  EXPECT_EQ(file.tensors.size(), 3u);
}

}  // namespace
}  // namespace skein
