#include "src/machine.h"

#include <sched.h>

#include <fstream>

#include "simd/target.h"

namespace skein {
namespace {

int UsableCpus() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof(set), &set) == 0 ? CPU_COUNT(&set) : 1;
}

}  // namespace

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
  return {{"version", SKEIN_VERSION},       {"compiler", SKEIN_COMPILER},
          {"build_type", SKEIN_BUILD_TYPE}, {"cpu", CpuName()},
          {"threads", UsableCpus()},        {"simd", Name(simd::ActiveTarget())},
          {"simd_supported", supported},    {"libtorch", SKEIN_LIBTORCH_VERSION}};
}

}  // namespace skein
