// SPDX-License-Identifier: Apache-2.0
// A thousand damaged files for every reader, without libFuzzer: scripts/fuzz tries millions.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "src/files/output_file.h"
#include "tests/damage.h"
#include "tests/fuzz/fuzz_target.h"

namespace skein {
namespace {

class Reader : public ::testing::TestWithParam<FuzzTarget> {};

TEST_P(Reader, TakesItsSeeds) {
  for (const std::string& seed : GetParam().seeds()) {
    EXPECT_TRUE(Takes(GetParam(), seed));
    EXPECT_TRUE(Takes(GetParam(), GetParam().repaired(seed)));
  }
}

TEST_P(Reader, RefusesDamagedFilesInOneLineOrTakesThem) {
  constexpr std::uint32_t kFiles = 1000;
  const std::vector<std::string> seeds = GetParam().seeds();
  int taken = 0;
  for (std::uint32_t i = 0; i < kFiles; ++i) {
    SCOPED_TRACE("seed of the damage: " + std::to_string(i));
    const std::string file = GetParam().repaired(Damage(i).Of(seeds[i % seeds.size()]));
    EXPECT_NO_THROW(taken += Takes(GetParam(), file) ? 1 : 0);
  }
  // Neither all of them nor none: both ways are walked.
  EXPECT_GT(taken, 0);
  EXPECT_LT(taken, static_cast<int>(kFiles));
}

/// What libFuzzer found to walk other ways than the seeds do (scripts/fuzz).
TEST_P(Reader, TakesOrRefusesTheKeptCorpus) {
  const std::string folder = std::string(SKEIN_SOURCE "/tests/fuzz/corpus/") + GetParam().name;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "nothing is kept for it";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path());
    EXPECT_NO_THROW(Takes(GetParam(), ReadFile(entry.path().string())));
    ++files;
  }
  EXPECT_GT(files, 0);
}

INSTANTIATE_TEST_SUITE_P(Of, Reader, ::testing::ValuesIn(FuzzTargets()),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace skein
