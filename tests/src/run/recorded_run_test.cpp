// SPDX-License-Identifier: Apache-2.0
#include "src/run/recorded_run.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/error.h"
#include "src/files/output_file.h"
#include "tests/scratch_directory.h"

namespace skein {
namespace {

class RecordOfStart : public ::testing::Test {
 protected:
  RecordOfStart() {
    WriteFile(networks_, "networks");
    WriteFile(others_, "other networks");
  }

  /// Whether the run with that line in its record was started from `networks`.
  bool WasStarted(const std::string& line, const std::string& networks) const {
    WriteFile(run_.config(), line + "# The complete configuration\n");
    return WasStartedFrom(run_, networks);
  }

  const ScratchDirectory scratch_;
  const RunDirectory run_ = RunDirectory::Create(scratch_ / "run");
  const std::string networks_ = scratch_ / "networks (1), hash.skein",
                    others_ = scratch_ / "others.skein";
};

TEST_F(RecordOfStart, KnowsTheNetworksByWhatTheyAre) {
  const std::string line = StartComment("started from " + networks_ + " (actor)", networks_);
  EXPECT_EQ(line.rfind("# started from " + networks_ + " (actor), hash ", 0), 0u);
  EXPECT_TRUE(WasStarted(line, networks_));
  EXPECT_FALSE(WasStarted(line, others_));
  EXPECT_FALSE(WasStarted(line, ""));
  std::filesystem::copy_file(networks_, scratch_ / "copy");
  EXPECT_TRUE(WasStarted(line, scratch_ / "copy"));
  WriteFile(networks_, "trained on");
  EXPECT_FALSE(WasStarted(line, networks_));
  EXPECT_THROW(WasStarted(line, scratch_ / "absent"), Error);
}

TEST_F(RecordOfStart, OfFreshNetworksThereIsNone) {
  EXPECT_EQ(StartComment("", ""), "");
  EXPECT_TRUE(WasStarted("", ""));
  EXPECT_FALSE(WasStarted("", networks_));
}

TEST_F(RecordOfStart, OfOlderVersionsHasThePathAlone) {
  const std::string line = "# started from " + others_ + " (actor and critic)\n";
  EXPECT_TRUE(WasStarted(line, others_));
  EXPECT_FALSE(WasStarted(line, networks_));
  EXPECT_FALSE(WasStarted(line, ""));
}

}  // namespace
}  // namespace skein
