// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace skein {

/// A tile of sequences, time-major: row (step * batch + i) belongs to sequence i.
struct SequenceTile {
  int steps = 0, batch = 0;
  const float* observation = nullptr;    ///< [steps][batch][observation_size]
  const float* initial_state = nullptr;  ///< [batch][gru_layers][gru_size]
  /// [steps][batch]: 0 where an episode begins at that step, so that the state is zero there;
  /// else 1.
  const float* not_done = nullptr;

  std::int64_t rows() const { return static_cast<std::int64_t>(steps) * batch; }
};

/// Samples of a tile as the actor's loss sees them; one value per row but `action`
/// ([rows][output_size]).
struct ActorSamples {
  const float* action = nullptr;
  const float* old_log_prob = nullptr;
  const float* advantage = nullptr;
};

/// A tile of chunks with what the losses need, gathered from a rollout; time-major rows.
struct SampleTile {
  SequenceTile sequence;
  ActorSamples actor;             ///< set for actors
  const float* target = nullptr;  ///< set for critics, in the scale of the network's output
  const float* old_value = nullptr;
};

}  // namespace skein
