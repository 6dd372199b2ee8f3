// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "src/files/output_file.h"
#include "src/run/run_directory.h"

namespace skein {

inline constexpr int kIterations = 12;
inline constexpr int kStepsPerIteration = 64 * 16 * 5;

/// Arguments of a training that takes a moment, kIterations long, with a checkpoint each.
inline std::vector<std::string> TinyTrainingOf(const std::string& task, const std::string& out,
                                               const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"train", task, "--out", out};
  for (const std::string& assignment :
       {std::string("run.total_steps=") + std::to_string(kStepsPerIteration * kIterations),
        std::string("ppo.num_aircraft=64"), std::string("ppo.rollout_steps=16"),
        std::string("ppo.chunk_length=8"), std::string("ppo.minibatches=2"),
        std::string("network.hidden_size=16"), std::string("network.gru_size=16"),
        std::string("env.time_limit_steps=100"), std::string("evaluation.interval_iterations=3"),
        std::string("evaluation.episodes=32"), std::string("evaluation.final_episodes=32"),
        std::string("checkpoint.interval_iterations=1")}) {
    arguments.push_back("--set");
    arguments.push_back(assignment);
  }
  // Before the time limit.
  if (task == "heading") {
    arguments.insert(arguments.end(), {"--set", "env.heading.earliest_success_step=100"});
  }
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// The same of Heading.
inline std::vector<std::string> TinyTraining(const std::string& out,
                                             const std::vector<std::string>& more = {}) {
  return TinyTrainingOf("heading", out, more);
}

/// An error of one line with `part` in it.
inline void ExpectOneLine(const std::string& error, const std::string& part) {
  EXPECT_EQ(error.rfind("skein: error: ", 0), 0u) << error;
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
  EXPECT_THAT(error, ::testing::HasSubstr(part));
}

inline void ExpectSameFile(const std::string& a, const std::string& b) {
  const std::string bytes = ReadFile(a);
  EXPECT_FALSE(bytes.empty());
  EXPECT_TRUE(bytes == ReadFile(b)) << a << " differs from " << b;
}

/// Whether the run has got as far as that.
inline bool HasCheckpoint(const std::string& run, std::uint64_t iteration) {
  const auto all = CheckpointsIn(run + "/checkpoints");
  return !all.empty() && all.back().iteration >= iteration;
}

}  // namespace skein
