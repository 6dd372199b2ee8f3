#include "simd/peak.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "simd/dispatch.h"
#include "simd/error.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/peak.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

/// Does `rounds` rounds of multiply-adds and returns their floating-point operations; `sink` gets a
/// result, so that the work cannot be left out.
double MultiplyAdd(std::int64_t rounds, float* sink) {
  const hn::ScalableTag<float> d;
  // Twelve independent chains keep two units of latency five busy.
  auto a0 = hn::Set(d, 0.1f), a1 = a0, a2 = a0, a3 = a0, a4 = a0, a5 = a0;
  auto a6 = a0, a7 = a0, a8 = a0, a9 = a0, a10 = a0, a11 = a0;
  const auto x = hn::Set(d, 0.9375f);
  const auto y = hn::Set(d, 0.0625f);
  for (std::int64_t i = 0; i < rounds; ++i) {
    a0 = hn::MulAdd(a0, x, y);
    a1 = hn::MulAdd(a1, x, y);
    a2 = hn::MulAdd(a2, x, y);
    a3 = hn::MulAdd(a3, x, y);
    a4 = hn::MulAdd(a4, x, y);
    a5 = hn::MulAdd(a5, x, y);
    a6 = hn::MulAdd(a6, x, y);
    a7 = hn::MulAdd(a7, x, y);
    a8 = hn::MulAdd(a8, x, y);
    a9 = hn::MulAdd(a9, x, y);
    a10 = hn::MulAdd(a10, x, y);
    a11 = hn::MulAdd(a11, x, y);
#if HWY_COMPILER_GCC
    // The chains are equal: keep the compiler from computing one for all.
    asm volatile(""
                 : "+x"(a0.raw), "+x"(a1.raw), "+x"(a2.raw), "+x"(a3.raw), "+x"(a4.raw),
                   "+x"(a5.raw), "+x"(a6.raw), "+x"(a7.raw), "+x"(a8.raw), "+x"(a9.raw),
                   "+x"(a10.raw), "+x"(a11.raw));
#endif
  }
  const auto low = hn::Add(hn::Add(hn::Add(a0, a1), hn::Add(a2, a3)), hn::Add(a4, a5));
  const auto high = hn::Add(hn::Add(hn::Add(a6, a7), hn::Add(a8, a9)), hn::Add(a10, a11));
  *sink = hn::GetLane(hn::Add(low, high));
  constexpr double kChains = 12, kOperations = 2;
  return static_cast<double>(rounds) * kChains * kOperations * static_cast<double>(hn::Lanes(d));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
HWY_EXPORT(MultiplyAdd);

namespace simd {
namespace {

using Clock = std::chrono::steady_clock;

double Seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// Best rate of several rounds in which all threads start together; the slowest thread's time
/// counts.
double BestRate(int threads) {
  constexpr int kRepetitions = 8;
  constexpr std::int64_t kRounds = 400000;
  double best = 0;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    std::atomic<int> waiting{threads};
    std::vector<double> operations(threads), seconds(threads);
    const auto run = [&](int thread) {
      float sink = 0;
      --waiting;
      while (waiting > 0) std::this_thread::yield();
      const auto start = Clock::now();
      operations[thread] = SKEIN_DISPATCH(MultiplyAdd)(kRounds, &sink);
      const volatile float kept = sink;
      static_cast<void>(kept);
      seconds[thread] = Seconds(Clock::now() - start);
    };
    std::vector<std::thread> others;
    for (int thread = 1; thread < threads; ++thread) others.emplace_back(run, thread);
    run(0);
    for (std::thread& other : others) other.join();
    double total = 0;
    for (const double done : operations) total += done;
    best = std::max(best, total / *std::max_element(seconds.begin(), seconds.end()));
  }
  return best / 1e9;
}

}  // namespace

PeakRate MeasurePeak(int threads) {
  if (threads < 1) throw Error("MeasurePeak: " + std::to_string(threads) + " threads");
  const double one = BestRate(1);
  return {one, threads == 1 ? one : BestRate(threads)};
}

}  // namespace simd
}  // namespace skein
#endif
