// Philox4x32-10 and Box-Muller on vectors, for kernels (see simd/dispatch.h).

#include <cstdint>

#include "simd/random.h"

#if defined(SKEIN_SIMD_RANDOM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_SIMD_RANDOM_INL_H_
#undef SKEIN_SIMD_RANDOM_INL_H_
#else
#define SKEIN_SIMD_RANDOM_INL_H_
#endif

#include <hwy/highway.h>

#include "simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// High and low 32 bits of the products a * factor, lane by lane.
template <class DU, class VU = hn::Vec<DU>>
HWY_INLINE void MultiplyHighLow(DU du, VU a, std::uint32_t factor, VU& high, VU& low) {
#if HWY_TARGET == HWY_SCALAR
  const std::uint64_t product = std::uint64_t{hn::GetLane(a)} * factor;
  high = hn::Set(du, static_cast<std::uint32_t>(product >> 32));
  low = hn::Set(du, static_cast<std::uint32_t>(product));
#else
  const hn::RepartitionToWide<DU> du64;
  const VU factors = hn::Set(du, factor);
  const auto even = hn::MulEven(a, factors);
  const auto odd = hn::MulEven(hn::BitCast(du, hn::ShiftRight<32>(hn::BitCast(du64, a))), factors);
  high = hn::OddEven(hn::BitCast(du, odd), hn::BitCast(du, hn::ShiftRight<32>(even)));
  low = hn::OddEven(hn::BitCast(du, hn::ShiftLeft<32>(odd)), hn::BitCast(du, even));
#endif
}

/// Philox4x32 on vectors: one counter (x[0..3][block]) per lane and block, one key for all. The
/// same bits as simd::Philox4x32. Blocks go side by side, since the rounds of one are a chain.
template <int kBlocks, class DU, class VU = hn::Vec<DU>>
HWY_INLINE void PhiloxLanes(DU du, std::uint64_t key, VU (&x)[4][kBlocks]) {
  std::uint32_t key0 = static_cast<std::uint32_t>(key);
  std::uint32_t key1 = static_cast<std::uint32_t>(key >> 32);
  for (int round = 0; round < simd::philox::kRounds; ++round) {
    const VU round_key0 = hn::Set(du, key0), round_key1 = hn::Set(du, key1);
    for (int k = 0; k < kBlocks; ++k) {
      VU high0, low0, high1, low1;
      MultiplyHighLow(du, x[0][k], simd::philox::kMultiplier0, high0, low0);
      MultiplyHighLow(du, x[2][k], simd::philox::kMultiplier1, high1, low1);
      x[0][k] = hn::Xor(hn::Xor(high1, x[1][k]), round_key0);
      x[1][k] = low1;
      x[2][k] = hn::Xor(hn::Xor(high0, x[3][k]), round_key1);
      x[3][k] = low0;
    }
    key0 += simd::philox::kWeyl0;
    key1 += simd::philox::kWeyl1;
  }
}

/// Two independent standard normal deviates per lane from two independent random words.
template <class D, class V = hn::Vec<D>, class VU>
HWY_INLINE void BoxMuller(D d, VU radius_bits, VU angle_bits, V& first, V& second) {
  const hn::RebindToSigned<D> di;
  constexpr float kUnit = 0x1.0p-24f;
  // In (0, 1]: the logarithm is finite, and 24 bits keep every value exact.
  const V radius_uniform =
      hn::MulAdd(hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<8>(radius_bits))),
                 hn::Set(d, kUnit), hn::Set(d, kUnit));
  const V turns =
      hn::Mul(hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<8>(angle_bits))), hn::Set(d, kUnit));
  // The square root by its reciprocal estimate, which a zero must not reach.
  const V square = hn::Max(hn::Mul(hn::Set(d, -2.0f), Log(d, radius_uniform)), hn::Set(d, 1e-30f));
  const V radius = hn::Mul(square, ReciprocalSqrt(d, square));
  constexpr float kPi = 3.14159265358979f;
  V sine, cosine;
  SinCos(d, hn::MulAdd(turns, hn::Set(d, 2 * kPi), hn::Set(d, -kPi)), sine, cosine);
  first = hn::Mul(radius, cosine);
  second = hn::Mul(radius, sine);
}

/// 4 kBlocks independent standard normal deviates per lane: blocks [first_block, first_block +
/// kBlocks) of the streams (seed, a, b, c, purpose).
template <int kBlocks, class D, class V = hn::Vec<D>, class VU>
HWY_INLINE void NormalBlocks(D d, std::uint64_t seed, VU a, VU b, VU c, simd::RandomPurpose purpose,
                             std::uint32_t first_block, V (&normals)[4 * kBlocks]) {
  const hn::RebindToUnsigned<D> du;
  VU x[4][kBlocks];
  for (int k = 0; k < kBlocks; ++k) {
    const std::uint32_t block = first_block + static_cast<std::uint32_t>(k);
    x[0][k] = a;
    x[1][k] = b;
    x[2][k] = c;
    x[3][k] = hn::Set(du, static_cast<std::uint32_t>(purpose) | block << 8);
  }
  PhiloxLanes(du, seed, x);
  for (int k = 0; k < kBlocks; ++k) {
    BoxMuller(d, x[0][k], x[1][k], normals[4 * k], normals[4 * k + 1]);
    BoxMuller(d, x[2][k], x[3][k], normals[4 * k + 2], normals[4 * k + 3]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // include guard per target
