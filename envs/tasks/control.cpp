// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/control.h"

#include <cmath>

#include "envs/state/attitude.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/tasks/control.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/tasks/flight-inl.h"
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

/// The rotation from the attitude to the target's: conj(q) t, as scalar and vector part.
struct RelativeAttitude {
  V scalar, x, y, z;
};

HWY_INLINE RelativeAttitude RelativeTo(const Tile& flight, const Tile& task, int first) {
  const V q0 = Column(flight, kQ0, first), qx = Column(flight, kQx, first);
  const V qy = Column(flight, kQy, first), qz = Column(flight, kQz, first);
  const V t0 = Column(task, kControlQ0, first), tx = Column(task, kControlQx, first);
  const V ty = Column(task, kControlQy, first), tz = Column(task, kControlQz, first);
  const auto sum = [](V a, V b, V c, V e) { return hn::MulAdd(a, b, hn::Mul(c, e)); };
  RelativeAttitude relative;
  relative.scalar = hn::Add(sum(q0, t0, qx, tx), sum(qy, ty, qz, tz));
  // Differences of products that nearly cancel where the angle is small.
  relative.x = hn::Sub(sum(q0, tx, qz, ty), sum(t0, qx, qy, tz));
  relative.y = hn::Sub(sum(q0, ty, qx, tz), sum(t0, qy, qz, tx));
  relative.z = hn::Sub(sum(q0, tz, qy, tx), sum(t0, qz, qx, ty));
  return relative;
}

/// The angle of the rotation, rad. By the arc tangent of its parts: the arc cosine of the scalar
/// part alone would lose half of the digits where the angle is small.
HWY_INLINE V RotationAngle(const RelativeAttitude& r) {
  const V length = hn::Sqrt(hn::MulAdd(r.x, r.x, hn::MulAdd(r.y, r.y, hn::Mul(r.z, r.z))));
  // A quaternion and its negative are one attitude: the nearer of the two.
  const V half = Atan2(FloatTag(), length, hn::Abs(r.scalar));
  return hn::Add(half, half);
}

/// The angle between the nose and where the target's points, rad: the rotation turns body x into
/// the vector (along, 2 (x y + s z), 2 (x z - s y)).
HWY_INLINE V NoseAngle(const RelativeAttitude& r) {
  const V along = hn::MulAdd(
      r.scalar, r.scalar, hn::MulAdd(r.x, r.x, hn::Neg(hn::MulAdd(r.y, r.y, hn::Mul(r.z, r.z)))));
  const V right = TwiceSum(r.x, r.y, r.scalar, r.z);
  const V down = TwiceSum(r.x, r.z, hn::Neg(r.scalar), r.y);
  return Atan2(FloatTag(), hn::Sqrt(hn::MulAdd(right, right, hn::Mul(down, down))), along);
}

void ControlErrors(Tile flight, Tile task, const ReferenceUnits& units, float* errors,
                   std::size_t error_stride) {
  const FloatTag d;
  for (int first = 0; first < flight.count; first += kLanes) {
    const ControlError error = ErrorOf(flight, task, first);
    hn::StoreU(error.pitch, d, errors + first);
    hn::StoreU(error.yaw, d, errors + error_stride + first);
    hn::StoreU(NormalisedSpeed(error.speed, units), d, errors + 2 * error_stride + first);
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
  const V speed_weight = Constant(config.speed_error_weight);
  for (int first = 0; first < flight.count; first += kLanes) {
    const ControlError error = ErrorOf(flight, task, first);
    const V speed_error = hn::Abs(error.speed);
    const V share = Column(task, kControlTolerance, first);
    const RelativeAttitude relative = RelativeTo(flight, task, first);
    const V angle = config.reward_includes_roll ? RotationAngle(relative) : NoseAngle(relative);
    const V cost = hn::MulAdd(speed_weight, NormalisedSpeed(speed_error, units), angle);
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

  void Reset(const FlightStart& start, simd::RandomStream* random, Tile task,
             int index) const override {
    const auto around = [random](double centre, double change) {
      return centre + random->Uniform(-change, change);
    };
    EulerAngles attitude;
    attitude.pitch = Folded(around(start.pitch_rad, config_.pitch_change_rad));
    attitude.yaw = std::remainder(around(start.yaw_rad, config_.yaw_change_rad), 2 * M_PI);
    const double speed = limits_.TrueAirspeed(
        around(start.true_airspeed_ft_s, config_.speed_change_fps), start.altitude_ft);
    const Eigen::Vector4d quaternion = QuaternionFromEuler(attitude);

    const auto set = [task, index](int column, double value) {
      task[column][index] = static_cast<float>(value);
    };
    set(kControlPitch, attitude.pitch);
    set(kControlYaw, attitude.yaw);
    set(kControlSpeed, speed);
    for (int k = 0; k < 4; ++k) set(kControlQ0 + k, quaternion[k]);
    set(kControlTolerance, random->Uniform(config_.training_tolerance_min, 1));
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
