// SPDX-License-Identifier: Apache-2.0
#include "simd/target.h"

#include <cpuid.h>
#include <hwy/targets.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>

#include "base/error.h"

namespace skein::simd {
namespace {

static_assert(HWY_TARGETS == (HWY_AVX3 | HWY_AVX2 | HWY_SSE4 | HWY_SCALAR),
              "Highway's targets are chosen by the compile definitions in simd/CMakeLists.txt");

constexpr Target kAllTargets[] = {Target::kAvx512, Target::kAvx2, Target::kSse4, Target::kScalar};

std::int64_t HighwayTarget(Target target) {
  switch (target) {
    case Target::kAvx512:
      return HWY_AVX3;
    case Target::kAvx2:
      return HWY_AVX2;
    case Target::kSse4:
      return HWY_SSE4;
    case Target::kScalar:
      break;
  }
  return HWY_SCALAR;
}

bool IsSupported(Target target) {
  const std::int64_t bit = HighwayTarget(target);
  if ((HWY_TARGETS & bit) == 0) return false;
  // The scalar build needs nothing of the CPU; libhwy may have been built to report EMU128 instead.
  return target == Target::kScalar || (hwy::SupportedTargets() & bit) != 0;
}

std::string SupportedNames() {
  std::string names;
  for (const Target target : SupportedTargets()) {
    names += (names.empty() ? "" : ", ") + std::string(Name(target));
  }
  return names;
}

void RequireSupported(Target target, const std::string& origin) {
  if (!IsSupported(target)) {
    throw Error(origin + ": SIMD target \"" + Name(target) +
                "\" is not supported by this CPU and build; supported: " + SupportedNames());
  }
}

/// What SKEIN_SIMD asks for, or the best supported target.
Target RequestedTarget() {
  const char* const variable = std::getenv("SKEIN_SIMD");
  if (variable == nullptr || *variable == '\0') return SupportedTargets().front();
  for (const Target target : kAllTargets) {
    if (variable == std::string(Name(target))) {
      RequireSupported(target, "SKEIN_SIMD");
      return target;
    }
  }
  throw Error("SKEIN_SIMD: unknown SIMD target \"" + std::string(variable) +
              "\"; one of: " + SupportedNames());
}

/// Points Highway's dispatch tables at `target`.
Target Install(Target target) {
  hwy::GetChosenTarget().Update(HighwayTarget(target));
  return target;
}

std::atomic<Target>& Current() {
  static std::atomic<Target> current{Install(RequestedTarget())};
  return current;
}

#ifdef SKEIN_NATIVE_BFLOAT16
bool CpuHasBfloat16() {
  unsigned eax = 0, ebx = 0, ecx = 0, edx = 0;
  constexpr unsigned kExtendedFeatures = 7, kSecondLeaf = 1, kAvx512Bf16 = 1u << 5;
  return __get_cpuid_count(kExtendedFeatures, kSecondLeaf, &eax, &ebx, &ecx, &edx) != 0 &&
         (eax & kAvx512Bf16) != 0;
}
#else
bool CpuHasBfloat16() { return false; }
#endif

}  // namespace

const char* Name(Target target) {
  switch (target) {
    case Target::kAvx512:
      return "avx512";
    case Target::kAvx2:
      return "avx2";
    case Target::kSse4:
      return "sse4";
    case Target::kScalar:
      break;
  }
  return "scalar";
}

std::vector<Target> SupportedTargets() {
  std::vector<Target> supported;
  for (const Target target : kAllTargets) {
    if (IsSupported(target)) supported.push_back(target);
  }
  return supported;
}

Target ActiveTarget() { return Current().load(std::memory_order_relaxed); }

bool NativeBfloat16() {
  static const bool cpu_has_it = CpuHasBfloat16();
  return cpu_has_it && ActiveTarget() == Target::kAvx512;
}

void ForceTarget(Target target) {
  RequireSupported(target, "ForceTarget");
  Current().store(Install(target), std::memory_order_relaxed);
}

}  // namespace skein::simd
