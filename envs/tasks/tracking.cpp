// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/tracking.h"

#include <array>
#include <cmath>

#include "envs/tasks/point_target.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/tasks/tracking.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/tasks/flight-inl.h"
#include "envs/tasks/point-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

HWY_INLINE PointError ErrorOf(const Tile& flight, const Tile& task, int first) {
  return {hn::Sub(Column(task, kTrackingNorth, first), Column(flight, kNorth, first)),
          hn::Sub(Column(task, kTrackingEast, first), Column(flight, kEast, first)),
          hn::Add(Column(task, kTrackingAltitude, first), Column(flight, kDown, first))};
}

/// The same from where the control step began.
HWY_INLINE PointError LastErrorOf(const Tile& task, int first) {
  return {
      hn::Sub(Column(task, kTrackingNorth, first), Column(task, kTrackingLastNorth, first)),
      hn::Sub(Column(task, kTrackingEast, first), Column(task, kTrackingLastEast, first)),
      hn::Sub(Column(task, kTrackingAltitude, first), Column(task, kTrackingLastAltitude, first))};
}

HWY_INLINE V InUnits(V distance, double unit_ft) {
  return hn::Mul(distance, Constant(1 / unit_ft));
}

void TrackingErrors(Tile flight, Tile task, TrackingAxes axes, double unit_ft, float* errors,
                    std::size_t error_stride) {
  const FloatTag d;
  for (int first = 0; first < flight.count; first += kLanes) {
    PointError error = ErrorOf(flight, task, first);
    if (axes == TrackingAxes::kHeading) TurnIntoHeading(flight, first, error.north, error.east);
    if (axes == TrackingAxes::kPath) TurnIntoPath(flight, first, error);
    hn::StoreU(InUnits(error.north, unit_ft), d, errors + first);
    hn::StoreU(InUnits(error.east, unit_ft), d, errors + error_stride + first);
    hn::StoreU(InUnits(error.up, unit_ft), d, errors + 2 * error_stride + first);
  }
}

HWY_INLINE V DistanceOf(const PointError& error, double unit_ft) {
  const V square = hn::MulAdd(error.north, error.north,
                              hn::MulAdd(error.east, error.east, hn::Mul(error.up, error.up)));
  return InUnits(hn::Sqrt(square), unit_ft);
}

void TrackingReward(Tile flight, Tile task, const TrackingConfig& config, double unit_ft,
                    const StepResult& step_result) {
  const FloatTag d;
  const IntTag di;
  const V distance_weight = Constant(config.distance_weight);
  const V approach_weight = Constant(config.approach_weight);
  for (int first = 0; first < flight.count; first += kLanes) {
    const PointError begin = LastErrorOf(task, first);
    const PointError end = ErrorOf(flight, task, first);
    const V distance = DistanceOf(end, unit_ft);
    const V approach = hn::Sub(DistanceOf(begin, unit_ft), distance);
    hn::StoreU(hn::MulSub(approach_weight, approach, hn::Mul(distance_weight, distance)), d,
               step_result.reward + first);

    const V tolerance = Column(task, kTrackingTolerance, first);
    const Mask reached = TouchesBox(begin, end, tolerance, distance);
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
    const std::array<double, 3> point = DrawPoint(
        {config_.distance_ft, config_.azimuth_deg, config_.elevation_deg}, start, limits_, random);
    const auto set = [task, index](int column, double value) {
      task[column][index] = static_cast<float>(value);
    };
    set(kTrackingNorth, point[0]);
    set(kTrackingEast, point[1]);
    set(kTrackingAltitude, point[2]);
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
    SKEIN_DISPATCH(TrackingReward)(flight, task, config_, unit_ft_, step_result);
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
