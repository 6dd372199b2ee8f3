// SPDX-License-Identifier: Apache-2.0
#include "simd/target.h"

#include <hwy/targets.h>

#ifdef SKEIN_NATIVE_TILES
#include <cpuid.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include <atomic>
#include <cstdint>
#include <cstdlib>

#include "base/choice_error.h"

namespace skein::simd {
namespace {

// Kernels use nothing that NEON has with AES alone, which later Highways tell apart.
#ifdef HWY_NEON_WITHOUT_AES
constexpr std::int64_t kHighwayNeon = HWY_NEON_WITHOUT_AES;
#else
constexpr std::int64_t kHighwayNeon = HWY_NEON;
#endif

struct TargetFacts {
  Target target;
  const char* name;
  std::int64_t highway;  // Highway's bit for it
  bool fuses_multiply_add;
};

/// As Target numbers them, best first.
constexpr TargetFacts kTargets[] = {{Target::kAvx512, "avx512", HWY_AVX3, true},
                                    {Target::kAvx2, "avx2", HWY_AVX2, true},
                                    {Target::kSse4, "sse4", HWY_SSE4, false},
                                    {Target::kNeon, "neon", kHighwayNeon, true},
                                    {Target::kScalar, "scalar", HWY_SCALAR, false}};

constexpr std::int64_t KnownToHighway() {
  std::int64_t bits = 0;
  for (const TargetFacts& facts : kTargets) bits |= facts.highway;
  return bits;
}

// The compile definitions in simd/CMakeLists.txt see to it.
static_assert((HWY_TARGETS & ~KnownToHighway()) == 0, "kernels are built for a nameless target");
static_assert((HWY_TARGETS & HWY_SCALAR) != 0, "kernels are not built for the scalar target");

const TargetFacts& FactsOf(Target target) { return kTargets[static_cast<int>(target)]; }

bool IsSupported(Target target) {
  const std::int64_t bit = FactsOf(target).highway;
  if ((HWY_TARGETS & bit) == 0) return false;
  // What the whole program is compiled for needs no question to the CPU. That has the scalar build,
  // which libhwy may have been built to report as EMU128.
  if ((HWY_BASELINE_TARGETS & bit) != 0) return true;
  static const std::int64_t of_cpu = hwy::SupportedTargets();
  return (of_cpu & bit) != 0;
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
    throw ChoiceError(origin + ": SIMD target \"" + Name(target) +
                      "\" is not supported by this CPU and build; supported: " + SupportedNames());
  }
}

/// What SKEIN_SIMD asks for, or the best supported target.
Target RequestedTarget() {
  const char* const variable = std::getenv("SKEIN_SIMD");
  if (variable == nullptr || *variable == '\0') return SupportedTargets().front();
  for (const TargetFacts& facts : kTargets) {
    if (variable == std::string(facts.name)) {
      RequireSupported(facts.target, "SKEIN_SIMD");
      return facts.target;
    }
  }
  throw ChoiceError("SKEIN_SIMD: unknown SIMD target \"" + std::string(variable) +
                    "\"; one of: " + SupportedNames());
}

/// Points Highway's dispatch tables at `target`.
Target Install(Target target) {
  hwy::GetChosenTarget().Update(FactsOf(target).highway);
  return target;
}

std::atomic<Target>& Current() {
  static std::atomic<Target> current{Install(RequestedTarget())};
  return current;
}

#ifdef SKEIN_NATIVE_BFLOAT16
bool CpuHasBfloat16() { return __builtin_cpu_supports("avx512bf16") != 0; }
#else
bool CpuHasBfloat16() { return false; }
#endif

#ifdef SKEIN_NATIVE_TILES
/// Linux keeps tiles, 8 kB of a thread's state, from processes that have not asked for them.
bool AskForTiles() {
  constexpr long kRequestPermission = 0x1023, kTileData = 18;  // ARCH_REQ_XCOMP_PERM, XTILEDATA
  return syscall(SYS_arch_prctl, kRequestPermission, kTileData) == 0;
}
bool MayUseTiles() {
  // Not every compiler's __builtin_cpu_supports knows their names.
  constexpr unsigned kFeatures = 7, kAmxBf16 = 1u << 22, kAmxTile = 1u << 24;  // in edx
  unsigned eax = 0, ebx = 0, ecx = 0, edx = 0;
  if (__get_cpuid_count(kFeatures, 0, &eax, &ebx, &ecx, &edx) == 0) return false;
  const bool has_tiles = (edx & kAmxBf16) != 0 && (edx & kAmxTile) != 0;
  return CpuHasBfloat16() && has_tiles && AskForTiles();
}
#else
bool MayUseTiles() { return false; }
#endif

}  // namespace

const char* Name(Target target) { return FactsOf(target).name; }

bool FusesMultiplyAdd(Target target) { return FactsOf(target).fuses_multiply_add; }

std::vector<Target> SupportedTargets() {
  std::vector<Target> supported;
  for (const TargetFacts& facts : kTargets) {
    if (IsSupported(facts.target)) supported.push_back(facts.target);
  }
  return supported;
}

Target ActiveTarget() { return Current().load(std::memory_order_relaxed); }

bool NativeBfloat16() {
  static const bool cpu_has_it = CpuHasBfloat16();
  return cpu_has_it && ActiveTarget() == Target::kAvx512;
}

bool FastBfloat16() {
#ifdef SKEIN_NATIVE_BFLOAT16
  static const bool is_intel = __builtin_cpu_is("intel") != 0;
  return NativeBfloat16() && !is_intel;
#else
  return false;
#endif
}

bool NativeTiles() {
  static const bool may_use_them = MayUseTiles();
  return may_use_them && ActiveTarget() == Target::kAvx512;
}

void ForceTarget(Target target) {
  RequireSupported(target, "ForceTarget");
  Current().store(Install(target), std::memory_order_relaxed);
}

}  // namespace skein::simd
