// SPDX-License-Identifier: Apache-2.0
#include "train/network/backend_module.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace skein {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string RefusalOf(const std::string& file) {
  try {
    LoadBackendModule(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(BackendModuleTest, OneThatIsMissingIsRefusedInOneLineThatSaysHowToGetIt) {
  EXPECT_THAT(RefusalOf("libskein_nowhere.so"),
              AllOf(HasSubstr("libskein_nowhere.so"), HasSubstr("libtorch-dev"),
                    HasSubstr("SKEIN_BUILD_LIBTORCH"), Not(HasSubstr("\n"))));
}

TEST(BackendModuleTest, AnotherLibraryIsRefused) {
  EXPECT_THAT(RefusalOf("libm.so.6"), HasSubstr("libm.so.6 is no module of Skein"));
}

}  // namespace
}  // namespace skein
