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

/// high and low 32 bits of the products a * b, lane by lane.
template <class DU, class VU = hn::Vec<DU>>
HWY_INLINE void MultiplyHighLow(DU du, VU a, VU b, VU& high, VU& low) {
#if HWY_TARGET == HWY_SCALAR
  const std::uint64_t product = std::uint64_t{hn::GetLane(a)} * hn::GetLane(b);
  high = hn::Set(du, static_cast<std::uint32_t>(product >> 32));
  low = hn::Set(du, static_cast<std::uint32_t>(product));
#else
  const hn::RepartitionToWide<DU> du64;
  const auto even = hn::MulEven(a, b);
  const auto odd = hn::MulEven(hn::BitCast(du, hn::ShiftRight<32>(hn::BitCast(du64, a))),
                               hn::BitCast(du, hn::ShiftRight<32>(hn::BitCast(du64, b))));
  high = hn::OddEven(hn::BitCast(du, odd), hn::BitCast(du, hn::ShiftRight<32>(even)));
  low = hn::OddEven(hn::BitCast(du, hn::ShiftLeft<32>(odd)), hn::BitCast(du, even));
#endif
}

/// Philox4x32 on vectors: one counter (x0..x3) per lane, one key for all. The same bits as
/// simd::Philox4x32.
template <class DU, class VU = hn::Vec<DU>>
HWY_INLINE void PhiloxLanes(DU du, std::uint64_t key, VU& x0, VU& x1, VU& x2, VU& x3) {
  std::uint32_t key0 = static_cast<std::uint32_t>(key);
  std::uint32_t key1 = static_cast<std::uint32_t>(key >> 32);
  const VU multiplier0 = hn::Set(du, simd::philox::kMultiplier0);
  const VU multiplier1 = hn::Set(du, simd::philox::kMultiplier1);
  for (int round = 0; round < simd::philox::kRounds; ++round) {
    VU high0, low0, high1, low1;
    MultiplyHighLow(du, x0, multiplier0, high0, low0);
    MultiplyHighLow(du, x2, multiplier1, high1, low1);
    x0 = hn::Xor(hn::Xor(high1, x1), hn::Set(du, key0));
    x1 = low1;
    x2 = hn::Xor(hn::Xor(high0, x3), hn::Set(du, key1));
    x3 = low0;
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
  const V radius = hn::Sqrt(hn::Mul(hn::Set(d, -2.0f), Log(d, radius_uniform)));
  constexpr float kPi = 3.14159265358979f;
  V sine, cosine;
  SinCos(d, hn::MulAdd(turns, hn::Set(d, 2 * kPi), hn::Set(d, -kPi)), sine, cosine);
  first = hn::Mul(radius, cosine);
  second = hn::Mul(radius, sine);
}

/// Four independent standard normal deviates per lane: block `block` of the streams (seed, a, b, c,
/// purpose).
template <class D, class V = hn::Vec<D>, class VU>
HWY_INLINE void NormalBlock(D d, std::uint64_t seed, VU a, VU b, VU c, simd::RandomPurpose purpose,
                            std::uint32_t block, V* normals) {
  const hn::RebindToUnsigned<D> du;
  VU x0 = a, x1 = b, x2 = c;
  VU x3 = hn::Set(du, static_cast<std::uint32_t>(purpose) | block << 8);
  PhiloxLanes(du, seed, x0, x1, x2, x3);
  BoxMuller(d, x0, x1, normals[0], normals[1]);
  BoxMuller(d, x2, x3, normals[2], normals[3]);
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // include guard per target
