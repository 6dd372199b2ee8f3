// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/worker_pool.h"
#include "tests/error_message.h"
#include "tests/scratch_directory.h"
#include "tests/train/small_config.h"
#include "train/files/tensor_access.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

TEST(RefusedCheckpoints, AreThoseThatCountMoreThanAnyTraining) {
  constexpr std::size_t kSteps = 4;  // iterations, policy steps, the steps of both optimisers
  const ScratchDirectory scratch;
  const std::string path = scratch / "checkpoint.skein";
  WorkerPool pool(1);
  Trainer trainer(SmallConfig(), pool);
  trainer.Save(path);
  const TensorFile whole = TensorFile::Read(path);
  for (std::size_t i = 0; i < kSteps; ++i) {
    TensorFile damaged = whole;
    auto counters = LoadTensor<std::uint64_t>(whole, path, "counters");
    counters[i] = std::uint64_t{1} << 61;
    StoreTensor(damaged, "counters", {static_cast<std::int64_t>(counters.size())}, counters.data(),
                counters.size());
    damaged.Write(path);
    EXPECT_THAT(MessageOf([&] { trainer.Restore(path); }), testing::HasSubstr("more steps")) << i;
  }
  whole.Write(path);
  trainer.Restore(path);
}

TEST(RefusedCheckpoints, AreThoseOfLaterFormats) {
  const ScratchDirectory scratch;
  const std::string path = scratch / "checkpoint.skein";
  WorkerPool pool(1);
  Trainer trainer(SmallConfig(), pool);
  trainer.Save(path);
  TensorFile later = TensorFile::Read(path);
  later.metadata["checkpoint.format"] = "skein-checkpoint-3";
  later.Write(path);
  for (const std::string& message :
       {MessageOf([&] { trainer.Restore(path); }), MessageOf([&] { trainer.StartFrom(path); })}) {
    EXPECT_THAT(message, testing::HasSubstr("not a checkpoint of this version"));
  }
}

}  // namespace
}  // namespace skein
