// SPDX-License-Identifier: Apache-2.0
#include "src/bench/machine.h"

#include <fmt/format.h>

#include <fstream>

#include "simd/target.h"
#include "src/bench/version.h"
#include "src/files/text_table.h"
#include "train/network/backend.h"
#include "train/network/backend_module.h"

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

std::string DescribeWorkers(const WorkerPool& pool) {
  return fmt::format("SIMD target {}, {}", Name(simd::ActiveTarget()),
                     Counted(pool.threads(), "thread"));
}

std::string DescribeProgram() {
  const BuildInfo& build = Build();
  return fmt::format("version {} of commit {} by {}, SIMD target {}", build.version, build.commit,
                     build.compiler, Name(simd::ActiveTarget()));
}

nlohmann::ordered_json DescribeMachine() {
  const std::string libtorch = LibTorchVersion();
  auto supported = nlohmann::ordered_json::array();
  for (const simd::Target target : simd::SupportedTargets()) supported.push_back(Name(target));
  return {
      {"version", Build().version},
      {"commit", Build().commit},
      {"compiler", Build().compiler},
      {"build_type", Build().type},
      {"cpu", CpuName()},
      {"threads", WorkerPool().threads()},
      {"simd", Name(simd::ActiveTarget())},
      {"simd_supported", supported},
      {"native_bf16", simd::NativeBfloat16()},
      {"native_amx", simd::NativeTiles()},
      {"precision", Name(DefaultPrecision())},
      {"libtorch", libtorch.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(libtorch)}};
}

}  // namespace skein
