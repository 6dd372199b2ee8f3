// SPDX-License-Identifier: Apache-2.0
#include "envs/env_storage.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/error.h"

namespace skein {
namespace {

constexpr int kTaskColumns = 5;

EnvStorage Storage(int num_aircraft, int tile_size) {
  return EnvStorage(num_aircraft, tile_size, {true, kTaskColumns});
}

/// Words that no other aircraft has.
std::vector<std::uint32_t> WordsOf(int aircraft, std::size_t count) {
  std::vector<std::uint32_t> words(count);
  for (std::size_t k = 0; k < count; ++k) {
    words[k] = static_cast<std::uint32_t>(1000 * aircraft) + static_cast<std::uint32_t>(k);
  }
  return words;
}

void Fill(EnvStorage* storage) {
  for (int i = 0; i < storage->num_aircraft(); ++i) {
    storage->Restore(i, WordsOf(i, storage->words_per_aircraft()).data());
  }
}

TEST(EnvStorage, BlocksHoldEveryAircraftOnceAndInOrder) {
  for (const int tile_size : {32, 100, 128, 160, 300, 4096}) {
    EnvStorage storage = Storage(300, tile_size);
    int next = 0;
    std::size_t index = 0;
    storage.ForEachBlock([&](const EnvBlock& block) {
      EXPECT_EQ(block.first_aircraft, next);
      EXPECT_EQ(block.index, index++);
      EXPECT_LE(block.count, kAircraftPerBlock);
      EXPECT_EQ(block.flight.count, block.count);
      next += block.count;
    });
    EXPECT_EQ(next, 300) << tile_size;
    EXPECT_EQ(index, storage.num_blocks()) << tile_size;
  }
}

TEST(EnvStorage, TilesAreMultiplesOf32) {
  EXPECT_EQ(Storage(300, 33).tile_count(0), 64);
  EXPECT_EQ(Storage(300, 33).num_tiles(), 5);
  EXPECT_EQ(Storage(300, 33).tile_count(4), 300 - 4 * 64);
  EXPECT_EQ(Storage(3, 4096).tile_count(0), 3);
}

TEST(EnvStorage, GivesBackWhatWasRestored) {
  for (const int tile_size : {32, 160, 4096}) {
    EnvStorage storage = Storage(300, tile_size);
    Fill(&storage);
    storage.ForEachBlock([&](const EnvBlock& block) { storage.FillPadding(block); });
    std::vector<std::uint32_t> words(storage.words_per_aircraft());
    for (int i = 0; i < 300; ++i) {
      storage.Save(i, words.data());
      ASSERT_EQ(words, WordsOf(i, words.size())) << "aircraft " << i;
    }
  }
}

TEST(EnvStorage, ColumnsAreTheWordsInTheirOrder) {
  EnvStorage storage = Storage(70, 64);
  Fill(&storage);
  const EnvBlock block = storage.BlockFrom(66);
  const auto word = [](const void* at) {
    std::uint32_t value = 0;
    std::memcpy(&value, at, sizeof value);
    return value;
  };
  EXPECT_EQ(block.first_aircraft, 66);
  EXPECT_EQ(block.count, 4);
  EXPECT_EQ(word(block.flight[kQ0]), 66000u + kQ0);
  EXPECT_EQ(word(block.task[2]), 66000u + kNumWindyColumns + 2);
  EXPECT_EQ(word(block.episode_return), 66000u + kNumWindyColumns + kTaskColumns);
  EXPECT_EQ(word(block.step), word(block.episode_return) + 1);
  EXPECT_EQ(word(block.episode), word(block.step) + 1);
}

TEST(EnvStorage, PaddingFliesCopiesOfTheFirst) {
  EnvStorage storage = Storage(40, 64);
  const EnvBlock block = storage.BlockAt(0, 0);
  for (int i = 0; i < 40; ++i) block.flight[kU][i] = static_cast<float>(600 + i);
  block.task[1][0] = 7;
  storage.FillPadding(block);
  EXPECT_EQ(block.flight[kU][39], 639);
  for (int lane = 40; lane < 64; ++lane) {
    EXPECT_EQ(block.flight[kU][lane], 600);
    EXPECT_EQ(block.task[1][lane], 7);
  }
}

TEST(EnvStorage, MemoryAfterABlockIsTheNextBlock) {
  EnvStorage storage = Storage(300, 128);
  const MemoryAhead ahead = storage.MemoryAfter(storage.BlockAt(0, 0));
  EXPECT_EQ(ahead.begin, reinterpret_cast<const std::byte*>(storage.BlockAt(1, 0).flight.base));
  EXPECT_EQ(storage.MemoryAfter(storage.BlockAt(2, 0)).begin, nullptr);
  EXPECT_EQ(storage.MemoryAfter(storage.BlockAt(2, 0)).bytes, 0u);
}

TEST(EnvStorage, RefusesAircraftThatAreNot) {
  EnvStorage storage = Storage(40, 64);
  EXPECT_THROW(storage.BlockFrom(-1), Error);
  EXPECT_THROW(storage.BlockFrom(40), Error);
}

}  // namespace
}  // namespace skein
