// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/adam.h"

#include <torch/optim/adam.h>
#include <torch/types.h>

#include <algorithm>

#include "train/libtorch/libtorch_threads.h"

namespace skein {
namespace {

std::vector<float> ToVector(const torch::Tensor& tensor) {
  return {tensor.data_ptr<float>(), tensor.data_ptr<float>() + tensor.numel()};
}

torch::Tensor ToTensor(const std::vector<float>& values) {
  return torch::from_blob(const_cast<float*>(values.data()),
                          {static_cast<std::int64_t>(values.size())}, torch::kFloat32)
      .clone();
}

}  // namespace

struct AdamOptimiser::Impl {
  torch::Tensor parameters;
  std::unique_ptr<torch::optim::Adam> adam;

  /// LibTorch makes an optimiser's memory at its first step; this makes it at once.
  torch::optim::AdamParamState& Memory() {
    auto& memory = adam->state()[c10::guts::to_string(parameters.unsafeGetTensorImpl())];
    if (!memory) {
      auto fresh = std::make_unique<torch::optim::AdamParamState>();
      fresh->step(0);
      fresh->exp_avg(torch::zeros_like(parameters));
      fresh->exp_avg_sq(torch::zeros_like(parameters));
      memory = std::move(fresh);
    }
    return static_cast<torch::optim::AdamParamState&>(*memory);
  }
};

AdamOptimiser::AdamOptimiser(const std::vector<float>& parameters, double epsilon)
    : impl_(std::make_unique<Impl>()) {
  UseOneLibTorchThread();
  impl_->parameters = ToTensor(parameters).requires_grad_(true);
  impl_->parameters.mutable_grad() = torch::zeros(impl_->parameters.sizes());
  impl_->adam = std::make_unique<torch::optim::Adam>(std::vector<torch::Tensor>{impl_->parameters},
                                                     torch::optim::AdamOptions().eps(epsilon));
  impl_->Memory();
}

AdamOptimiser::~AdamOptimiser() = default;
AdamOptimiser::AdamOptimiser(AdamOptimiser&&) noexcept = default;

std::int64_t AdamOptimiser::size() const { return impl_->parameters.numel(); }
float* AdamOptimiser::parameters() { return impl_->parameters.data_ptr<float>(); }
const float* AdamOptimiser::parameters() const { return impl_->parameters.data_ptr<float>(); }
float* AdamOptimiser::gradient() { return impl_->parameters.mutable_grad().data_ptr<float>(); }

void AdamOptimiser::Step(double learning_rate) {
  static_cast<torch::optim::AdamOptions&>(impl_->adam->param_groups()[0].options())
      .lr(learning_rate);
  impl_->adam->step();
}

AdamState AdamOptimiser::state() const {
  const torch::optim::AdamParamState& memory = impl_->Memory();
  return {memory.step(), ToVector(memory.exp_avg()), ToVector(memory.exp_avg_sq())};
}

void AdamOptimiser::Restore(const AdamState& state) {
  torch::optim::AdamParamState& memory = impl_->Memory();
  memory.step(state.step);
  memory.exp_avg(ToTensor(state.first_moment));
  memory.exp_avg_sq(ToTensor(state.second_moment));
}

}  // namespace skein
