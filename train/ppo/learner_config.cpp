// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/learner_config.h"

#include "base/field_list.h"

namespace skein {

void ListFields(LearnerConfig& config, FieldList& list) {
  list.Add("backend", &config.backend, kBackendNames,
           "networks computed by custom kernels (fused) or by LibTorch, the slow reference");
  list.Add("precision", &config.precision, kPrecisionNames,
           "products of the networks in fp32, mixed (forward fp32, backward bf16), bf16, or fast "
           "(actor mixed, critic bf16); auto: fast where the processor has bf16, else fp32");
  list.Add("tile_samples", &config.tile_samples, {1, 1000000},
           "samples per gradient tile; part of the result, as sums are ordered by it");
  list.Add("rollout_tile", &config.rollout_tile, {1, 1000000}, "aircraft per rollout tile");
}

}  // namespace skein
