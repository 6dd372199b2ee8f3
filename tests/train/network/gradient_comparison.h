// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "train/network/backend.h"
#include "train/network/network.h"
#include "train/network/recurrent_network.h"

namespace skein {

/// Precisions that a learner can run in.
inline constexpr std::array<LearnerPrecision, 5> kRunnablePrecisions{
    LearnerPrecision::kFloat32, LearnerPrecision::kMixed, LearnerPrecision::kBfloat16,
    LearnerPrecision::kFast, LearnerPrecision::kAmx};

inline NetworkPrecision PrecisionOf(const NetworkShape& shape, LearnerPrecision precision) {
  return shape.gaussian ? ActorPrecision(precision) : CriticPrecision(precision);
}

/// Weights of a tile of `samples` with every term of the losses.
inline LossSettings FullLossSettings(int samples) {
  LossSettings settings;
  settings.sample_weight = settings.pair_weight = 1.0 / samples;
  settings.entropy_coefficient = 0.01;
  settings.value_coefficient = 0.7;
  settings.action_smoothness_coefficient = 0.5;
  return settings;
}

/// Norm of the difference over the norm of `reference`.
inline double RelativeDifference(const std::vector<float>& values,
                                 const std::vector<double>& reference) {
  double difference = 0, norm = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    difference += (values[i] - reference[i]) * (values[i] - reference[i]);
    norm += reference[i] * reference[i];
  }
  return std::sqrt(difference / norm);
}

/// Cosine of the angle between the two.
inline double Cosine(const std::vector<float>& values, const std::vector<double>& reference) {
  double dot = 0, squares = 0, reference_squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    dot += values[i] * reference[i];
    squares += static_cast<double>(values[i]) * values[i];
    reference_squares += reference[i] * reference[i];
  }
  return dot / std::sqrt(squares * reference_squares);
}

/// The gradient of one tile by a network that has `parameters`, and its losses in `sums`.
inline std::vector<float> GradientBy(const RecurrentNetwork& network, const float* parameters,
                                     const SampleTile& tile, const LossSettings& settings,
                                     LossSums* sums = nullptr) {
  NetworkWorkspace workspace;
  std::vector<float> accumulator(network.accumulator_size(), 0.0f), flat(network.layout().size());
  const LossSums done = network.AccumulateGradient(tile, settings, workspace, accumulator.data());
  if (sums != nullptr) *sums = done;
  network.FinishGradient(parameters, accumulator.data(), flat.data());
  return flat;
}

inline std::vector<float> GradientBy(Backend backend, const NetworkLayout& layout,
                                     const std::vector<float>& parameters, const SampleTile& tile,
                                     const LossSettings& settings, LossSums* sums = nullptr,
                                     const NetworkPrecision& precision = {}) {
  const auto network = MakeNetwork(backend, layout, precision);
  network->SetParameters(parameters.data());
  return GradientBy(*network, parameters.data(), tile, settings, sums);
}

}  // namespace skein
