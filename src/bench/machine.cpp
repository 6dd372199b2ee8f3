// SPDX-License-Identifier: Apache-2.0
#include "src/bench/machine.h"

#include <fstream>

#include "base/worker_pool.h"
#include "simd/target.h"
#include "train/network/backend.h"

namespace skein {

std::string CpuName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, 10, "model name") != 0) continue;
    const auto colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

nlohmann::ordered_json DescribeMachine() {
  auto supported = nlohmann::ordered_json::array();
  for (const simd::Target target : simd::SupportedTargets()) supported.push_back(Name(target));
  return {{"version", SKEIN_VERSION},
          {"compiler", SKEIN_COMPILER},
          {"build_type", SKEIN_BUILD_TYPE},
          {"cpu", CpuName()},
          {"threads", WorkerPool().threads()},
          {"simd", Name(simd::ActiveTarget())},
          {"simd_supported", supported},
          {"native_bf16", simd::NativeBfloat16()},
          {"precision", Name(DefaultPrecision())},
          {"libtorch", SKEIN_LIBTORCH_VERSION}};
}

}  // namespace skein
