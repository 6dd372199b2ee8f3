// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/src/run_program.h"

namespace skein {

/// What goes wrong in one call (failing_calls.cpp); the letters are what that file reads.
enum class Fault : char {
  kNone = 'n',
  kFails = 'f',
  kFull = 'u',
  kShort = 's',
  kKilled = 'k',
  kMemory = 'm',
  kNoMemory = 'o',
};

/// For people: "one call fails".
const char* Name(Fault fault);

/// A run of skein of which the calls were counted.
struct FaultedRun {
  ProgramResult result;
  /// "write /tmp/.../metrics.csv" for every call on a file below the folder, in their order; of
  /// kMemory the one line "allocations N", if the program came to its end.
  std::vector<std::string> calls;
};

/// Runs skein with `fault` in its call number `at` (from 1; 0: in none) on files whose paths begin
/// with `below`, a folder; its temporary files, in the folder `below`-temporary, are among them. Of
/// kMemory and kNoMemory the fault is in that allocation.
FaultedRun RunFaulted(const std::vector<std::string>& arguments, const std::string& below,
                      Fault fault, std::size_t at);

/// Whether every fault is to be tried: SKEIN_FAULTS=all.
bool TriesAll();

/// Of the numbers 1 to `last` those to try: all if TriesAll, else `sample` of them, spread evenly.
std::vector<std::size_t> Tried(std::size_t last, std::size_t sample);

}  // namespace skein
