// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/learner_config.h"

#include "base/field_list.h"

namespace skein {
namespace {

/// The shuffles' keys hold sixteen bits of them (train/ppo/minibatches.cpp).
constexpr int kMaxShards = 4096;

}  // namespace

void ListFields(LearnerConfig& config, FieldList& list) {
  list.Add("backend", &config.backend, kBackendNames,
           "networks computed by custom kernels (fused) or by LibTorch, the slow reference");
  list.Add(
      "precision", &config.precision, kPrecisionNames,
      "products of the networks in fp32, mixed (forward fp32, backward bf16), bf16, fast "
      "(actor mixed, critic bf16), or amx (tiles of bf16, forward through the actor with two for "
      "each number); auto: amx where the processor has it, else fast where its bf16 is, else "
      "fp32");
  list.Add("tile_samples", &config.tile_samples, {1, 1000000},
           "samples per gradient tile; part of the result, as sums are ordered by it");
  list.Add("rollout_tile", &config.rollout_tile, {1, 1000000}, "aircraft per rollout tile");
  list.Add("shards", &config.shards, {1, kMaxShards},
           "equal parts, a power of two, into which the aircraft are cut; part of the result, as "
           "every minibatch takes its share of each and sums are ordered by them; a new run of "
           "several ranks has 32 in place of 1, or the most that can be")
      .OffUnless(config.shards > 1);
}

}  // namespace skein
