// SPDX-License-Identifier: Apache-2.0
// Lets the calls of a program on its files, and its allocations, fail, one after the other:
// whatever the call, no file is torn, the program says in one line what happened, and doing it
// again gives what it would have given at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/ends_with.h"
#include "src/files/output_file.h"
#include "src/run/run_directory.h"
#include "tests/error_message.h"
#include "tests/sanitizers.h"
#include "tests/scratch_directory.h"
#include "tests/src/faults/faulted_commands.h"
#include "tests/src/faults/faulted_program.h"
#include "tests/src/tiny_training.h"
#include "train/files/file_descriptor.h"
#include "train/files/tensor_file.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Arguments = std::vector<std::string>;
/// Contents by path below a folder.
using Files = std::map<std::string, std::string>;

/// What a command says that goes on without a lock.
constexpr const char* kNoLocks = ": its file system has no locks (No locks available): nothing";
constexpr const char* kOlder = "what an earlier command wrote\n";

/// Whether a file says when things happened, so that no two are equal.
bool TellsTime(const std::string& name) {
  const std::string file = fs::path(name).filename().string();
  return file == "log.txt" || file == "timing.csv" || file == "summary.json" || file == "lock" ||
         file.rfind("events.out.", 0) == 0 || EndsWith(file, kTemporaryExtension);
}

Files FilesIn(const std::string& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (entry.is_regular_file() && !TellsTime(name)) {
      files[name] = ReadFile(entry.path().string());
    }
  }
  return files;
}

bool IsPage(const std::string& name) { return EndsWith(name, ".html"); }

/// `name` of which times and process numbers are part without them.
std::string Untimed(std::string name) {
  if (!TellsTime(name)) return name;
  const auto is_digit = [](char letter) { return letter >= '0' && letter <= '9'; };
  name.erase(std::remove_if(name.begin(), name.end(), is_digit), name.end());
  return name;
}

/// All that a folder holds, in short; of files that say when things happened the sizes.
std::string StateIn(const std::string& folder) {
  std::map<std::string, std::string> entries;
  for (const auto& [name, bytes] : FilesIn(folder)) {
    if (!IsPage(name)) entries[name] = std::to_string(std::hash<std::string>()(bytes));
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string size = entry.is_regular_file() ? std::to_string(entry.file_size()) : "folder";
    entries[Untimed(fs::relative(entry.path(), folder).string())] += " " + size;
  }
  std::string state;
  for (const auto& [name, text] : entries) state += name + ":" + text + "\n";
  return state;
}

/// Pages say when they were made, and how long trainings took: of them the ends must be there.
bool IsSame(const std::string& name, const std::string& a, const std::string& b) {
  constexpr std::size_t kEnd = 64;
  if (!IsPage(name)) return a == b;
  return a.size() > kEnd && a.substr(0, kEnd) == b.substr(0, kEnd) &&
         EndsWith(b, a.substr(a.size() - kEnd));
}

void ExpectSameFiles(const Files& expected, const Files& files) {
  for (const auto& [name, bytes] : expected) {
    const auto found = files.find(name);
    if (found == files.end()) {
      ADD_FAILURE() << name << " is missing";
    } else {
      EXPECT_TRUE(IsSame(name, bytes, found->second)) << name << " differs";
    }
  }
  for (const auto& [name, bytes] : files) {
    EXPECT_TRUE(expected.count(name) == 1 || IsPage(name)) << name << " is left over";
  }
}

class Faults : public ::testing::TestWithParam<FaultedCommand> {
 protected:
  void SetUp() override {
    if (kIsSanitized) GTEST_SKIP() << "sanitizers have calls of their own in the way";
    if (GetParam().sample == 0 && !TriesAll()) GTEST_SKIP() << "slow: with the long tests alone";
    fs::create_directory(before_);
    GetParam().prepare(before_);
    Restart();
    const ProgramResult whole = RunSkein(Line());
    if (whole.error.find("made without Node") != std::string::npos) GTEST_SKIP() << whole.error;
    ASSERT_EQ(whole.exit_code, 0) << whole.error;
    after_ = FilesIn(work_);
    LeaveOlderOutputs();
    Restart();
  }

  void Restart() {
    fs::remove_all(work_);
    fs::copy(before_, work_, fs::copy_options::recursive);
  }

  Arguments Line() const { return GetParam().arguments(work_); }

