// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/tracking.h"

#include <cmath>

#include "envs/state/attitude.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/tasks/tracking.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/tasks/flight-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// The target's position relative to the aircraft's, ft.
struct TrackingError {
  V north, east, up;
};

HWY_INLINE TrackingError ErrorOf(const Tile& flight, const Tile& task, int first) {
  return {hn::Sub(Column(task, kTrackingNorth, first), Column(flight, kNorth, first)),
          hn::Sub(Column(task, kTrackingEast, first), Column(flight, kEast, first)),
          hn::Add(Column(task, kTrackingAltitude, first), Column(flight, kDown, first))};
}

/// The same from where the control step began.
HWY_INLINE TrackingError LastErrorOf(const Tile& task, int first) {
  return {
      hn::Sub(Column(task, kTrackingNorth, first), Column(task, kTrackingLastNorth, first)),
      hn::Sub(Column(task, kTrackingEast, first), Column(task, kTrackingLastEast, first)),
      hn::Sub(Column(task, kTrackingAltitude, first), Column(task, kTrackingLastAltitude, first))};
}

HWY_INLINE V InUnits(V distance, double unit_ft) {
  return hn::Mul(distance, Constant(1 / unit_ft));
}

/// Turns north and east into ahead and right of the heading. An aircraft that points straight up or
/// down has none: north counts as it.
HWY_INLINE void TurnIntoHeading(const Tile& flight, int first, V& north_or_ahead,
                                V& east_or_right) {
  const NoseOverGround nose = Nose(flight, first);
  const V square = hn::MulAdd(nose.north, nose.north, hn::Mul(nose.east, nose.east));
  const auto has_heading = hn::Gt(square, Constant(1e-12));
  V length, per_length;
  Length(square, length, per_length);
  const V cosine = hn::IfThenElse(has_heading, hn::Mul(nose.north, per_length), Constant(1));
  const V sine = hn::IfThenElseZero(has_heading, hn::Mul(nose.east, per_length));
  const V north = north_or_ahead, east = east_or_right;
  north_or_ahead = hn::MulAdd(north, cosine, hn::Mul(east, sine));
  east_or_right = hn::NegMulAdd(north, sine, hn::Mul(east, cosine));
}

/// Turns north, east and up into along, right of and above the path over ground. A path straight
/// up or down, or none, has no course: north counts as it.
HWY_INLINE void TurnIntoPath(const Tile& flight, int first, TrackingError& error) {
  const auto get = [&](int column) HWY_ATTR { return Column(flight, column, first); };
  const auto t = AttitudeMatrixOf(get(kQ0), get(kQx), get(kQy), get(kQz));
  const V u = get(kU), v = get(kV), w = get(kW);
  const auto component = [&](V of_u, V of_v, V of_w) HWY_ATTR {
    return hn::MulAdd(of_u, u, hn::MulAdd(of_v, v, hn::Mul(of_w, w)));
  };
  const V north = component(t.t11, t.t21, t.t31);
  const V east = component(t.t12, t.t22, t.t32);
  const V down = component(t.t13, t.t23, t.t33);
  const V level_squared = hn::MulAdd(north, north, hn::Mul(east, east));
  V level, per_level, speed, per_speed;
  Length(level_squared, level, per_level);
  Length(hn::MulAdd(down, down, level_squared), speed, per_speed);
  const auto has_course = hn::Gt(level_squared, Constant(1e-6));
  const V course_cosine = hn::IfThenElse(has_course, hn::Mul(north, per_level), Constant(1));
  const V course_sine = hn::IfThenElseZero(has_course, hn::Mul(east, per_level));
  const auto has_path = hn::Gt(speed, Constant(1e-3));
  const V climb_cosine = hn::IfThenElse(has_path, hn::Mul(level, per_speed), Constant(1));
  const V climb_sine = hn::IfThenElseZero(has_path, hn::Neg(hn::Mul(down, per_speed)));

  const V ahead = hn::MulAdd(error.north, course_cosine, hn::Mul(error.east, course_sine));
  error.east = hn::NegMulAdd(error.north, course_sine, hn::Mul(error.east, course_cosine));
  error.north = hn::MulAdd(ahead, climb_cosine, hn::Mul(error.up, climb_sine));
  error.up = hn::NegMulAdd(ahead, climb_sine, hn::Mul(error.up, climb_cosine));
}

void TrackingErrors(Tile flight, Tile task, TrackingAxes axes, double unit_ft, float* errors,
                    std::size_t error_stride) {
  const FloatTag d;
  for (int first = 0; first < flight.count; first += kLanes) {
    TrackingError error = ErrorOf(flight, task, first);
    if (axes == TrackingAxes::kHeading) TurnIntoHeading(flight, first, error.north, error.east);
    if (axes == TrackingAxes::kPath) TurnIntoPath(flight, first, error);
    hn::StoreU(InUnits(error.north, unit_ft), d, errors + first);
    hn::StoreU(InUnits(error.east, unit_ft), d, errors + error_stride + first);
    hn::StoreU(InUnits(error.up, unit_ft), d, errors + 2 * error_stride + first);
  }
}

/// Shares of a path, from 0 at its beginning to 1 at its end: where it enters and leaves the box.
struct PathInBox {
  V enters, leaves;
};

