// SPDX-License-Identifier: Apache-2.0
#include "simd/work_rates.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>

namespace skein::simd {
namespace {

using Clock = std::chrono::steady_clock;

double Seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

WorkRates RatesOf(const std::vector<double>& done, const std::vector<double>& seconds,
                  int threads) {
  WorkRates rates;
  const auto size = static_cast<std::size_t>(threads);
  for (std::size_t first = 0; first < done.size(); first += size) {
    double total = 0, sum = 0, slowest = 0;
    for (std::size_t i = first; i < first + size; ++i) {
      total += done[i];
      sum += done[i] / seconds[i];
      slowest = std::max(slowest, seconds[i]);
    }
    rates.of_slowest.push_back(total / slowest);
    rates.summed.push_back(sum);
  }
  std::sort(rates.of_slowest.begin(), rates.of_slowest.end());
  std::sort(rates.summed.begin(), rates.summed.end());
  return rates;
}

WorkRates MeasureRates(Work work, std::int64_t rounds, int repetitions, int threads) {
  std::atomic<int> arrived{0};
  std::vector<double> done(repetitions * threads), seconds(repetitions * threads);
  // Threads live through all repetitions: fresh ones may share a processor until they are moved.
  const auto run = [&](int thread) {
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      float sink = 0;
      ++arrived;
      while (arrived < threads * (repetition + 1)) std::this_thread::yield();
      const auto start = Clock::now();
      done[repetition * threads + thread] = work(rounds, &sink);
      const volatile float kept = sink;
      static_cast<void>(kept);
      seconds[repetition * threads + thread] = Seconds(Clock::now() - start);
    }
  };
  std::vector<std::thread> others;
  for (int thread = 1; thread < threads; ++thread) others.emplace_back(run, thread);
  run(0);
  for (std::thread& other : others) other.join();
  return RatesOf(done, seconds, threads);
}

}  // namespace skein::simd
