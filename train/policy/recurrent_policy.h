#pragma once

#include <memory>
#include <string>

#include "envs/policy.h"
#include "train/network/backend.h"
#include "train/ppo/learner_config.h"

namespace skein {

/// A trained (or fresh) recurrent actor: what flies, or plans for a controller that flies.
/// Immutable and safe to use from several threads.
class Policy final : public Pilot {
 public:
  struct Parameters;  // train/policy/policy_parameters.h: configuration and the flat parameter vector

  /// `backend` as asked for; see backend().
  explicit Policy(const std::shared_ptr<const Parameters>& parameters,
                  Backend backend = Backend::kFused);

  /// Reads the actor from a policy file or checkpoint (container of docs/file-formats.md). Throws
  /// Error on a file that is truncated, damaged or not one of Skein's.
  static Policy Load(const std::string& path);
  /// A freshly initialised actor: the one that training with this seed begins with.
  static Policy Untrained(const NetworkConfig& config, int observation_size, int action_size,
                          std::uint64_t seed, int action_repeat = 1,
                          std::shared_ptr<const Pilot> controller = nullptr);
  /// The same actor, computed by another backend, and the controller that it plans for.
  Policy WithBackend(Backend backend) const;
  /// Writes the actor, and the controller that it plans for, atomically.
  void Save(const std::string& path) const;

  const NetworkConfig& config() const;
  int observation_size() const override;
  int action_size() const override;
  const BackendChoice& backend() const;  ///< what computes it
  int state_size() const override;
  int action_repeat() const override;                             ///< as it was trained
  EnvConfig EnvironmentFor(const EnvConfig& env) const override;  ///< as it was trained
  /// The task that it was trained for; empty if it was not, or by a version that did not say.
  const std::string& task() const;
  /// What flies when this is a planner; null if it flies itself.
  const std::shared_ptr<const Pilot>& controller() const;
  const std::shared_ptr<const Parameters>& parameters() const;

  /// One decision for `count` aircraft: observation [count][observation_size], state
  /// [count][state_size] (updated in place; the caller zeroes rows at episode starts), mean
  /// [count][action_size]. `log_std` gets action_size values unless null.
  void Act(int count, const float* observation, float* state, float* mean,
           float* log_std = nullptr) const;
  /// The same, clipped to [-1, 1].
  void Fly(int count, const float* observation, float* state, float* action) const override;

 private:
  struct Actor;
  std::shared_ptr<const Actor> actor_;
};

}  // namespace skein
