// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/control.h"

#include <algorithm>
#include <cmath>

#include "envs/state/attitude.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/tasks/control.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/tasks/flight-inl.h"
#include "envs/tasks/relative_attitude-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// Target minus actual, in rad and ft/s.
struct ControlError {
  V pitch, yaw, speed;
};

HWY_INLINE ControlError ErrorOf(const Tile& flight, const Tile& task, int first) {
  ControlError error;
  error.pitch = hn::Sub(Column(task, kControlPitch, first), Pitch(flight, first));
  error.yaw = WrapAngle(hn::Sub(Column(task, kControlYaw, first), Yaw(flight, first)));
  error.speed = hn::Sub(Column(task, kControlSpeed, first), Velocity(flight, first).speed);
  return error;
}

HWY_INLINE V NormalisedSpeed(V speed, const ReferenceUnits& units) {
  return hn::Mul(speed, Constant(1 / units.speed_ft_s));
}

HWY_INLINE void StoreNormalised(const ControlError& error, const ReferenceUnits& units,
                                float* errors, std::size_t error_stride, int first) {
  const FloatTag d;
  hn::StoreU(error.pitch, d, errors + first);
  hn::StoreU(error.yaw, d, errors + error_stride + first);
  hn::StoreU(NormalisedSpeed(error.speed, units), d, errors + 2 * error_stride + first);
}

void ControlErrors(Tile flight, Tile task, const ReferenceUnits& units, float* errors,
                   std::size_t error_stride) {
  for (int first = 0; first < flight.count; first += kLanes) {
    StoreNormalised(ErrorOf(flight, task, first), units, errors, error_stride, first);
  }
}

void ControlReward(Tile flight, Tile task, const ControlConfig& config, const ReferenceUnits& units,
                   const StepResult& step_result) {
  const FloatTag d;
  const IntTag di;
  const auto one = hn::Set(di, 1);
  const V pitch_tolerance = Constant(config.pitch_tolerance_deg / kDegPerRad);
  const V yaw_tolerance = Constant(config.yaw_tolerance_deg / kDegPerRad);
  const V speed_tolerance = Constant(config.speed_tolerance_fps);
  const V angle_weight = Constant(config.angle_error_weight);
  const V speed_weight = Constant(config.speed_error_weight);
  for (int first = 0; first < flight.count; first += kLanes) {
    const ControlError error = ErrorOf(flight, task, first);
    if (step_result.errors != nullptr) {
      StoreNormalised(error, units, step_result.errors, step_result.error_stride, first);
    }
    const V speed_error = hn::Abs(error.speed);
    const V share = Column(task, kControlTolerance, first);
    const RelativeAttitude relative = RelativeTo(flight, task, kControlQ0, first);
    const V angle = config.reward_includes_roll ? RotationAngle(relative) : NoseAngle(relative);
    const V cost =
        hn::MulAdd(speed_weight, NormalisedSpeed(speed_error, units), hn::Mul(angle_weight, angle));
    hn::StoreU(hn::Neg(cost), d, step_result.reward + first);

    const auto reached = hn::And(hn::Lt(hn::Abs(error.pitch), hn::Mul(share, pitch_tolerance)),
                                 hn::And(hn::Lt(hn::Abs(error.yaw), hn::Mul(share, yaw_tolerance)),
                                         hn::Lt(speed_error, hn::Mul(share, speed_tolerance))));
    hn::StoreU(hn::And(hn::VecFromMask(di, hn::RebindMask(di, reached)), one), di,
               step_result.reached + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
namespace {

HWY_EXPORT(ControlErrors);
HWY_EXPORT(ControlReward);

/// Reflects a pitch beyond the vertical back: the elevation at which its nose points.
double Folded(double pitch_rad) { return std::asin(std::sin(pitch_rad)); }

class ControlTask : public Task {
 public:
  ControlTask(const ControlConfig& config, const ReferenceUnits& units, const TargetLimits& limits)
      : config_(config), limits_(limits), units_(units) {}

  int num_columns() const override { return kNumControlColumns; }
  int num_targets() const override { return kControlSpeed + 1; }
  std::vector<TargetQuantity> target_quantities() const override {
    return {{"pitch_deg", true, kDegPerRad, config_.pitch_tolerance_deg},
            {"yaw_deg", true, kDegPerRad, config_.yaw_tolerance_deg},
            {"true_airspeed_fps", false, units_.speed_ft_s, config_.speed_tolerance_fps}};
  }

  double dwell_s() const override { return config_.dwell_s; }
  bool rewards_by_errors() const override { return true; }

  void Reset(const FlightStart& start, simd::RandomStream* random, Tile task,
             int index) const override {
    const auto around = [random](double centre, double change) {
      return centre + random->Uniform(-change, change);
    };
    EulerAngles attitude;
    attitude.pitch =
        std::max(Folded(around(start.pitch_rad, config_.pitch_change_rad)), start.lowest_pitch_rad);
    attitude.yaw = std::remainder(around(start.yaw_rad, config_.yaw_change_rad), 2 * M_PI);
    const double speed = limits_.TrueAirspeed(
        around(start.true_airspeed_ft_s, config_.speed_change_fps), start.altitude_ft);
    const auto set = [task, index](int column, double value) {
      task[column][index] = static_cast<float>(value);
    };
    set(kControlPitch, attitude.pitch);
    set(kControlYaw, attitude.yaw);
    set(kControlSpeed, speed);
    SetAttitude(attitude, task, index);
    set(kControlTolerance, random->Uniform(config_.training_tolerance_min, 1));
  }

  void FollowTargets(Tile task, int index) const override {
    EulerAngles attitude;
    attitude.pitch = task[kControlPitch][index];
    attitude.yaw = task[kControlYaw][index];
    SetAttitude(attitude, task, index);
  }

  float ToleranceShare(Tile task, int index) const override {
    return task[kControlTolerance][index];
  }

  void Errors(Tile flight, Tile task, float* errors, std::size_t error_stride) const override {
    SKEIN_DISPATCH(ControlErrors)(flight, task, units_, errors, error_stride);
  }

  void ComputeReward(Tile flight, Tile task, const std::int32_t* /*steps_before*/,
                     const StepResult& step_result) const override {
    SKEIN_DISPATCH(ControlReward)(flight, task, config_, units_, step_result);
  }

 private:
  static void SetAttitude(const EulerAngles& attitude, Tile task, int index) {
    const Eigen::Vector4d quaternion = QuaternionFromEuler(attitude);
    for (int k = 0; k < 4; ++k) task[kControlQ0 + k][index] = static_cast<float>(quaternion[k]);
  }

  ControlConfig config_;
  TargetLimits limits_;
  ReferenceUnits units_;
};

}  // namespace

std::unique_ptr<Task> MakeControlTask(const ControlConfig& config, const ReferenceUnits& units,
                                      const TargetLimits& limits) {
  return std::make_unique<ControlTask>(config, units, limits);
}

}  // namespace skein
#endif
