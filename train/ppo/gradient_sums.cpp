// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/gradient_sums.h"

#include <array>
#include <cstddef>

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "train/ppo/gradient_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// The elements [begin, end) of sums and of what joins them.
template <std::size_t kOthers>
struct Addition {
  std::int64_t begin, end;
  float* sums;
  std::array<const float*, kOthers> others;
};

/// sums[i] = combine(sums[i], others[i]), vector by vector of `d`. Stops before a remainder of
/// fewer elements than its lanes, which begins at addition->begin.
template <class D, std::size_t kOthers, class Combine>
HWY_INLINE void AddVectors(D d, const Combine& combine, Addition<kOthers>* addition) {
  const auto lanes = static_cast<std::int64_t>(hn::Lanes(d));
  std::int64_t i = addition->begin;
  for (; i + lanes <= addition->end; i += lanes) {
    hn::Vec<D> others[kOthers];
    for (std::size_t k = 0; k < kOthers; ++k) others[k] = hn::LoadU(d, addition->others[k] + i);
    hn::StoreU(combine(hn::LoadU(d, addition->sums + i), others), d, addition->sums + i);
  }
  addition->begin = i;
}

template <std::size_t kOthers, class Combine>
HWY_INLINE void Add(Addition<kOthers> addition, const Combine& combine) {
  AddVectors(FloatTag(), combine, &addition);
  AddVectors(hn::CappedTag<float, 1>(), combine, &addition);
}

/// Adds kOthers vectors from `next` on to the first, in their order, while there are as many.
template <std::size_t kOthers>
void AddInOrder(std::int64_t begin, std::int64_t end, AlignedVector<float>* vectors, int count,
                int* next) {
  constexpr int kStep = static_cast<int>(kOthers);
  for (; *next + kStep <= count; *next += kStep) {
    Addition<kOthers> addition{begin, end, vectors[0].data(), {}};
    for (int k = 0; k < kStep; ++k) addition.others[k] = vectors[*next + k].data();
    Add(addition, [](auto sum, const auto* others) HWY_ATTR {
      for (std::size_t k = 0; k < kOthers; ++k) sum = hn::Add(sum, others[k]);
      return sum;
    });
  }
}

/// Adds up every `stride`-th vector by the tree, in the first.
void AddByTree(std::int64_t begin, std::int64_t end, std::size_t stride,
               std::vector<AlignedVector<float>>& vectors) {
  const std::size_t count = vectors.size();
  // Two levels at a time.
  for (; 2 * stride < count; stride *= 4) {
    for (std::size_t first = 0; first < count; first += 4 * stride) {
      AlignedVector<float>* const four[] = {&vectors[first], &vectors[first + stride],
                                            &vectors[first + 2 * stride],
                                            &vectors[first + 3 * stride]};
      Add(
          Addition<3>{
              begin, end, four[0]->data(), {four[1]->data(), four[2]->data(), four[3]->data()}},
          [](auto sum, const auto* others)
              HWY_ATTR { return hn::Add(hn::Add(sum, others[0]), hn::Add(others[1], others[2])); });
    }
  }
  if (stride >= count) return;
  Add(Addition<1>{begin, end, vectors[0].data(), {vectors[stride].data()}},
      [](auto sum, const auto* others) HWY_ATTR { return hn::Add(sum, others[0]); });
}

void SumGradientsKernel(std::int64_t begin, std::int64_t end, int slices,
                        std::vector<AlignedVector<float>>& accumulators) {
  const auto stride = static_cast<std::size_t>(slices);
  for (std::size_t first = 0; first < accumulators.size(); first += stride) {
    int next = 1;
    // Several at a time: a sum is loaded and stored once for all.
    AddInOrder<5>(begin, end, &accumulators[first], slices, &next);
    AddInOrder<1>(begin, end, &accumulators[first], slices, &next);
  }
  AddByTree(begin, end, stride, accumulators);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(SumGradientsKernel);

void SumGradients(std::int64_t begin, std::int64_t end, int slices,
                  std::vector<AlignedVector<float>>& accumulators) {
  SKEIN_DISPATCH(SumGradientsKernel)(begin, end, slices, accumulators);
}

}  // namespace skein
#endif  // HWY_ONCE
