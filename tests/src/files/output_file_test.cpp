// SPDX-License-Identifier: Apache-2.0
#include "src/files/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/choice_error.h"

namespace skein {
namespace {

TEST(RequireEnding, RefusesTheEndingOfAnotherFormat) {
  for (const std::string path :
       {"flights.svg", "folder.csv/flights.json", "flights.SVG", "a.csv.acmi"}) {
    EXPECT_THAT([&] { RequireEnding(path, ".csv", "--flights writes CSV"); },
                ::testing::ThrowsMessage<ChoiceError>(
                    path + ": --flights writes CSV: let the name end in .csv"));
  }
}

TEST(RequireEnding, LeavesAllOtherNamesToTheUser) {
  for (const std::string path : {"", "flights.csv", "flights.CSV", "flights", "flights.txt", "v1.2",
                                 "folder.svg/flights", "/dev/stdout", ".csv"}) {
    EXPECT_NO_THROW(RequireEnding(path, ".csv", "--flights writes CSV")) << path;
  }
}

}  // namespace
}  // namespace skein