/// Cuts off what lies outside the slab abs(error) <= tolerance of one axis.
HWY_INLINE void CutBySlab(V begin, V end, V tolerance, PathInBox& path) {
  const V change = hn::Sub(end, begin);
  // A path along the slab is inside all the way or not at all: far crossings say which.
  const V along = hn::IfThenElse(hn::Eq(change, hn::Zero(FloatTag())), Constant(1e-20), change);
  const V one = hn::Div(hn::Sub(hn::Neg(tolerance), begin), along);
  const V other = hn::Div(hn::Sub(tolerance, begin), along);
  path.enters = hn::Max(path.enters, hn::Min(one, other));
  path.leaves = hn::Min(path.leaves, hn::Max(one, other));
}

void TrackingReward(Tile flight, Tile task, double unit_ft, const StepResult& step_result) {
  const FloatTag d;
  const IntTag di;
  for (int first = 0; first < flight.count; first += kLanes) {
    const TrackingError begin = LastErrorOf(task, first);
    const TrackingError end = ErrorOf(flight, task, first);
    const V square =
        hn::MulAdd(end.north, end.north, hn::MulAdd(end.east, end.east, hn::Mul(end.up, end.up)));
    const V cost = InUnits(hn::Sqrt(square), unit_ft);
    hn::StoreU(hn::Neg(cost), d, step_result.reward + first);

    const V tolerance = Column(task, kTrackingTolerance, first);
    PathInBox path{hn::Zero(d), Constant(1)};
    CutBySlab(begin.north, end.north, tolerance, path);
    CutBySlab(begin.east, end.east, tolerance, path);
    CutBySlab(begin.up, end.up, tolerance, path);
    // Minima and maxima may lose a NaN; the cost has it still.
    const auto reached = hn::And(hn::Le(path.enters, path.leaves), hn::Eq(cost, cost));
    hn::StoreU(hn::And(hn::VecFromMask(di, hn::RebindMask(di, reached)), hn::Set(di, 1)), di,
               step_result.reached + first);

    hn::StoreU(Column(flight, kNorth, first), d, task[kTrackingLastNorth] + first);
    hn::StoreU(Column(flight, kEast, first), d, task[kTrackingLastEast] + first);
    hn::StoreU(hn::Neg(Column(flight, kDown, first)), d, task[kTrackingLastAltitude] + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
namespace {

HWY_EXPORT(TrackingErrors);
HWY_EXPORT(TrackingReward);

class TrackingTask : public Task {
 public:
  TrackingTask(const TrackingConfig& config, double unit_ft, const TargetLimits& limits)
      : config_(config), limits_(limits), unit_ft_(unit_ft) {}

  int num_columns() const override { return kNumTrackingColumns; }
  int num_targets() const override { return kTrackingAltitude + 1; }
  std::vector<TargetQuantity> target_quantities() const override {
    return {{"north_ft", false, unit_ft_, config_.position_tolerance_ft},
            {"east_ft", false, unit_ft_, config_.position_tolerance_ft},
            {"altitude_ft", false, unit_ft_, config_.position_tolerance_ft}};
  }

  bool is_point() const override { return true; }

  void Reset(const FlightStart& start, simd::RandomStream* random, Tile task,
             int index) const override {
    const auto around = [random](double centre_rad, double change_deg) {
      const double change_rad = change_deg / kDegPerRad;
      return centre_rad + random->Uniform(-change_rad, change_rad);
    };
    const double distance = random->Uniform(config_.distance_ft.min, config_.distance_ft.max);
    const double azimuth = around(start.yaw_rad, config_.azimuth_deg);
    const double elevation = around(start.pitch_rad, config_.elevation_deg);

    const auto set = [task, index](int column, double value) {
      task[column][index] = static_cast<float>(value);
    };
    set(kTrackingNorth, start.north_ft + distance * std::cos(elevation) * std::cos(azimuth));
    set(kTrackingEast, start.east_ft + distance * std::cos(elevation) * std::sin(azimuth));
    set(kTrackingAltitude, limits_.Altitude(start.altitude_ft + distance * std::sin(elevation)));
    set(kTrackingLastNorth, start.north_ft);
    set(kTrackingLastEast, start.east_ft);
    set(kTrackingLastAltitude, start.altitude_ft);
    const double widening = random->Uniform(0, std::log(config_.training_tolerance_max));
    set(kTrackingTolerance, config_.position_tolerance_ft * std::exp(widening));
  }

  float ToleranceShare(Tile task, int index) const override {
    return task[kTrackingTolerance][index] / static_cast<float>(config_.position_tolerance_ft);
  }

  void Errors(Tile flight, Tile task, float* errors, std::size_t error_stride) const override {
    SKEIN_DISPATCH(TrackingErrors)
    (flight, task, config_.error_axes, unit_ft_, errors, error_stride);
  }

  void ComputeReward(Tile flight, Tile task, const std::int32_t* /*steps_before*/,
                     const StepResult& step_result) const override {
    SKEIN_DISPATCH(TrackingReward)(flight, task, unit_ft_, step_result);
  }

 private:
  TrackingConfig config_;
  TargetLimits limits_;
  double unit_ft_;
};

}  // namespace

std::unique_ptr<Task> MakeTrackingTask(const TrackingConfig& config, const ReferenceUnits& units,
                                       const TargetLimits& limits) {
  return std::make_unique<TrackingTask>(config, units.altitude_error_ft, limits);
}

}  // namespace skein
#endif
