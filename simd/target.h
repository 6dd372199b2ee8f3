// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace skein::simd {

/// The instruction sets that kernels are built for: the first three on x86-64, kNeon on AArch64,
/// kScalar everywhere.
enum class Target { kAvx512, kAvx2, kSse4, kNeon, kScalar };

/// "avx512", "avx2", "sse4", "neon" or "scalar".
const char* Name(Target target);

/// Whether a multiply-add of kernels (hn::MulAdd) rounds once on `target`, not twice.
bool FusesMultiplyAdd(Target target);

/// The targets that this build contains and this CPU runs, best first. Never empty: the scalar
/// build always runs.
std::vector<Target> SupportedTargets();

/// The target that kernels use. The first call reads the environment variable SKEIN_SIMD (a name as
/// given by `Name`); unset or empty means the best supported one. Throws Error if the name is
/// unknown or the CPU does not support it.
Target ActiveTarget();

/// Whether products of bfloat16 (simd/matrix_product.h) take the instruction made for them: the
/// active target is avx512, the CPU has AVX512_BF16, and the compiler of this build knew it.
bool NativeBfloat16();

/// Whether that instruction is faster than multiply-adds of float32: AMD's (since Zen 4) does twice
/// as many in a cycle, Intel's half as many.
bool FastBfloat16();

/// Whether products of tiles of bfloat16 take the instruction made for them: the active target is
/// avx512, the CPU has AMX_BF16 and AVX512_BF16, Linux lets this process use it, and the compiler
/// of this build knew it.
bool NativeTiles();

/// Makes every kernel use `target` from now on (tests and benchmarks). Throws Error if it is not
/// supported. Not to be called while kernels run on other threads.
void ForceTarget(Target target);

}  // namespace skein::simd
