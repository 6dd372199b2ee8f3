// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "train/network/backend.h"
#include "train/network/network_config.h"
#include "train/policy/stored_policy.h"

namespace skein {

/// A trained (or fresh) recurrent actor: what flies, or a high-level policy over a low-level one
/// that flies. Immutable and safe to use from several threads.
class RecurrentPolicy final : public StoredPolicy {
 public:
  struct Parameters;  // train/policy/policy_parameters.h: configuration and the flat parameter
                      // vector

  /// `backend` as asked for; see backend().
  explicit RecurrentPolicy(const std::shared_ptr<const Parameters>& parameters,
                           Backend backend = Backend::kFused);

  /// Reads the actor from a policy file or checkpoint (container of
  /// docs/reference/file-formats.md). Throws Error on a file that is truncated, damaged or not one
  /// of Skein's.
  static RecurrentPolicy Load(const std::string& path);
  /// A freshly initialised actor: the one that training with this seed begins with, but for the
  /// pedals where ppo.pedals = false leaves them idle.
  static RecurrentPolicy Untrained(const NetworkConfig& config, int observation_size,
                                   int action_size, std::uint64_t seed, int action_repeat = 1,
                                   std::shared_ptr<const StoredPolicy> low_level = nullptr);
  /// The same actor, and its low-level policy, computed by another backend.
  RecurrentPolicy WithBackend(Backend backend) const;
  /// Writes the actor, and its low-level policy, atomically.
  void Save(const std::string& path) const;

  const NetworkConfig& config() const;  ///< shape of the network
  int observation_size() const override;
  int action_size() const override;
  const BackendChoice& backend() const;  ///< what computes it
  int state_size() const override;
  int action_repeat() const override;                             ///< as it was trained
  EnvConfig EnvironmentFor(const EnvConfig& env) const override;  ///< as it was trained
  /// The task that it was trained for; empty if it was not, or by a version that did not say.
  const std::string& task() const;
  /// What flies when this is a high-level policy; null if it flies itself.
  const std::shared_ptr<const StoredPolicy>& low_level() const;
  const std::shared_ptr<const Parameters>& parameters() const;  ///< what Save writes

  /// One policy step for `count` aircraft: observation [count][observation_size], state
  /// [count][state_size] (updated in place; the caller zeroes rows at episode starts), mean
  /// [count][action_size]. `log_std` gets action_size values unless null.
  void ActionMean(int count, const float* observation, float* state, float* mean,
                  float* log_std = nullptr) const;
  /// The same, clipped to [-1, 1].
  void Act(int count, const float* observation, float* state, float* action) const override;

  void CheckMadeFor(const EnvConfig& env, const std::string& who) const override;
  void Store(TensorFile& file) const override;
  std::shared_ptr<const StoredPolicy> OnBackend(Backend backend) const override;
  double FlopsPerAction() const override;

 private:
  struct Actor;
  std::shared_ptr<const Actor> actor_;
};

}  // namespace skein
