// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "train/network/recurrent_network.h"

namespace skein {

/// A tile of random samples that owns its memory: about a tenth of the steps begin an episode.
class RandomTile {
 public:
  RandomTile(const NetworkShape& shape, int steps, int batch, unsigned seed = 1)
      : steps_(steps), batch_(batch), generator_(seed) {
    const int rows = steps * batch;
    observation = Normal(rows * shape.observation_size, 1);
    state = Normal(batch * shape.state_size(), 0.3f);
    action = Normal(rows * shape.output_size, 1);
    log_prob = Normal(rows, 0.2f);
    // About the log-probability of such actions, so that ratios lie on both sides of the clip.
    for (float& value : log_prob) value -= 1.42f * static_cast<float>(shape.output_size);
    advantage = Normal(rows, 1);
    target = Normal(rows, 1);
    old_value = Normal(rows, 1);
    not_done.resize(rows);
    for (float& value : not_done) value = generator_() % 10 == 0 ? 0.0f : 1.0f;
  }

  SampleTile tile() const {
    SampleTile tile;
    tile.sequence = {steps_, batch_, observation.data(), state.data(), not_done.data()};
    tile.actor = {action.data(), log_prob.data(), advantage.data()};
    tile.target = target.data();
    tile.old_value = old_value.data();
    return tile;
  }

  std::vector<float> Normal(int count, float scale) {
    std::normal_distribution<float> normal(0, scale);
    std::vector<float> values(count);
    for (float& value : values) value = normal(generator_);
    return values;
  }

  std::vector<float> observation, state, not_done, action, log_prob, advantage, target, old_value;

 private:
  int steps_, batch_;
  std::mt19937 generator_;
};

/// Parameters away from their tidy start: every bias and LayerNorm takes part.
inline std::vector<float> DisturbedParameters(const NetworkLayout& layout) {
  std::vector<float> parameters = InitialParameters(layout, 0.5, -0.3, 7, 0);
  std::mt19937 generator(11);
  std::normal_distribution<float> normal(0, 0.1f);
  for (float& parameter : parameters) parameter += normal(generator);
  return parameters;
}

}  // namespace skein
