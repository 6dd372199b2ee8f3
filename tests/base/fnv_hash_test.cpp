// SPDX-License-Identifier: Apache-2.0
#include "base/fnv_hash.h"

#include <gtest/gtest.h>

namespace skein {
namespace {

/// Vectors of draft-eastlake-fnv, appendix C: 64-bit FNV-1a.
TEST(FnvHash, IsThatOfThePublishedVectors) {
  EXPECT_EQ(HexHash(""), "cbf29ce484222325");
  EXPECT_EQ(HexHash("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(HexHash("foobar"), "85944171f73967e8");
}

TEST(FnvHash, GoesOnFromWhereAnotherStopped) {
  FnvHash first;
  first.Add("foo", 3);
  FnvHash rest(first.value());
  rest.Add("bar", 3);
  EXPECT_EQ(rest.Hex(), HexHash("foobar"));
}

}  // namespace
}  // namespace skein
