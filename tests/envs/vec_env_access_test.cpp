// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "envs/state/state.h"
#include "envs/vec_env.h"
#include "tests/envs/step_buffers.h"
#include "tests/error_message.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

TEST(VecEnvAccess, AColumnOfATileIsTheStateOfItsAircraft) {
  constexpr int kCount = 300, kTile = 96;
  for (const bool is_windy : {false, true}) {
    EnvConfig config;
    if (is_windy) config.wind.speed_fps = {20, 60};
    VecEnv env(config, kCount, 1, kTile);
    for (int tile = 0; tile < env.num_tiles(); ++tile) {
      StepBuffers buffers(env.tile_count(tile));
      env.Step(tile, buffers.action.data(), buffers.output());
      for (int column = 0; column < kNumRotationalGustColumns; ++column) {
        std::vector<float> values(static_cast<std::size_t>(env.tile_count(tile)), 9);
        env.ReadColumn(tile, column, values.data());
        for (int i = 0; i < env.tile_count(tile); ++i) {
          ASSERT_EQ(values[static_cast<std::size_t>(i)],
                    env.StateOf(env.tile_begin(tile) + i, column))
              << column;
        }
      }
    }
  }
}

TEST(VecEnvAccess, WhatIsNotThereIsAnError) {
  VecEnv env({}, 64, 1, 32);
  StepBuffers buffers(32);
  std::vector<float> rows(64 * 64);
  for (const int tile : {-1, 2}) {
    for (const std::string& message :
         {MessageOf([&] { env.tile_begin(tile); }), MessageOf([&] { env.tile_count(tile); }),
          MessageOf([&] { env.Observe(tile, rows.data()); }),
          MessageOf([&] { env.ObservePrivileged(tile, rows.data()); }),
          MessageOf([&] { env.Step(tile, buffers.action.data(), buffers.output()); }),
          MessageOf([&] { env.Restart(tile, nullptr); }),
          MessageOf([&] { env.ReadColumn(tile, kU, rows.data()); })}) {
      EXPECT_THAT(message, HasSubstr("no tile " + std::to_string(tile) + " among 2"));
    }
  }
  for (const int column : {-1, static_cast<int>(kNumRotationalGustColumns)}) {
    EXPECT_THAT(MessageOf([&] { env.StateOf(0, column); }), HasSubstr("no state column"));
    EXPECT_THAT(MessageOf([&] { env.ReadColumn(0, column, rows.data()); }),
                HasSubstr("no state column"));
  }
  EXPECT_THAT(MessageOf([&] {
                env.SetTarget(0, {20000, std::numeric_limits<float>::quiet_NaN(), 1000});
              }),
              HasSubstr("not finite"));
}

}  // namespace
}  // namespace skein
