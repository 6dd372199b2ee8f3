// SPDX-License-Identifier: Apache-2.0
#include "src/bench/machine.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <istream>

#include "simd/target.h"
#include "src/bench/version.h"
#include "src/files/text_table.h"
#include "train/network/backend.h"
#include "train/network/backend_module.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

std::optional<int> WholeNumber(const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

Json NullIfUnsaid(const std::optional<int>& number) { return number ? Json(*number) : Json(); }

}  // namespace

CpuFacts ReadCpuFacts(std::istream& cpuinfo) {
  CpuFacts facts;
  // "key<tab>: value"; an empty line ends a processor.
  for (std::string line; std::getline(cpuinfo, line) && !line.empty();) {
    const auto colon = line.find(": ");
    if (colon == std::string::npos) continue;
    const std::string key = line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1);
    const std::string value = line.substr(colon + 2);
    if (key == "model name") facts.name = value;
    if (key == "cpu family") facts.family = WholeNumber(value);
    if (key == "model") facts.model = WholeNumber(value);
    if (key == "stepping") facts.stepping = WholeNumber(value);
  }
  return facts;
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

Json ProgramJson() {
  const BuildInfo& build = Build();
  return {{"version", build.version},
          {"commit", build.commit},
          {"compiler", build.compiler},
          {"simd", Name(simd::ActiveTarget())}};
}

Json DescribeMachine() {
  const std::string libtorch = LibTorchVersion(), blas = LibTorchBlas();
  std::ifstream cpuinfo("/proc/cpuinfo");
  const CpuFacts cpu = ReadCpuFacts(cpuinfo);
  Json supported = Json::array();
  for (const simd::Target target : simd::SupportedTargets()) supported.push_back(Name(target));
  return {{"version", Build().version},
          {"commit", Build().commit},
          {"compiler", Build().compiler},
          {"build_type", Build().type},
          {"cpu", cpu.name},
          {"cpu_family", NullIfUnsaid(cpu.family)},
          {"cpu_model", NullIfUnsaid(cpu.model)},
          {"cpu_stepping", NullIfUnsaid(cpu.stepping)},
          {"threads", WorkerPool().threads()},
          {"simd", Name(simd::ActiveTarget())},
          {"simd_supported", supported},
          {"native_bf16", simd::NativeBfloat16()},
          {"native_amx", simd::NativeTiles()},
          {"precision", Name(DefaultPrecision())},
          {"libtorch", libtorch.empty() ? Json() : Json(libtorch)},
          {"libtorch_openblas", blas.empty() ? Json() : Json(blas)}};
}

}  // namespace skein
