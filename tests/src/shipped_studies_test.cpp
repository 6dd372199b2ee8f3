// SPDX-License-Identifier: Apache-2.0
// Holds the files of configs/studies/ to what can be carried out, without training anything.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "src/config/conditions.h"
#include "src/study/study.h"
#include "src/study/study_run.h"
#include "tests/scratch_directory.h"

namespace skein {
namespace {

namespace fs = std::filesystem;

const fs::path kStudies = fs::path(SKEIN_SOURCE) / "configs/studies";

class ShippedStudies : public ::testing::Test {
 protected:
  // Studies name policies by where they lie in the repository.
  void SetUp() override { fs::current_path(SKEIN_SOURCE); }
  void TearDown() override { fs::current_path(before_); }

 private:
  const fs::path before_ = fs::current_path();
};

TEST_F(ShippedStudies, NameWhatExists) {
  const ScratchDirectory scratch;
  WorkerPool pool(1);
  int files = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(kStudies)) {
    SCOPED_TRACE(entry.path());
    const Study study = ReadStudy(entry.path().string());
    // What it is made of is checked as it begins: configurations, conditions, agents, policies.
    const std::string out = scratch / entry.path().stem().string();
    EXPECT_NO_THROW(StudyRun(study, out, pool));
    ++files;
  }
  EXPECT_GE(files, 4);
}

TEST_F(ShippedStudies, FlyEveryTaskUnderEveryLevelOfThePapersConditions) {
  for (const std::string task : {"heading", "control", "tracking"}) {
    const Study study = ReadStudy((kStudies / (task + ".toml")).string());
    EXPECT_EQ(study.tasks, std::vector<std::string>{task});
    EXPECT_TRUE(study.training.per_level);
    EXPECT_FALSE(study.training.steps.has_value()) << "the preset's budget";
    EXPECT_EQ(study.levels.size(), 4u * 3u);
    for (const std::string condition : {"high_speed", "high_altitude", "windy", "noisy"}) {
      for (const std::string level : {"mild", "middle", "hard"}) {
        const auto found = std::find_if(
            study.levels.begin(), study.levels.end(),
            [&](const StudyLevel& other) { return other.name == condition + "-" + level; });
        ASSERT_NE(found, study.levels.end()) << condition << level;
        EXPECT_EQ(found->settings.conditions, std::vector<std::string>{condition + "=" + level});
        EXPECT_TRUE(found->settings.assignments.empty());
      }
    }
  }
}

}  // namespace
}  // namespace skein
