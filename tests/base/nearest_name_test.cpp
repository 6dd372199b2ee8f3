// SPDX-License-Identifier: Apache-2.0
#include "base/nearest_name.h"

#include <gtest/gtest.h>

namespace skein {
namespace {

TEST(NearestName, FindsWhatWasMisspelt) {
  EXPECT_EQ(NearestName("hedding", {"control", "heading", "tracking"}), "heading");
  EXPECT_EQ(NearestName("zreo", {"random", "zero"}), "zero");
  EXPECT_EQ(NearestName("trian", {"train", "trim"}), "train");
  EXPECT_EQ(NearestName("HEADING", {"control", "heading"}), "heading");
  EXPECT_EQ(NearestName("gamma", {"ppo.gae_lambda", "ppo.gamma"}), "ppo.gamma");
}

TEST(NearestName, OfShortNamesMostMustAgree) {
  EXPECT_EQ(NearestName("V", {"I", "II", "III", "IV"}), "");
  EXPECT_EQ(NearestName("X", {"A", "B", "C"}), "");
  EXPECT_EQ(NearestName("png", {"svg", "pdf"}), "");
  EXPECT_EQ(NearestName("pdg", {"svg", "pdf"}), "pdf");
  EXPECT_EQ(NearestName("test", {"list"}), "");
  EXPECT_EQ(NearestName("fast", {"default", "easy", "robust"}), "");
  EXPECT_EQ(NearestName("tset", {"test"}), "test");
}

TEST(NearestName, OfLongNamesAThirdMayDiffer) {
  EXPECT_EQ(NearestName("entropy_coeff", {"entropy_coefficient"}), "");
  EXPECT_EQ(NearestName("entropy_coefficnt", {"entropy_coefficient"}), "entropy_coefficient");
  EXPECT_EQ(NearestName("", {"a"}), "");
}

}  // namespace
}  // namespace skein
