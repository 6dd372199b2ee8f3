// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "envs/tuning/closed_loop_model.h"

namespace skein {

/// What a column of a closed loop's memory (ClosedLoopMemory) is called.
ModelVariable ClosedLoopVariable(int column);

/// What the columns of ClosedLoopModel::B stand for.
std::vector<ModelVariable> ClosedLoopInputs(LoopAxis axis);

/// What is measured of a closed loop's axis before a step, y = C x.
struct ClosedLoopOutputs {
  std::vector<ModelVariable> outputs;
  Eigen::MatrixXd C;
};

/// By central differences about the trim of `model`.
ClosedLoopOutputs LineariseOutputs(const Plant& plant, const TrimPoint& trim, LoopAxis axis,
                                   const ClosedLoopModel& model);

}  // namespace skein
