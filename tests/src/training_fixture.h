// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"
#include "tests/src/tiny_training.h"

namespace skein {

inline constexpr const char* kLastCheckpoint = "/checkpoints/checkpoint-000012.skein";

inline void ExpectSameRun(const std::string& a, const std::string& b) {
  for (const char* file : {"/metrics.csv", kLastCheckpoint, "/checkpoints/policy-final.skein",
                           "/checkpoints/policy-best.skein", "/config.toml"}) {
    ExpectSameFile(a + file, b + file);
  }
}

/// Directories for runs.
class TrainingFixture : public ::testing::Test {
 protected:
  const ScratchDirectory scratch_;
  std::string root_ = scratch_.path();
  std::string reference_ = root_ + "/reference", run_ = root_ + "/run";

  /// An uninterrupted run to compare with.
  void FlyReference(const std::vector<std::string>& more = {}) {
    const ProgramResult result = RunSkein(TinyTraining(reference_, more));
    ASSERT_EQ(result.exit_code, 0) << result.error;
  }
};

}  // namespace skein
