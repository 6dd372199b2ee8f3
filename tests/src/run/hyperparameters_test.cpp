// SPDX-License-Identifier: Apache-2.0
#include "src/run/hyperparameters.h"

#include <gtest/gtest.h>

#include "train/files/protobuf.h"

namespace skein {
namespace {

using protobuf::Double;
using protobuf::Integer;
using protobuf::Message;

TEST(Protobuf, FieldsAreEncodedAsTheSpecificationSays) {
  // The examples of protobuf.dev/programming-guides/encoding.
  EXPECT_EQ(Integer(1, 150), std::string("\x08\x96\x01"));
  EXPECT_EQ(Message(2, "testing"), std::string("\x12\x07testing"));
}

TEST(Hyperparameters, AreATextAndASessionOfTheHParamsPlugin) {
  const std::string summary = EncodeHyperparameters(
      "# a run\n[env.wind]\nspeed_min_fps = 2.5\n[run]\nseed = 3\n", "run", 7);
  EXPECT_NE(summary.find("    # a run\n    [env.wind]\n"), std::string::npos);
  const std::string number = Message(2, Double(2, 2.5));
  EXPECT_NE(summary.find(Message(1, Message(1, "env.wind.speed_min_fps") + number)),
            std::string::npos);
  EXPECT_NE(summary.find(Message(1, Message(1, "run.seed") + Message(2, Double(2, 3)))),
            std::string::npos);
  EXPECT_NE(summary.find(Message(1, "_hparams_/session_start_info")), std::string::npos);
  EXPECT_NE(summary.find(Message(1, "hparams")), std::string::npos);
}

TEST(Hyperparameters, NamesAndTruthValuesKeepTheirTypes) {
  const std::string summary = EncodeHyperparameters("a = \"fused\"\nb = true\n", "run", 7);
  EXPECT_NE(summary.find(Message(1, Message(1, "a") + Message(2, Message(3, "fused")))),
            std::string::npos);
  EXPECT_NE(summary.find(Message(1, Message(1, "b") + Message(2, Integer(4, 1)))),
            std::string::npos);
}

}  // namespace
}  // namespace skein
