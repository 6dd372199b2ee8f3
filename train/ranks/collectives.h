// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/reason_of.h"
#include "base/worker_pool.h"
#include "train/ranks/ranks.h"

namespace skein {

/// Combines `count` values with those of all ranks: combine(mine, theirs) puts the combination of
/// two values into the first. Recursive doubling: neighbours first, then pairs of pairs, so that a
/// sum is that of SumByTree (train/ppo/shards.h) over the ranks. Every rank gets the same bits if
/// combine commutes exactly, as an addition does.
template <typename Value, typename Combine>
void CombineOverRanks(Ranks& ranks, std::size_t count, Value* values, const Combine& combine) {
  static_assert(std::is_trivially_copyable_v<Value>);
  std::vector<Value> theirs(ranks.count() > 1 ? count : 0);
  for (int distance = 1; distance < ranks.count(); distance *= 2) {
    const std::size_t bytes = count * sizeof(Value);
    ranks.Exchange(ranks.rank() ^ distance, values, bytes, theirs.data(), bytes);
    for (std::size_t i = 0; i < count; ++i) combine(values[i], theirs[i]);
  }
}

/// The sums of `count` numbers over all ranks.
template <typename Value>
void SumOverRanks(Ranks& ranks, std::size_t count, Value* values) {
  CombineOverRanks(ranks, count, values, [](Value& mine, const Value& theirs) { mine += theirs; });
}

/// The same of one value, which has +=, and in the same message whether some rank gives up; that is
/// what it returns.
template <typename Value>
bool SumOverRanksOrGiveUp(Ranks& ranks, bool gives_up, Value& value) {
  struct Message {
    Value value;
    int giving_up;
    void operator+=(const Message& theirs) {
      value += theirs.value;
      giving_up += theirs.giving_up;
    }
  } message{value, gives_up};
  SumOverRanks(ranks, 1, &message);
  value = message.value;
  return message.giving_up > 0;
}

/// From so many bytes on, numbers are summed part by part: what a message takes to arrive, 30 us,
/// is what 37 kB take at 10 Gbit/s.
inline constexpr std::size_t kSummedByParts = std::size_t{1} << 16;

/// The sums of `count` numbers over all ranks, to the bits of SumOverRanks, and that of `more`,
/// which has +=, in the same messages. Of many numbers every rank sums its part alone and then gets
/// the others' (Rabenseifner 2004, "Optimization of Collective Reduction Operations"): that sends
/// fewer than twice as many instead of log2 R times as many, in twice as many messages.
template <typename More>
void SumManyOverRanks(Ranks& ranks, std::size_t count, float* values, More& more) {
  static_assert(std::is_trivially_copyable_v<More>);
  struct Part {
    std::size_t begin, end;
    std::size_t bytes() const { return (end - begin) * sizeof(float); }
  };
  const bool by_parts = ranks.count() > 2 && count * sizeof(float) >= kSummedByParts;
  std::vector<Part> parts{{0, count}};  // this rank's, each within that before it
  std::vector<float> theirs(ranks.count() > 1 ? count : 0);
  for (int distance = 1; distance < ranks.count(); distance *= 2) {
    Part own = parts.back(), given = own;
    if (by_parts) {
      own.end = given.begin = own.begin + (own.end - own.begin) / 2;
      if ((ranks.rank() & distance) != 0) std::swap(own, given);
    }
    More their_more;
    ranks.ExchangeAll(ranks.rank() ^ distance,
                      {{values + given.begin, given.bytes(), theirs.data(), own.bytes()},
                       {&more, sizeof(More), &their_more, sizeof(More)}});
    for (std::size_t i = own.begin; i < own.end; ++i) values[i] += theirs[i - own.begin];
    more += their_more;
    parts.push_back(own);
  }
  for (int distance = by_parts ? ranks.count() / 2 : 0; distance > 0; distance /= 2) {
    const Part own = parts.back();
    parts.pop_back();
    Part other = parts.back();
    (own.begin == other.begin ? other.begin : other.end) =
        own.begin == other.begin ? own.end : own.begin;
    ranks.Exchange(ranks.rank() ^ distance, values + own.begin, own.bytes(), values + other.begin,
                   other.bytes());
  }
}

/// The union of all ranks' bits.
inline std::uint64_t UnionOverRanks(Ranks& ranks, std::uint64_t bits) {
  CombineOverRanks(ranks, 1, &bits,
                   [](std::uint64_t& mine, std::uint64_t theirs) { mine |= theirs; });
  return bits;
}

/// Whether some rank's pool was asked to stop: then every rank's is.
inline bool AgreeOnStop(Ranks& ranks, WorkerPool& pool) {
  if (UnionOverRanks(ranks, pool.stopping()) == 0) return false;
  pool.RequestStop();
  return true;
}

/// Where a rank's share of `size` begins.
inline std::int64_t ShareBegin(std::int64_t size, int rank, const Ranks& ranks) {
  return size * rank / ranks.count();
}

/// Gives all ranks all of `values`, of which each rank has filled its share.
template <typename Value>
void ShareWithAllRanks(Ranks& ranks, std::vector<Value>& values) {
  static_assert(std::is_trivially_copyable_v<Value>);
  const auto size = static_cast<std::int64_t>(values.size());
  for (int distance = 1; distance < ranks.count(); distance *= 2) {
    const int own = ranks.rank() / distance * distance, theirs = own ^ distance;
    const auto begin = [&](int rank) { return ShareBegin(size, rank, ranks); };
    const auto bytes = [&](int first) {
      return static_cast<std::size_t>(begin(first + distance) - begin(first)) * sizeof(Value);
    };
    ranks.Exchange(ranks.rank() ^ distance, values.data() + begin(own), bytes(own),
                   values.data() + begin(theirs), bytes(theirs));
  }
}

/// Puts all ranks' values, equally many of each, one rank's behind the other's, into rank 0's;
/// other ranks' stay.
template <typename Value>
void GatherAtRankZero(Ranks& ranks, std::vector<Value>& values) {
  static_assert(std::is_trivially_copyable_v<Value>);
  const std::size_t size = values.size(), bytes = size * sizeof(Value);
  if (ranks.rank() != 0) {
    ranks.Exchange(0, values.data(), bytes, nullptr, 0);
    return;
  }
  values.resize(size * static_cast<std::size_t>(ranks.count()));
  for (int rank = 1; rank < ranks.count(); ++rank) {
    ranks.Exchange(rank, nullptr, 0, values.data() + size * static_cast<std::size_t>(rank), bytes);
  }
}

/// Gives all ranks rank 0's `values`; every rank has equally many.
template <typename Value>
void ShareRankZeros(Ranks& ranks, std::vector<Value>& values) {
  static_assert(std::is_trivially_copyable_v<Value>);
  const std::size_t bytes = values.size() * sizeof(Value);
  if (ranks.rank() != 0) {
    ranks.Exchange(0, nullptr, 0, values.data(), bytes);
    return;
  }
  for (int rank = 1; rank < ranks.count(); ++rank) {
    ranks.Exchange(rank, values.data(), bytes, nullptr, 0);
  }
}

/// What every rank has been told of and throws: rank 0 alone says it to people.
class JointError : public Error {
 public:
  explicit JointError(const std::string& message) : Error(message) {}
};

/// Returns work(), for which other ranks wait. What it throws ends all processes, since they do not
/// know of it, unless all have been told (JointError) or there are no others.
template <typename Work>
auto DoForOthers(Ranks& ranks, const Work& work) {
  try {
    return work();
  } catch (const JointError&) {
    throw;
  } catch (const std::exception& failure) {
    if (ranks.count() > 1) ranks.Abort(ReasonOf(failure));
    throw;
  }
}

/// All ranks' texts, by rank, on every rank.
std::vector<std::string> TextsOfRanks(Ranks& ranks, const std::string& text);

/// Does `work` on every rank. If that throws an Error on any of them, throws on all: on rank 0 its
/// own exception if it has one, else a JointError that names the ranks and says what befell the
/// first.
void DoTogether(Ranks& ranks, const std::function<void()>& work);

/// Does `work` on rank 0 alone; what it throws is thrown on all, as by DoTogether.
inline void DoOnRankZero(Ranks& ranks, const std::function<void()>& work) {
  DoTogether(ranks, [&] {
    if (ranks.rank() == 0) work();
  });
}

/// Throws JointError on every rank, naming those that differ, unless `text`, which says what `what`
/// is, is the same on all.
void RequireSameOnRanks(Ranks& ranks, const std::string& what, const std::string& text);

}  // namespace skein
