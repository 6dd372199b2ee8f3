// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/heading.h"

#include <algorithm>
#include <cmath>

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/tasks/heading.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/tasks/flight-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// Target minus actual, in ft, rad and ft/s.
struct HeadingError {
  V altitude, yaw, speed;
};

HWY_INLINE HeadingError ErrorOf(const Tile& flight, const Tile& task, int first) {
  HeadingError error;
  error.altitude = hn::Add(Column(task, kTargetAltitude, first), Column(flight, kDown, first));
  error.yaw = WrapAngle(hn::Sub(Column(task, kTargetYaw, first), Yaw(flight, first)));
  error.speed = hn::Sub(Column(task, kTargetSpeed, first), Velocity(flight, first).speed);
  return error;
}

HWY_INLINE HeadingError Normalised(const HeadingError& error, const ReferenceUnits& units) {
  return {hn::Mul(error.altitude, Constant(1 / units.altitude_error_ft)), error.yaw,
          hn::Mul(error.speed, Constant(1 / units.speed_ft_s))};
}

HWY_INLINE void Store(const HeadingError& error, float* errors, std::size_t error_stride,
                      int first) {
  const FloatTag d;
  hn::StoreU(error.altitude, d, errors + first);
  hn::StoreU(error.yaw, d, errors + error_stride + first);
  hn::StoreU(error.speed, d, errors + 2 * error_stride + first);
}

void HeadingErrors(Tile flight, Tile task, const ReferenceUnits& units, float* errors,
                   std::size_t error_stride) {
  for (int first = 0; first < flight.count; first += kLanes) {
    Store(Normalised(ErrorOf(flight, task, first), units), errors, error_stride, first);
  }
}

void HeadingReward(Tile flight, Tile task, const HeadingConfig& config, const ReferenceUnits& units,
                   const std::int32_t* steps_before, const StepResult& step_result) {
  const FloatTag d;
  const IntTag di;
  const auto one = hn::Set(di, 1);
  const auto earliest = hn::Set(di, config.earliest_success_step - 1);
  const V altitude_tolerance = Constant(config.altitude_tolerance_ft);
  const V yaw_tolerance = Constant(config.yaw_tolerance_deg / kDegPerRad);
  const V speed_tolerance = Constant(config.speed_tolerance_fps);
  const V norm_weight = Constant(config.error_norm_weight);
  const V speed_weight = Constant(config.speed_error_weight);
  const V altitude_weight = Constant(config.altitude_error_weight);
  const V yaw_weight = Constant(config.yaw_error_weight);
  for (int first = 0; first < flight.count; first += kLanes) {
    const HeadingError error = ErrorOf(flight, task, first);
    const HeadingError scaled = Normalised(error, units);
    if (step_result.errors != nullptr) {
      Store(scaled, step_result.errors, step_result.error_stride, first);
    }
    const V squares =
        hn::MulAdd(scaled.altitude, scaled.altitude,
                   hn::MulAdd(scaled.yaw, scaled.yaw, hn::Mul(scaled.speed, scaled.speed)));
    const V norm = hn::Mul(norm_weight, hn::Sqrt(squares));
    const V far = hn::MulAdd(altitude_weight, hn::Abs(scaled.altitude),
                             hn::MulAdd(speed_weight, hn::Abs(scaled.speed), norm));
    const V cost = hn::MulAdd(yaw_weight, hn::Abs(scaled.yaw), far);
    hn::StoreU(hn::Neg(cost), d, step_result.reward + first);

    const V share = Column(task, kTargetTolerance, first);
    const auto close =
        hn::And(hn::Lt(hn::Abs(error.altitude), hn::Mul(share, altitude_tolerance)),
                hn::And(hn::Lt(hn::Abs(error.yaw), hn::Mul(share, yaw_tolerance)),
                        hn::Lt(hn::Abs(error.speed), hn::Mul(share, speed_tolerance))));
    const auto early = hn::Gt(earliest, hn::LoadU(di, steps_before + first));
    const auto reached =
        hn::AndNot(hn::VecFromMask(di, early), hn::VecFromMask(di, hn::RebindMask(di, close)));
    hn::StoreU(hn::And(reached, one), di, step_result.reached + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
namespace {

HWY_EXPORT(HeadingErrors);
HWY_EXPORT(HeadingReward);

class HeadingTask : public Task {
 public:
  HeadingTask(const HeadingConfig& config, const ReferenceUnits& units, const TargetLimits& limits)
      : config_(config), limits_(limits), units_(units) {}

  int num_columns() const override { return kNumHeadingColumns; }
  int num_targets() const override { return kTargetSpeed + 1; }
  std::vector<TargetQuantity> target_quantities() const override {
    return {{"altitude_ft", false, units_.altitude_error_ft, config_.altitude_tolerance_ft},
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
    const double altitude =
        std::max(limits_.Altitude(around(start.altitude_ft, config_.altitude_change_ft)),
                 start.lowest_altitude_ft);
    task[kTargetAltitude][index] = static_cast<float>(altitude);
    const double yaw = around(start.yaw_rad, config_.yaw_change_rad);
    task[kTargetYaw][index] = static_cast<float>(std::remainder(yaw, 2 * M_PI));
    const double speed = around(start.true_airspeed_ft_s, config_.speed_change_fps);
    task[kTargetSpeed][index] = static_cast<float>(limits_.TrueAirspeed(speed, altitude));
    task[kTargetTolerance][index] =
        static_cast<float>(random->Uniform(config_.training_tolerance_min, 1));
  }

  float ToleranceShare(Tile task, int index) const override {
    return task[kTargetTolerance][index];
  }

  void Errors(Tile flight, Tile task, float* errors, std::size_t error_stride) const override {
    SKEIN_DISPATCH(HeadingErrors)(flight, task, units_, errors, error_stride);
  }

  void ComputeReward(Tile flight, Tile task, const std::int32_t* steps_before,
                     const StepResult& step_result) const override {
    SKEIN_DISPATCH(HeadingReward)(flight, task, config_, units_, steps_before, step_result);
  }

 private:
  HeadingConfig config_;
  TargetLimits limits_;
  ReferenceUnits units_;
};

}  // namespace

std::unique_ptr<Task> MakeHeadingTask(const HeadingConfig& config, const ReferenceUnits& units,
                                      const TargetLimits& limits) {
  return std::make_unique<HeadingTask>(config, units, limits);
}

}  // namespace skein
#endif
