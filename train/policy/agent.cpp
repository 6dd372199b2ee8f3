#include "train/policy/agent.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "envs/actions.h"
#include "envs/tasks/observation.h"
#include "base/error.h"
#include "simd/random.h"
#include "train/policy/policy_environment.h"

namespace skein {
namespace {

/// Leaves every command at zero.
class IdlePilot final : public Pilot {
 public:
  explicit IdlePilot(int action_repeat) : action_repeat_(action_repeat) {}

  int observation_size() const override { return kObservationSize; }
  int action_size() const override { return kActionSize; }
  int state_size() const override { return 0; }
  int action_repeat() const override { return action_repeat_; }
  void Fly(int count, const float*, float*, float* action) const override {
    std::fill_n(action, static_cast<std::ptrdiff_t>(count) * kActionSize, 0.0f);
  }

 private:
  int action_repeat_;
};

void AddNormals(const Agent::Turn& turn, int count, const std::vector<float>& log_std,
                float* action) {
  const std::size_t size = log_std.size();
  std::vector<float> deviates(count * size);
  const std::vector<std::uint32_t> decision_low(count, turn.decision), decision_high(count, 0);
  simd::FillNormals(turn.seed, turn.first_aircraft, decision_low.data(), decision_high.data(),
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
    key.b = turn.decision;
    key.purpose = simd::RandomPurpose::kActionNoise;
    simd::RandomStream stream(key);
    for (int k = 0; k < size; ++k) *action++ = static_cast<float>(stream.Uniform(-1, 1));
  }
}

}  // namespace

Agent::Agent(std::shared_ptr<const Pilot> pilot, Chance chance)
    : pilot_(std::move(pilot)), chance_(chance) {}

Agent::Agent(const Policy& policy, Chance chance)
    : policy_(std::make_shared<Policy>(policy)), chance_(chance) {
  pilot_ = policy_;
}

Agent Agent::Of(std::shared_ptr<const Pilot> pilot) { return {std::move(pilot), Chance::kNone}; }

Agent Agent::MeanOf(const Policy& policy) { return {policy, Chance::kNone}; }

Agent Agent::SamplingFrom(const Policy& policy) { return {policy, Chance::kNormal}; }

Agent Agent::Random(int action_repeat) {
  return {std::make_shared<IdlePilot>(action_repeat), Chance::kUniform};
}

Agent Agent::Idle() { return Of(std::make_shared<IdlePilot>(1)); }

std::shared_ptr<const Pilot> Agent::controller() const {
  return policy_ == nullptr ? nullptr : policy_->controller();
}

void Agent::CheckFits(const VecEnv& env) const {
  CheckMadeFor(env.config(), *pilot_, "the policy");
  if (pilot_->observation_size() == env.observation_size() &&
      pilot_->action_size() == env.action_size()) {
    return;
  }
  throw Error("the policy takes " + std::to_string(pilot_->observation_size()) +
              " observations and gives " + std::to_string(pilot_->action_size()) +
              " actions; task \"" + env.config().task + "\" has " +
              std::to_string(env.observation_size()) + " and " + std::to_string(env.action_size()));
}

void Agent::Decide(const Turn& turn, int count, const float* observation, float* state,
                   float* action) const {
  switch (chance_) {
    case Chance::kNone:
      pilot_->Fly(count, observation, state, action);
      return;
    case Chance::kNormal: {
      std::vector<float> log_std(policy_->action_size());
      policy_->Act(count, observation, state, action, log_std.data());
      AddNormals(turn, count, log_std, action);
      return;
    }
    case Chance::kUniform:
      FillUniform(turn, count, pilot_->action_size(), action);
      return;
  }
}

}  // namespace skein
