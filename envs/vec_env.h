// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "envs/env_config.h"
#include "envs/policy.h"
#include "envs/step_output.h"
#include "envs/tasks/termination.h"

namespace skein {

/// N aircraft flying one task, as independent tiles. Tiles may be driven from different threads at
/// once, each by one; Error is thrown where there is no such tile, aircraft or column. Every number
/// depends only on (config, seed, aircraft index, actions): not on tile size, threads or the other
/// aircraft.
///
/// Without a low-level policy, actions are throttle and sticks. With one, they are a high-level
/// policy's, and the low-level policy flies.
class VecEnv {
 public:
  /// Aircraft get the indices [0, num_aircraft). `tile_size` is rounded up to a multiple of 32.
  /// Throws Error on a configuration that cannot be flown. All aircraft start in a fresh episode.
  /// The first flies as aircraft `first_aircraft` of a larger environment does, and so on.
  /// Of `low_level` sizes alone are checked: Policy::CheckMadeFor says whether it was made for the
  /// task "control" in this environment. TrackingConfig::acts_directly is not asked: with
  /// `low_level` there is a hierarchy.
  VecEnv(const EnvConfig& config, int num_aircraft, std::uint64_t seed, int tile_size = 256,
         std::shared_ptr<const Policy> low_level = nullptr, int first_aircraft = 0);
  ~VecEnv();
  VecEnv(VecEnv&&) noexcept;  ///< what was moved from can only be destroyed

  const EnvConfig& config() const;  ///< as given
  int num_aircraft() const;         ///< of all tiles
  int first_aircraft() const;       ///< of a larger environment, the first of these
  int num_tiles() const;            ///< indices of tiles are [0, num_tiles())
  int tile_begin(int tile) const;   ///< index of the tile's first aircraft
  int tile_count(int tile) const;   ///< the tile's aircraft
  int observation_size() const;     ///< 22 of the built-in tasks
  int action_size() const;          ///< 4; 3 with a low-level policy

  /// Writes the tile's observations, row-major [count][observation_size], noise included.
  void Observe(int tile, float* observation) const;

  /// What the environment knows and no policy observes, for a critic that sees more than its actor:
  /// the task's errors without noise, the episode's clock, tolerance and progress, wind and
  /// drawn plant (envs/privileged_observation.h). Numbers of about unit size, called by their
  /// names.
  int privileged_size() const;
  std::vector<std::string> privileged_names() const;  ///< of privileged_size() numbers
  /// Writes the tile's, row-major [count][privileged_size].
  void ObservePrivileged(int tile, float* rows) const;

  /// Holds actions (row-major [count][action_size], clipped to [-1, 1]) for config().action_repeat
  /// control steps: throttle (-1 is idle, 1 is maximum), pitch (+ nose up), roll (+ right), yaw (+
  /// nose right). With a low-level policy: pitch, yaw and speed that it is to reach, as changes of
  /// what they are now (EnvConfig::high_level); its own policy steps last as many control steps as
  /// its action_repeat(), and it remembers nothing of an earlier episode.
  /// An episode that ends during them takes no further reward, and its aircraft begins a new one at
  /// the end of the policy step. An action that is not finite ends the episode as non_finite.
  void Step(int tile, const float* action, const StepOutput& output);

  /// Begins the next episode of the tile's aircraft `i` where begins[i], in the middle of the one
  /// under way, of which nothing is reported.
  void Restart(int tile, const bool* begins);

  /// Multiplies what handling costs (EnvConfig::reward) from now on; 1 at first. No part of the
  /// state: who trains sets it anew after Restore.
  void SetHandlingWeight(double weight);

  /// From now on episodes draw from `share`, in [0, 1], of what EnvConfig lets them draw: initial
  /// altitudes and airspeeds, wind, turbulence and noise from the least of their ranges on, plants
  /// around the nominal one. 1 at first, and no part of the state, as above. A noise that is drawn
  /// and a mission's next target change in episodes under way, too.
  void SetConditionShare(double share);

  /// From now on targets of missions in training are missed `share`, in [0, 1], of the way from
  /// MissionConfig::training_time_limit_s to the time limit. 0 at first, and no part of the state.
  void SetTimeLimitShare(double share);

  /// Every aircraft begins its first episode, as when constructed.
  void Restart();

  /// The whole mutable state (for checkpoints), aircraft by aircraft whatever the tiles.
  std::vector<std::uint32_t> Snapshot() const;
  /// Goes on from a Snapshot. Throws Error on a size that does not fit.
  void Restore(const std::vector<std::uint32_t>& snapshot);

  /// One column of the physical state (envs/state/state.h) of one aircraft; in still air the wind's
  /// are zero.
  float StateOf(int aircraft, int column) const;
  /// The same of all aircraft of a tile, [count], at once.
  void ReadColumn(int tile, int column, float* values) const;
  /// The target of one aircraft: altitude ft, yaw rad, speed ft/s for Heading; pitch rad,
  /// yaw rad, speed ft/s for Control; north, east and altitude, ft, for Tracking.
  std::vector<float> TargetOf(int aircraft) const;
  /// Another target for the episode under way of one aircraft, as of TargetOf. Throws Error on one
  /// of another size, or that is not finite.
  void SetTarget(int aircraft, const std::vector<float>& target);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein
