// SPDX-License-Identifier: Apache-2.0
#include "train/measures/command_kernels.h"

#include <algorithm>
#include <cmath>

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "train/measures/command_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// Commands side by side, as many as a vector holds: 4, 2 or 1.
using CommandTag = hn::CappedTag<double, kActionSize>;

using CommandVector = hn::Vec<CommandTag>;

/// Those that begin with `first`, clipped.
HWY_INLINE CommandVector Commands(const ActionRows& rows, std::size_t row, std::size_t first) {
  const CommandTag d;
  const hn::Rebind<float, CommandTag> d_float;
  const auto action = hn::LoadU(d_float, rows.values + row * kActionSize + first);
  return hn::Clamp(hn::PromoteTo(d, action), hn::Set(d, -1.0), hn::Set(d, 1.0));
}

HWY_INLINE CommandVector Load(const CommandNumbers& numbers, std::size_t first) {
  return hn::LoadU(CommandTag(), numbers.data() + first);
}

HWY_INLINE void Store(CommandVector values, std::size_t first, CommandNumbers* numbers) {
  hn::StoreU(values, CommandTag(), numbers->data() + first);
}

/// Those commands of `history` that begin with `first`.
void FollowFrom(std::size_t first, const ActionRows& rows, double dead_band,
                CommandHistory* history) {
  const CommandTag d;
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0), minus_one = hn::Set(d, -1.0);
  const auto band = hn::Set(d, dead_band);
  auto last = Load(history->last, first), direction = Load(history->direction, first);
  auto lowest = Load(history->lowest, first), highest = Load(history->highest, first);
  auto variation = Load(history->variation, first), reversals = Load(history->reversals, first);
  auto saturated = Load(history->saturated, first);
  for (std::size_t row = 0; row < rows.count; ++row) {
    const auto value = Commands(rows, row, first);
    variation = hn::Add(variation, hn::Abs(hn::Sub(value, last)));
    last = value;
    saturated = hn::Add(saturated, hn::IfThenElseZero(hn::Ge(hn::Abs(value), one), one));
    lowest = hn::Min(lowest, value);
    highest = hn::Max(highest, value);
    const auto turns_up = hn::And(hn::Le(direction, zero), hn::Gt(hn::Sub(value, lowest), band));
    const auto turns_down = hn::And(hn::Ge(direction, zero), hn::Gt(hn::Sub(highest, value), band));
    const auto turns = hn::Or(turns_up, turns_down);
    // Its first motion turns nothing back: its direction was 0.
    reversals = hn::Add(reversals, hn::IfThenElseZero(turns, hn::Abs(direction)));
    direction = hn::IfThenElse(turns_up, one, hn::IfThenElse(turns_down, minus_one, direction));
    lowest = hn::IfThenElse(turns, value, lowest);
    highest = hn::IfThenElse(turns, value, highest);
  }
  Store(last, first, &history->last);
  Store(direction, first, &history->direction);
  Store(lowest, first, &history->lowest);
  Store(highest, first, &history->highest);
  Store(variation, first, &history->variation);
  Store(reversals, first, &history->reversals);
  Store(saturated, first, &history->saturated);
}

constexpr std::size_t kTogether = hn::MaxLanes(CommandTag());

void FollowCommands(const ActionRows& rows, double dead_band, CommandHistory* history) {
  for (std::size_t first = 0; first < kActionSize; first += kTogether) {
    FollowFrom(first, rows, dead_band, history);
  }
}

CommandNumbers CentreCommands(const ActionRows& rows, double* centred) {
  const CommandTag d;
  CommandNumbers squares;
  for (std::size_t first = 0; first < kActionSize; first += kTogether) {
    auto sum = hn::Zero(d), sum_of_squares = hn::Zero(d);
    for (std::size_t row = 0; row < rows.count; ++row) {
      sum = hn::Add(sum, Commands(rows, row, first));
    }
    const auto mean = hn::Div(sum, hn::Set(d, static_cast<double>(rows.count)));
    for (std::size_t row = 0; row < rows.count; ++row) {
      const auto value = hn::Sub(Commands(rows, row, first), mean);
      sum_of_squares = hn::MulAdd(value, value, sum_of_squares);
      hn::StoreU(value, d, centred + row * kActionSize + first);
    }
    Store(sum_of_squares, first, &squares);
  }
  return squares;
}

using FrequencyTag = hn::ScalableTag<double>;
constexpr std::size_t kFrequencies = hn::MaxLanes(FrequencyTag());

/// |X(k)|^2 of the kFrequencies values of k whose 2 cos(2 pi k / count) are given.
void SquaresOf(const double* coefficients, const double* centred, std::size_t count,
               double (&squares)[kActionSize][kFrequencies]) {
  const FrequencyTag d;
  const auto coefficient = hn::LoadU(d, coefficients);
  hn::Vec<FrequencyTag> newest[kActionSize], before[kActionSize];
  for (std::size_t k = 0; k < kActionSize; ++k) newest[k] = before[k] = hn::Zero(d);
  for (std::size_t row = 0; row < count; ++row) {
    // The four recurrences hide one another's latency.
    for (std::size_t k = 0; k < kActionSize; ++k) {
      const auto value = hn::Set(d, centred[row * kActionSize + k]);
      const auto next = hn::MulAdd(coefficient, newest[k], hn::Sub(value, before[k]));
      before[k] = newest[k];
      newest[k] = next;
    }
  }
  for (std::size_t k = 0; k < kActionSize; ++k) {
    const auto both = hn::MulAdd(newest[k], newest[k], hn::Mul(before[k], before[k]));
    const auto product = hn::Mul(newest[k], before[k]);
    hn::StoreU(hn::NegMulAdd(coefficient, product, both), d, squares[k]);
  }
}

CommandNumbers SumSquares(std::size_t last, const double* centred, std::size_t count) {
  CommandNumbers sum{};
  double coefficients[kFrequencies], squares[kActionSize][kFrequencies];
  for (std::size_t first = 1; first <= last; first += kFrequencies) {
    for (std::size_t i = 0; i < kFrequencies; ++i) {
      const double turns = static_cast<double>(first + i) / static_cast<double>(count);
      coefficients[i] = 2 * std::cos(2 * M_PI * turns);
    }
    SquaresOf(coefficients, centred, count, squares);
    for (std::size_t i = 0; i < kFrequencies && first + i <= last; ++i) {
      for (std::size_t k = 0; k < kActionSize; ++k) sum[k] += squares[k][i];
    }
  }
  return sum;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(FollowCommands);
HWY_EXPORT(CentreCommands);
HWY_EXPORT(SumSquares);

CommandHistory HistoryBefore(const ActionRows& rows) {
  CommandHistory history;
  for (std::size_t k = 0; k < kActionSize; ++k) {
    history.last[k] = std::clamp(rows.values[k], -1.0f, 1.0f);
  }
  history.lowest = history.highest = history.last;
  return history;
}

void Follow(const ActionRows& rows, double dead_band, CommandHistory* history) {
  SKEIN_DISPATCH(FollowCommands)(rows, dead_band, history);
}

CommandNumbers Centre(const ActionRows& rows, double* centred) {
  return SKEIN_DISPATCH(CentreCommands)(rows, centred);
}

CommandNumbers SquaresUpTo(std::size_t last, const double* centred, std::size_t count) {
  return SKEIN_DISPATCH(SumSquares)(last, centred, count);
}

}  // namespace skein
#endif  // HWY_ONCE