  /// Of a command that replaces files: what it writes is there already, from an earlier time.
  void LeaveOlderOutputs() {
    const Files inputs = FilesIn(before_);
    const bool is_training = Line().front() == "train" || Line().front() == "study";
    for (const auto& [name, bytes] : after_) {
      if (!is_training && inputs.count(name) == 0) WriteFile(before_ + "/" + name, kOlder);
    }
    before_files_ = FilesIn(before_);
  }

  /// Each file is the older one, the newer one, or one between them that is whole.
  void ExpectNoTornFile() const {
    const Files files = FilesIn(work_);
    for (const auto& file : files) {
      const auto &name = file.first, &bytes = file.second;  // no bindings: a lambda reads them
      SCOPED_TRACE(name);
      const auto older = before_files_.find(name), newer = after_.find(name);
      if (older != before_files_.end() && older->second == bytes) continue;
      if (newer != after_.end() && IsSame(name, newer->second, bytes)) continue;
      if (EndsWith(name, "metrics.csv")) {
        EXPECT_EQ(after_.at(name).rfind(bytes, 0), 0u) << "rows are appended";
      } else if (EndsWith(name, ".skein")) {
        EXPECT_EQ(MessageOf([&] { TensorFile::Read(work_ + "/" + name); }), "");
      } else {
        ADD_FAILURE() << "is neither the older nor the newer file";
      }
    }
    for (const auto& [name, bytes] : before_files_) {
      EXPECT_TRUE(files.count(name) == 1 || after_.count(name) == 0) << name << " is gone";
    }
  }

  /// What is there after a command that ended well: a training that cannot write its page says so,
  /// and has done what it was for.
  Files Promised(const ProgramResult& result) const {
    Files promised = after_;
    if (result.output.find("\nreport          none: ") == std::string::npos) return promised;
    for (auto file = promised.begin(); file != promised.end();) {
      file = IsPage(file->first) ? promised.erase(file) : std::next(file);
    }
    return promised;
  }

  void ExpectHonestEnd(Fault fault, const ProgramResult& result) const {
    if (fault == Fault::kKilled) {
      EXPECT_EQ(result.signal, SIGKILL);
    } else if (result.exit_code == 0) {
      EXPECT_THAT(result.error, AnyOf("", AllOf(StartsWith("warning: "), HasSubstr(kNoLocks))));
      ExpectSameFiles(Promised(result), FilesIn(work_));
    } else {
      EXPECT_NE(fault, Fault::kShort);
      EXPECT_EQ(result.exit_code, 1) << "signal " << result.signal;
      ExpectOneLine(result.error, "");
    }
  }

  /// Does what a user would do next, without a fault; once from each state that a fault can leave.
  void ExpectRecovery() {
    if (!recovered_.insert(StateIn(work_)).second) return;
    Arguments line = Line();
    if (line.front() == "train") {
      if (IsRunDirectory(work_ + "/run")) {
        line = {"train", "--resume", work_ + "/run"};
      } else {
        fs::remove_all(work_ + "/run");
      }
    }
    const ProgramResult result = RunSkein(line);
    ASSERT_EQ(result.exit_code, 0) << result.error;
    ExpectSameFiles(after_, FilesIn(work_));
    for (const auto& entry : fs::recursive_directory_iterator(work_)) {
      EXPECT_NE(entry.path().extension(), kTemporaryExtension) << entry.path();
    }
  }

  void Try(Fault fault, std::size_t call, const std::string& what) {
    SCOPED_TRACE(std::string(Name(fault)) + ", call " + std::to_string(call) + ": " + what);
    Restart();
    const FaultedRun run = RunFaulted(Line(), work_, fault, call);
    ExpectNoTornFile();
    ExpectHonestEnd(fault, run.result);
    ExpectRecovery();
  }

  const ScratchDirectory scratch_;
  const std::string work_ = scratch_ / "work", before_ = scratch_ / "before";
  Files before_files_, after_;
  std::set<std::string> recovered_;  ///< states that were gone on from
};

/// The numbers of the calls that the fault can befall.
std::vector<std::size_t> CallsFor(Fault fault, const std::vector<std::string>& calls) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const bool moves_bytes = calls[i].rfind("read ", 0) == 0 || calls[i].rfind("write ", 0) == 0;
    if (fault != Fault::kShort || moves_bytes) numbers.push_back(i + 1);
  }
  return numbers;
}

