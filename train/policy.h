#pragma once

#include <memory>
#include <string>

#include "train/backend.h"
#include "train/learner_config.h"

namespace skein {

/// A trained (or fresh) recurrent actor: what flies. Immutable and safe to use from several
/// threads.
class Policy {
 public:
  struct Parameters;  // train/policy_parameters.h: configuration and the flat parameter vector

  /// `backend` as asked for; see backend().
  explicit Policy(const std::shared_ptr<const Parameters>& parameters,
                  Backend backend = Backend::kFused);

  /// Reads the actor from a policy file or checkpoint (container of docs/file-formats.md). Throws
  /// Error on a file that is truncated, damaged or not one of Skein's.
  static Policy Load(const std::string& path);
  /// A freshly initialised actor: the one that training with this seed begins with.
  static Policy Untrained(const NetworkConfig& config, int observation_size, int action_size,
                          std::uint64_t seed, int action_repeat = 1);
  /// The same actor, computed by another backend.
  Policy WithBackend(Backend backend) const;
  /// Writes the actor alone, atomically.
  void Save(const std::string& path) const;

  const NetworkConfig& config() const;
  int observation_size() const;
  int action_size() const;
  const BackendChoice& backend() const;  ///< what computes it
  int state_size() const;                ///< floats of recurrent state per aircraft
  int action_repeat() const;  ///< control steps for which it was trained to hold an action

  /// One decision for `count` aircraft: observation [count][observation_size], state
  /// [count][state_size] (updated in place; the caller zeroes rows at episode starts), mean
  /// [count][action_size]. `log_std` gets action_size values unless null.
  void Act(int count, const float* observation, float* state, float* mean,
           float* log_std = nullptr) const;

 private:
  struct Actor;
  std::shared_ptr<const Actor> actor_;
};

}  // namespace skein
