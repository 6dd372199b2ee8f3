// SPDX-License-Identifier: Apache-2.0
#include "train/policy/agent.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "envs/actions.h"
#include "simd/random.h"

namespace skein {
namespace {

/// Zero actions.
class ZeroPolicy final : public Policy {
 public:
  explicit ZeroPolicy(int action_repeat) : action_repeat_(action_repeat) {}

  int observation_size() const override { return 0; }
  int action_size() const override { return kActionSize; }
  int state_size() const override { return 0; }
  int action_repeat() const override { return action_repeat_; }
  void Act(int count, const float*, float*, float* action) const override {
    std::fill_n(action, static_cast<std::ptrdiff_t>(count) * kActionSize, 0.0f);
  }

 private:
  int action_repeat_;
};

void AddNormals(const Agent::Turn& turn, int count, const std::vector<float>& log_std,
                float* action) {
  const std::size_t size = log_std.size();
  std::vector<float> deviates(count * size);
  const std::vector<std::uint32_t> policy_step_low(count, turn.policy_step),
      policy_step_high(count, 0);
  simd::FillNormals(turn.seed, turn.first_aircraft, policy_step_low.data(), policy_step_high.data(),
                    simd::RandomPurpose::kActionNoise, count, static_cast<int>(size),
                    deviates.data());
  for (std::size_t i = 0; i < deviates.size(); ++i) {
    action[i] += std::exp(log_std[i % size]) * deviates[i];
  }
}

void FillUniform(const Agent::Turn& turn, int count, int size, float* action) {
  for (int i = 0; i < count; ++i) {
    simd::RandomKey key;
    key.seed = turn.seed;
    key.a = turn.first_aircraft + static_cast<std::uint32_t>(i);
    key.b = turn.policy_step;
    key.purpose = simd::RandomPurpose::kActionNoise;
    simd::RandomStream stream(key);
    for (int k = 0; k < size; ++k) *action++ = static_cast<float>(stream.Uniform(-1, 1));
  }
}

}  // namespace

Agent::Agent(std::shared_ptr<const Policy> policy, Sampling sampling)
    : policy_(std::move(policy)), sampling_(sampling) {}

Agent::Agent(const RecurrentPolicy& policy, Sampling sampling)
    : recurrent_(std::make_shared<RecurrentPolicy>(policy)), sampling_(sampling) {
  policy_ = recurrent_;
}

Agent Agent::Of(std::shared_ptr<const Policy> policy) {
  if (const auto* recurrent = dynamic_cast<const RecurrentPolicy*>(policy.get())) {
    return MeanOf(*recurrent);
  }
  return {std::move(policy), Sampling::kNone};
}

Agent Agent::MeanOf(const RecurrentPolicy& policy) { return {policy, Sampling::kNone}; }

Agent Agent::SamplingFrom(const RecurrentPolicy& policy) { return {policy, Sampling::kNormal}; }

Agent Agent::Random(int action_repeat) {
  return {std::make_shared<ZeroPolicy>(action_repeat), Sampling::kUniform};
}

Agent Agent::Zero() { return Of(std::make_shared<ZeroPolicy>(1)); }

std::shared_ptr<const Policy> Agent::low_level() const {
  return recurrent_ == nullptr ? nullptr : recurrent_->low_level();
}

void Agent::CheckFits(const VecEnv& env) const {
  policy_->CheckMadeFor(env.config(), "the policy");
  const int observed = policy_->observation_size();
  if ((observed == 0 || observed == env.observation_size()) &&
      policy_->action_size() == env.action_size()) {
    return;
  }
  throw Error("the policy takes " + std::to_string(policy_->observation_size()) +
              " observations and gives " + std::to_string(policy_->action_size()) +
              " actions; task \"" + env.config().task + "\" has " +
              std::to_string(env.observation_size()) + " and " + std::to_string(env.action_size()));
}

void Agent::Act(const Turn& turn, int count, const float* observation, float* state,
                float* action) const {
  switch (sampling_) {
    case Sampling::kNone:
      policy_->Act(count, observation, state, action);
      return;
    case Sampling::kNormal: {
      std::vector<float> log_std(recurrent_->action_size());
      recurrent_->ActionMean(count, observation, state, action, log_std.data());
      AddNormals(turn, count, log_std, action);
      return;
    }
    case Sampling::kUniform:
      FillUniform(turn, count, policy_->action_size(), action);
      return;
  }
}

}  // namespace skein