/// "open 12, write 30".
std::string CountedByKind(const std::vector<std::string>& calls) {
  std::map<std::string, int> counts;
  for (const std::string& call : calls) ++counts[call.substr(0, call.find(' '))];
  std::string text;
  for (const auto& [kind, count] : counts) {
    text += (text.empty() ? "" : ", ") + kind + " " + std::to_string(count);
  }
  return text;
}

TEST_P(Faults, OfFilesLoseNothing) {
  const FaultedRun whole = RunFaulted(Line(), work_, Fault::kNone, 0);
  ASSERT_EQ(whole.result.exit_code, 0) << whole.result.error;
  ExpectSameFiles(after_, FilesIn(work_));
  ASSERT_FALSE(whole.calls.empty());
  int tried = 0;
  for (const Fault fault : {Fault::kFails, Fault::kFull, Fault::kShort, Fault::kKilled}) {
    const std::vector<std::size_t> calls = CallsFor(fault, whole.calls);
    for (const std::size_t place : Tried(calls.size(), GetParam().sample)) {
      const std::size_t call = calls[place - 1];
      ++tried;
      ASSERT_NO_FATAL_FAILURE(Try(fault, call, whole.calls[call - 1]));
    }
  }
  std::cout << GetParam().name << ": " << whole.calls.size() << " calls ("
            << CountedByKind(whole.calls) << "), " << tried << " faults\n";
}

TEST_P(Faults, OfMemoryLoseNothing) {
  if (!TriesAll()) GTEST_SKIP() << "slow: with the long tests alone";
  const FaultedRun whole = RunFaulted(Line(), work_, Fault::kMemory, 0);
  ASSERT_EQ(whole.result.exit_code, 0) << whole.result.error;
  ASSERT_EQ(whole.calls.size(), 1u);
  const std::size_t allocations = std::stoul(whole.calls[0].substr(whole.calls[0].find(' ')));
  // Too many to try each.
  constexpr std::size_t kTried = 200;
  int tried = 0;
  for (const Fault fault : {Fault::kMemory, Fault::kNoMemory}) {
    for (std::size_t part = 0; part < kTried; ++part) {
      ++tried;
      ASSERT_NO_FATAL_FAILURE(Try(fault, 1 + allocations * part / kTried, "allocation"));
    }
  }
  std::cout << GetParam().name << ": " << allocations << " allocations, " << tried << " faults\n";
}

/// A training of one iteration, of which the calls are known.
class ShortRun : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kIsSanitized) GTEST_SKIP() << "sanitizers have calls of their own in the way";
    whole_ = RunFaulted(line_, work_, Fault::kNone, 0);
    ASSERT_EQ(whole_.result.exit_code, 0) << whole_.result.error;
  }

  /// The number of the first such call from number `from` on, from 1; 0 if there is none.
  std::size_t CallNumber(const std::string& call, std::size_t from = 1) const {
    const auto begin = whole_.calls.begin(), end = whole_.calls.end();
    const auto found = std::find(begin + static_cast<std::ptrdiff_t>(from) - 1, end, call);
    return found == end ? 0 : static_cast<std::size_t>(found - begin) + 1;
  }

  const ScratchDirectory scratch_;
  const std::string work_ = scratch_ / "work", run_ = work_ + "/run";
  const Arguments line_ = TinyTraining(run_, {"--steps", std::to_string(kStepsPerIteration)});
  FaultedRun whole_;
};

TEST_F(ShortRun, WithoutLocksIsWarnedOfAndGoesOn) {
  const std::size_t lock = CallNumber("flock " + run_ + "/lock");
  ASSERT_GT(lock, 0u);
  fs::remove_all(work_);
  const ProgramResult result = RunFaulted(line_, work_, Fault::kFails, lock).result;
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.error, StartsWith("warning: " + run_ + kNoLocks));
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
}

TEST_F(ShortRun, HasTheNamesOfItsRecordsOnDiskBeforeItsCheckpoint) {
  const std::size_t begun = CallNumber("write " + run_ + "/timing.csv");  // after metrics.csv
  ASSERT_GT(begun, 0u);
  const std::size_t synced = CallNumber("fsync " + run_, begun);
  ASSERT_GT(synced, 0u);
  EXPECT_LT(synced, CallNumber("rename " + run_ + "/checkpoints/checkpoint-000001.skein"));
}

INSTANTIATE_TEST_SUITE_P(Of, Faults, ::testing::ValuesIn(FaultedCommands()),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace skein
