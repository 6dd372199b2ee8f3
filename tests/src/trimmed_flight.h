// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/files/output_file.h"
#include "tests/src/run_program.h"

namespace skein {

/// What `skein fdm trim` writes into the folder of the flight at an altitude and speed, with `more`
/// flags.
inline nlohmann::json TrimmedIn(const std::string& folder, const std::string& altitude_ft,
                                const std::string& speed_fps,
                                const std::vector<std::string>& more) {
  const std::string path = folder + "/trim.json";
  std::vector<std::string> words = {"fdm",         "trim",    "--altitude-ft", altitude_ft,
                                    "--speed-fps", speed_fps, "--json",        path};
  words.insert(words.end(), more.begin(), more.end());
  EXPECT_EQ(CallSkein(words).exit_code, 0);
  return nlohmann::json::parse(ReadFile(path));
}

}  // namespace skein
