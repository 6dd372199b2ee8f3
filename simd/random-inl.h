// SPDX-License-Identifier: Apache-2.0
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
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
/// The keys of Philox's rounds: the same for all counters of a seed.
struct PhiloxKeys {
  explicit PhiloxKeys(std::uint64_t seed) {
    std::uint32_t key0 = static_cast<std::uint32_t>(seed);
    std::uint32_t key1 = static_cast<std::uint32_t>(seed >> 32);
    for (int k = 0; k < simd::philox::kRounds; ++k) {
      round[k][0] = key0;
      round[k][1] = key1;
      key0 += simd::philox::kWeyl0;
      key1 += simd::philox::kWeyl1;
    }
  }
  std::uint32_t round[simd::philox::kRounds][2];
};

#if HWY_TARGET == HWY_SCALAR
/// Philox4x32 on vectors: one counter (x[0..3][block]) per lane and block. The same bits as
/// simd::Philox4x32.
template <int kBlocks, class DU, class VU = hn::Vec<DU>>
HWY_INLINE void PhiloxLanes(DU du, const PhiloxKeys& keys, VU (&x)[4][kBlocks]) {
  for (int block = 0; block < kBlocks; ++block) {
    const auto words = simd::Philox4x32({hn::GetLane(x[0][block]), hn::GetLane(x[1][block]),
                                         hn::GetLane(x[2][block]), hn::GetLane(x[3][block])},
                                        {keys.round[0][0], keys.round[0][1]});
    for (int k = 0; k < 4; ++k) x[k][block] = hn::Set(du, words[static_cast<std::size_t>(k)]);
  }
}
#else
/// Ten rounds on the even lanes of x; odd lanes end as anything.
template <int kBlocks, class DU, class VU = hn::Vec<DU>>
HWY_INLINE void PhiloxEvenLanes(DU du, const PhiloxKeys& keys, VU (&x)[4][kBlocks]) {
  const VU factor0 = hn::Set(du, simd::philox::kMultiplier0);
  const VU factor1 = hn::Set(du, simd::philox::kMultiplier1);
  for (const auto& key : keys.round) {
    const VU key0 = hn::Set(du, key[0]), key1 = hn::Set(du, key[1]);
    for (int k = 0; k < kBlocks; ++k) {
      // Products of 64 bits: the low half is in place, the high half goes there by a shift.
      const auto product0 = hn::MulEven(x[0][k], factor0);
      const auto product1 = hn::MulEven(x[2][k], factor1);
      x[0][k] = hn::Xor(hn::BitCast(du, hn::ShiftRight<32>(product1)), hn::Xor(x[1][k], key0));
      x[1][k] = hn::BitCast(du, product1);
      x[2][k] = hn::Xor(hn::BitCast(du, hn::ShiftRight<32>(product0)), hn::Xor(x[3][k], key1));
      x[3][k] = hn::BitCast(du, product0);
    }
  }
}

/// Philox4x32 on vectors: one counter (x[0..3][block]) per lane and block. The same bits as
/// simd::Philox4x32. Blocks go side by side, since the rounds of one are a chain.
template <int kBlocks, class DU, class VU = hn::Vec<DU>>
HWY_INLINE void PhiloxLanes(DU du, const PhiloxKeys& keys, VU (&x)[4][kBlocks]) {
  const hn::RepartitionToWide<DU> du64;
  VU odd[4][kBlocks];
  for (int word = 0; word < 4; ++word) {
    for (int k = 0; k < kBlocks; ++k) {
      odd[word][k] = hn::BitCast(du, hn::ShiftRight<32>(hn::BitCast(du64, x[word][k])));
    }
  }
  PhiloxEvenLanes(du, keys, x);
  PhiloxEvenLanes(du, keys, odd);
  for (int word = 0; word < 4; ++word) {
    for (int k = 0; k < kBlocks; ++k) {
      const VU shifted = hn::BitCast(du, hn::ShiftLeft<32>(hn::BitCast(du64, odd[word][k])));
      x[word][k] = hn::OddEven(shifted, x[word][k]);
    }
  }
}
#endif

