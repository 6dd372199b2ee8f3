// SPDX-License-Identifier: Apache-2.0
// What libFuzzer calls (scripts/fuzz). SKEIN_FUZZ_TARGET names the reader; with SKEIN_FUZZ_SEEDS
// the program writes that reader's first files into that folder, and ends.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>

#include "src/files/output_file.h"
#include "tests/damage.h"
#include "tests/fuzz/fuzz_target.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace skein {
namespace {

const FuzzTarget& Chosen() {
  const char* const name = std::getenv("SKEIN_FUZZ_TARGET");
  std::string known;
  for (const FuzzTarget& target : FuzzTargets()) {
    if (name != nullptr && name == std::string(target.name)) return target;
    known += std::string(known.empty() ? "" : ", ") + target.name;
  }
  std::fprintf(stderr, "unknown target; known: %s\n", known.c_str());
  std::exit(2);
}

void WriteSeeds(const std::string& folder) {
  int number = 0;
  for (const std::string& seed : Chosen().seeds()) {
    WriteFile(folder + "/seed" + std::to_string(++number), seed);
  }
}

}  // namespace
}  // namespace skein

extern "C" {

int LLVMFuzzerInitialize(int*, char***) {
  skein::Chosen();
  if (const char* const folder = std::getenv("SKEIN_FUZZ_SEEDS")) {
    skein::WriteSeeds(folder);
    std::exit(0);
  }
  return 0;
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const skein::FuzzTarget& target = skein::Chosen();
  try {
    skein::Takes(target, {reinterpret_cast<const char*>(data), size});
  } catch (const std::exception& finding) {
    std::fprintf(stderr, "refused wrongly: %s\n", finding.what());
    std::abort();
  }
  return 0;
}

/// Half by libFuzzer, which knows what the coverage asks for, half by what damages texts; then, but
/// for one in eight, with lengths and checksums set right.
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                    unsigned seed) {
  const skein::FuzzTarget& target = skein::Chosen();
  most = std::min(most, target.max_bytes);
  size = std::min(size, most);
  std::string file;
  if (seed % 2 == 0) {
    size = LLVMFuzzerMutate(data, size, most);
    file.assign(reinterpret_cast<const char*>(data), size);
  } else {
    file = skein::Damage(seed).Of({reinterpret_cast<const char*>(data), size});
  }
  if (seed / 2 % 8 != 0) file = target.repaired(std::move(file));
  file.resize(std::min(file.size(), most));
  std::memcpy(data, file.data(), file.size());
  return file.size();
}

}  // extern "C"
