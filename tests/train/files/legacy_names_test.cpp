// SPDX-License-Identifier: Apache-2.0
#include "train/files/legacy_names.h"

#include <gtest/gtest.h>

#include "train/files/tensor_access.h"

namespace skein {
namespace {

TEST(LegacyNamesTest, BecomeThoseOfToday) {
  TensorFile file;
  file.metadata = {
      {"controller.autopilot", "b"}, {"controller.policy.task", "c"}, {"policy.task", "e"}};
  const float value = 1;
  for (const char* name : {"controller/actor/head.bias", "recurrent/keep", "recurrent/actor"}) {
    StoreTensor(file, name, {1}, &value, 1);
  }
  TakeCurrentNames(file);
  const std::map<std::string, std::string> expected{
      {"low_level.autopilot", "b"}, {"low_level.policy.task", "c"}, {"policy.task", "e"}};
  EXPECT_EQ(file.metadata, expected);
  for (const char* name : {"low_level/actor/head.bias", "recurrent/not_done", "recurrent/actor"}) {
    EXPECT_EQ(file.tensors.count(name), 1u) << name;
  }
  EXPECT_EQ(file.tensors.size(), 3u);
}

}  // namespace
}  // namespace skein