/// Two independent standard normal deviates per lane (Box and Muller) from the upper 24 bits of
/// `radius_bits` and from `angle_bits`, which are independent.
template <class D, class V = hn::Vec<D>, class VU>
HWY_INLINE void BoxMuller(D d, VU radius_bits, VU angle_bits, V& first, V& second) {
  const hn::RebindToSigned<D> di;
  constexpr float kUnit = 0x1.0p-24f;
  // In (0, 1]: the logarithm is finite, and 24 bits keep every value exact.
  const V radius_uniform =
      hn::MulAdd(hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<8>(radius_bits))),
                 hn::Set(d, kUnit), hn::Set(d, kUnit));
  // The square root by its reciprocal estimate, which a zero must not reach.
  const V square = hn::Max(hn::Mul(hn::Set(d, -2.0f), Log(d, radius_uniform)), hn::Set(d, 1e-30f));
  const V radius = hn::Mul(square, ReciprocalSqrt(d, square));
  V sine, cosine;
  SinCosOfBits(d, angle_bits, sine, cosine);
  first = hn::Mul(radius, cosine);
  second = hn::Mul(radius, sine);
}

/// The counters of blocks [first_block, first_block + kBlocks) of the streams (a, b, c, purpose).
template <int kBlocks, class DU, class VU = hn::Vec<DU>>
HWY_INLINE void SetCounters(DU du, VU a, VU b, VU c, simd::RandomPurpose purpose,
                            std::uint32_t first_block, VU (&x)[4][kBlocks]) {
  for (int k = 0; k < kBlocks; ++k) {
    const std::uint32_t block = first_block + static_cast<std::uint32_t>(k);
    x[0][k] = a;
    x[1][k] = b;
    x[2][k] = c;
    x[3][k] = hn::Set(du, static_cast<std::uint32_t>(purpose) | block << 8);
  }
}

/// Four independent standard normal deviates per lane from block `block` of the streams (a, b, c,
/// purpose): two words to a pair.
template <class D, class V = hn::Vec<D>, class VU>
HWY_INLINE void NormalBlock(D d, const PhiloxKeys& keys, VU a, VU b, VU c,
                            simd::RandomPurpose purpose, std::uint32_t block, V (&normals)[4]) {
  const hn::RebindToUnsigned<D> du;
  VU x[4][1];
  SetCounters(du, a, b, c, purpose, block, x);
  PhiloxLanes(du, keys, x);
  BoxMuller(d, x[0][0], x[1][0], normals[0], normals[1]);
  BoxMuller(d, x[2][0], x[3][0], normals[2], normals[3]);
}

/// The first word of each stream (a, b, c, purpose) as a uniform number in [0, 1): what
/// simd::UniformFromBits makes of it.
template <class D, class V = hn::Vec<D>, class VU>
HWY_INLINE V FirstUniform(D d, const PhiloxKeys& keys, VU a, VU b, VU c,
                          simd::RandomPurpose purpose) {
  const hn::RebindToSigned<D> di;
  const hn::RebindToUnsigned<D> du;
  VU x[4][1];
  SetCounters(du, a, b, c, purpose, 0, x);
  PhiloxLanes(du, keys, x);
  return hn::Mul(hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<8>(x[0][0]))),
                 hn::Set(d, 0x1.0p-24f));
}

/// 8 kBlocks coarse normal deviates per lane from the first blocks of the streams (a, b, c,
/// purpose), for noise: one word to a pair. Radius and angle have 16 bits each, so that no
/// magnitude exceeds 4.86; moments and tails up to 4 are those of a normal to 1e-4.
template <int kBlocks, class D, class V = hn::Vec<D>, class VU>
HWY_INLINE void CoarseNormals(D d, const PhiloxKeys& keys, VU a, VU b, VU c,
                              simd::RandomPurpose purpose, V (&normals)[8 * kBlocks]) {
  const hn::RebindToUnsigned<D> du;
  VU x[4][kBlocks];
  SetCounters(du, a, b, c, purpose, 0, x);
  PhiloxLanes(du, keys, x);
  // The middle of the 2^-16 that the upper half stands for.
  const VU upper = hn::Set(du, 0xffff0000u), middle = hn::Set(du, 0x8000u);
  for (int k = 0; k < kBlocks; ++k) {
    for (int word = 0; word < 4; ++word) {
      const VU radius_bits = hn::Or(hn::And(x[word][k], upper), middle);
      V* const pair = normals + 8 * k + 2 * word;
      BoxMuller(d, radius_bits, hn::ShiftLeft<16>(x[word][k]), pair[0], pair[1]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // include guard per target
