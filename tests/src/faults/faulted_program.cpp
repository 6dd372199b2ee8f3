// SPDX-License-Identifier: Apache-2.0
#include "tests/src/faults/faulted_program.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "src/files/output_file.h"

namespace skein {

const char* Name(Fault fault) {
  switch (fault) {
    case Fault::kNone:
      return "no fault";
    case Fault::kFails:
      return "one call fails";
    case Fault::kFull:
      return "the disk is full from one call on";
    case Fault::kShort:
      return "one read or write stops half way";
    case Fault::kKilled:
      return "killed in one call";
    case Fault::kMemory:
      return "one allocation fails";
    case Fault::kNoMemory:
      return "no memory from one allocation on";
  }
  return "";
}

FaultedRun RunFaulted(const std::vector<std::string>& arguments, const std::string& below,
                      Fault fault, std::size_t at) {
  const ScratchDirectory scratch;
  const std::string record = scratch / "calls", temporary = below + "-temporary";
  std::filesystem::create_directories(temporary);
  const auto prepare = [&] {
    setenv("LD_PRELOAD", SKEIN_FAILING_CALLS, 1);
    setenv("SKEIN_FAULT", std::string(1, static_cast<char>(fault)).c_str(), 1);
    setenv("SKEIN_FAULT_AT", std::to_string(at).c_str(), 1);
    setenv("SKEIN_FAULT_BELOW", below.c_str(), 1);
    setenv("SKEIN_FAULT_RECORD", record.c_str(), 1);
    setenv("TMPDIR", temporary.c_str(), 1);
  };
  FaultedRun run;
  run.result = RunSkein(arguments, prepare);
  std::istringstream lines(ReadFile(record));
  for (std::string line; std::getline(lines, line);) run.calls.push_back(line);
  return run;
}

bool TriesAll() {
  const char* const choice = std::getenv("SKEIN_FAULTS");
  return choice != nullptr && choice == std::string("all");
}

std::vector<std::size_t> Tried(std::size_t last, std::size_t sample) {
  const std::size_t count = TriesAll() ? last : std::min(sample, last);
  std::vector<std::size_t> numbers;
  for (std::size_t i = 1; i <= count; ++i) numbers.push_back(last * (2 * i - 1) / (2 * count) + 1);
  return numbers;
}

}  // namespace skein
