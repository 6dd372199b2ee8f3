// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "src/files/output_file.h"
#include "tests/scratch_directory.h"

namespace skein {

/// Processes of this program with `word` among their arguments, beside mpirun itself, as the system
/// lists them.
inline std::vector<pid_t> ProcessesOf(const std::string& word) {
  std::vector<pid_t> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    try {
      const std::string words = ReadFile(entry.path().string() + "/cmdline");
      const bool is_rank = words.rfind(SKEIN_PROGRAM, 0) == 0;
      if (is_rank && words.find(word) != std::string::npos) found.push_back(std::stoi(name));
    } catch (const Error&) {  // it has ended
    }
  }
  return found;
}

/// Whether they all end within a minute.
inline bool AllEnd(const std::string& word) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!ProcessesOf(word).empty()) {
    if (std::chrono::steady_clock::now() > limit) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

/// The same as ProcessesOf of an MPI job, by rank.
inline std::vector<pid_t> RanksOf(const std::string& word) {
  std::map<int, pid_t> by_rank;
  for (const pid_t process : ProcessesOf(word)) {
    const std::string variable = "OMPI_COMM_WORLD_RANK=";
    try {
      const std::string all = ReadFile("/proc/" + std::to_string(process) + "/environ");
      const std::size_t at = all.find(variable);
      if (at != std::string::npos) by_rank[std::stoi(all.substr(at + variable.size()))] = process;
    } catch (const Error&) {  // it has ended
    }
  }
  std::vector<pid_t> ranks;
  for (const auto& [rank, process] : by_rank) ranks.push_back(process);
  return ranks;
}

/// The sanitizer's options of ranks whose caller has these (null: none), as an assignment. OpenMPI
/// unloads modules that leak: no suppression can name them.
inline std::string AsanOptionsOfRanks(const char* callers) {
  return std::string("ASAN_OPTIONS=") + (callers ? std::string(callers) + ":" : "") +
         "detect_leaks=0";
}

/// Jobs of several processes, with mpirun; skipped where there is none.
class RanksFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v mpirun > /dev/null 2>&1") != 0 ||
        !std::filesystem::exists(SKEIN_MPI_MODULE)) {
      GTEST_SKIP() << "no mpirun, or built without MPI";
    }
  }

  /// What the last rank has of its own: assignments to its environment, and its program.
  struct LastRank {
    std::string environment;
    std::string program = SKEIN_PROGRAM;
  };

  /// What ranks exchange their bytes over, in Open MPI's words.
  static constexpr const char *kSharedMemory = "^tcp", *kTcp = "tcp,self";  // by the loopback

  /// The words that start `count` ranks, over shared memory as they are all here. What the last has
  /// of its own a shell gives it: Open MPI 5.0.7's mpirun crashes where it starts more than one
  /// program.
  static std::vector<std::string> Mpirun(int count, const std::vector<std::string>& arguments,
                                         const std::optional<LastRank>& last = std::nullopt,
                                         const char* transport = kSharedMemory) {
    std::vector<std::string> words = {"mpirun", "--allow-run-as-root", "--oversubscribe"};
    words.insert(words.end(),
                 {"--mca", "btl", transport, "--mca", "btl_tcp_if_include", "lo", "-np",
                  std::to_string(count), "-x", AsanOptionsOfRanks(std::getenv("ASAN_OPTIONS"))});
    if (last) {
      words.insert(words.end(), {"sh", "-c",
                                 "[ $OMPI_COMM_WORLD_RANK = " + std::to_string(count - 1) +
                                     " ] || exec \"$@\"; shift; exec env " + last->environment +
                                     " '" + last->program + "' \"$@\"",
                                 "sh"});
    }
    words.push_back(SKEIN_PROGRAM);
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
  }

  const ScratchDirectory scratch_;
};

}  // namespace skein
