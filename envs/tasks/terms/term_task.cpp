// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/terms/term_task.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/ends_with.h"
#include "base/error.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/state/attitude.h"
#include "envs/tasks/point_target.h"
#include "envs/tasks/terms/term_compiler.h"
#include "envs/tasks/terms/term_program.h"

namespace skein {
namespace {

using Draw = TermTarget::Draw;

/// What a target is drawn relative to.
double StartOf(const FlightStart& start, TermValue value) {
  switch (value) {
    case TermValue::kAltitude:
      return start.altitude_ft;
    case TermValue::kTrueAirspeed:
      return start.true_airspeed_ft_s;
    case TermValue::kPitch:
      return start.pitch_rad;
    case TermValue::kYaw:
      return start.yaw_rad;
    case TermValue::kRoll:
      return start.roll_rad;
    case TermValue::kNorth:
      return start.north_ft;
    case TermValue::kEast:
      return start.east_ft;
    default:
      return 0;  // nothing else is drawn around the start
  }
}

/// "_ft", "_rad": that of the value itself; empty if it has none.
std::string UnitOf(TermValue value) {
  for (const TermName& name : TermNames()) {
    if (name.value != value || name.per_value != 1) continue;
    for (const char* unit : {"_deg_s", "_rad", "_ft", "_fps", "_g", "_deg"}) {
      if (EndsWith(name.name, unit)) return unit;
    }
  }
  return "";
}

class TermTask : public Task {
 public:
  TermTask(const std::shared_ptr<const TermTaskConfig>& config, const Aircraft& aircraft,
           const TargetLimits& limits)
      : config_(config),
        limits_(limits),
        units_(aircraft.units),
        kernel_aircraft_(MakeKernelAircraft(aircraft, limits.atmosphere)),
        columns_(*config),
        programs_(CompileTerms(*config, columns_, units_)) {
    layout_.lead = static_cast<int>(config->observed.size());
    layout_.flight = config->observes_flight;
    layout_.actions = config->observes_actions ? kObservedActions : 0;
  }

  int num_columns() const override { return columns_.count; }
  int num_targets() const override { return columns_.num_targets; }

  std::vector<TargetQuantity> target_quantities() const override {
    std::vector<TargetQuantity> quantities;
    for (const TermTarget& target : config_->targets) {
      const double unit = Worth(target.unit, units_);
      if (target.draw_from == Draw::kPoint) {
        for (const char* column : {"north_ft", "east_ft", "altitude_ft"}) {
          quantities.push_back({column, false, unit, columns_.box < 0 ? 0 : BoxWidth()});
        }
        continue;
      }
      for (const TermName& name : TermNames()) {
        if (name.value != target.quantity.value || !name.is_recorded) continue;
        quantities.push_back({name.name, name.is_angle, unit * name.per_value,
                              name.per_value * ToleranceOf(target)});
      }
    }
    return quantities;
  }

  double dwell_s() const override { return config_->dwell_s; }
  bool is_point() const override { return config_->has_point(); }
  bool observes_over_ground() const override {
    return std::any_of(
        config_->observed.begin(), config_->observed.end(),
        [this](const TermNumber& number) { return IsOverGround(config_->ValueReadBy(number)); });
  }
  bool has_ends() const override { return !config_->ends.empty(); }
  const ObservationLayout& observation_layout() const override { return layout_; }
  std::vector<ObservedNumber> leading_numbers() const override {
    std::vector<ObservedNumber> numbers;
    for (const TermNumber& number : config_->observed) {
      numbers.push_back({NameWithUnit(number), Worth(number.unit, units_)});
    }
    return numbers;
  }

  void Reset(const FlightStart& start, simd::RandomStream* random, Tile task,
             int index) const override {
    const auto set = [task, index](int column, double value) {
      task[column][index] = static_cast<float>(value);
    };
    double altitude = start.altitude_ft, pitch = start.pitch_rad, yaw = start.yaw_rad;
    for (std::size_t k = 0; k < config_->targets.size(); ++k) {
      const TermTarget& target = config_->targets[k];
      const int column = TermColumns::OfTarget(*config_, static_cast<int>(k));
      if (target.draw_from == Draw::kPoint) {
        const auto point = DrawPoint({target.distance_ft, target.azimuth_deg, target.elevation_deg},
                                     start, limits_, random);
        for (int axis = 0; axis < 3; ++axis) set(column + axis, point[axis]);
        continue;
      }
      const double value = DrawValue(target, start, altitude, random);
      if (target.quantity.value == TermValue::kAltitude) altitude = value;
      if (target.quantity.value == TermValue::kPitch) pitch = value;
      if (target.quantity.value == TermValue::kYaw) yaw = value;
      set(column, value);
    }
    EulerAngles attitude;
    attitude.pitch = pitch;
    attitude.yaw = yaw;
    SetAttitude(attitude, task, index);
    ResetTolerances(start, random, set);
  }

  void FollowTargets(Tile task, int index) const override {
    if (columns_.attitude < 0) return;
    Eigen::Vector4d before;
    for (int k = 0; k < 4; ++k) before[k] = task[columns_.attitude + k][index];
    EulerAngles attitude = EulerFromQuaternion(before);
    for (std::size_t k = 0; k < config_->targets.size(); ++k) {
      const TermValue value = config_->targets[k].quantity.value;
      const float target = task[TermColumns::OfTarget(*config_, static_cast<int>(k))][index];
      if (value == TermValue::kPitch) attitude.pitch = target;
      if (value == TermValue::kYaw) attitude.yaw = target;
    }
    SetAttitude(attitude, task, index);
  }

  float ToleranceShare(Tile task, int index) const override {
    if (columns_.box < 0) return task[columns_.share][index];
    return task[columns_.box][index] / static_cast<float>(BoxWidth());
  }

  void Errors(Tile flight, Tile task, float* errors, std::size_t error_stride) const override {
    Run(programs_.errors, flight, task, errors, error_stride);
    for (std::size_t k = programs_.errors.results.size(); k < kNumTaskErrors; ++k) {
      std::fill_n(errors + k * error_stride, flight.count, 0.0f);
    }
  }

  void LeadingObservations(Tile flight, Tile task, float* numbers,
                           std::size_t stride) const override {
    Run(programs_.observed, flight, task, numbers, stride);
  }

  void ComputeReward(Tile flight, Tile task, const std::int32_t* steps_before,
                     const StepResult& step_result) const override {
    RunTermReward(programs_.reward, *kernel_aircraft_, flight, task, steps_before,
                  config_->earliest_step, step_result);
  }

 private:
  /// "error_altitude_ft" of "error_altitude": times its unit it is in feet.
  std::string NameWithUnit(const TermNumber& number) const {
    if (number.value != TermValue::kTargetError) return number.name;
    const TermTarget& target = config_->targets[static_cast<std::size_t>(number.target)];
    if (number.name != "error_" + target.name) return number.name;
    return number.name + UnitOf(target.quantity.value);
  }

  void Run(const TermProgram& program, Tile flight, Tile task, float* columns,
           std::size_t stride) const {
    RunTermProgram(program, *kernel_aircraft_, flight, task, {columns, stride});
  }

  void SetAttitude(const EulerAngles& attitude, Tile task, int index) const {
    if (columns_.attitude < 0) return;
    const Eigen::Vector4d quaternion = QuaternionFromEuler(attitude);
    for (int k = 0; k < 4; ++k) {
      task[columns_.attitude + k][index] = static_cast<float>(quaternion[k]);
    }
  }

  double DrawValue(const TermTarget& target, const FlightStart& start, double altitude_ft,
                   simd::RandomStream* random) const {
    const TermValue value = target.quantity.value;
    const double drawn = random->Uniform(target.draw.min, target.draw.max);
    const double asked =
        target.draw_from == Draw::kAroundStart ? StartOf(start, value) + drawn : drawn;
    if (value == TermValue::kAltitude) {
      return std::max(limits_.Altitude(asked), start.lowest_altitude_ft);
    }
    if (value == TermValue::kTrueAirspeed) return limits_.TrueAirspeed(asked, altitude_ft);
    if (value == TermValue::kPitch) {
      return std::max(std::asin(std::sin(asked)), start.lowest_pitch_rad);
    }
    return IsWrapped(value) ? std::remainder(asked, 2 * M_PI) : asked;
  }

  template <class Set>
  void ResetTolerances(const FlightStart& start, simd::RandomStream* random, const Set& set) const {
    if (columns_.last_point >= 0) {
      set(columns_.last_point, start.north_ft);
      set(columns_.last_point + 1, start.east_ft);
      set(columns_.last_point + 2, start.altitude_ft);
    }
    // One number of the stream serves both: what is widened is not narrowed.
    if (columns_.box >= 0) {
      const double widening = random->Uniform(0, std::log(config_->training_tolerance_max));
      set(columns_.box, BoxWidth() * std::exp(widening));
      set(columns_.share, 1);
    } else {
      set(columns_.share, random->Uniform(config_->training_tolerance_min, 1));
    }
  }

  /// How far from the target counts as reached, in the unit of the value; 0: nothing says.
  double ToleranceOf(const TermTarget& target) const {
    for (const TermCondition& condition : config_->reached) {
      const TermNumber& number = condition.number;
      if (condition.kind != TermCondition::Kind::kWithin ||
          number.value != TermValue::kTargetError ||
          config_->targets[static_cast<std::size_t>(number.target)].name != target.name) {
        continue;
      }
      return condition.limit / number.per_value * Worth(number.unit, units_);
    }
    return 0;
  }

  double BoxWidth() const {
    for (const TermCondition& condition : config_->reached) {
      if (condition.kind == TermCondition::Kind::kBox) return condition.limit;
    }
    return 1;
  }

  std::shared_ptr<const TermTaskConfig> config_;
  TargetLimits limits_;
  ReferenceUnits units_;
  std::shared_ptr<const KernelAircraft> kernel_aircraft_;
  TermColumns columns_;
  TermPrograms programs_;
  ObservationLayout layout_;
};

}  // namespace

std::unique_ptr<Task> MakeTermTask(const std::shared_ptr<const TermTaskConfig>& config,
                                   const Aircraft& aircraft, const TargetLimits& limits) {
  auto task = std::make_unique<TermTask>(config, aircraft, limits);
  if (const int observed = task->observation_layout().size(); observed < kFewestObservations) {
    throw Error("task " + config->name + " observes " + std::to_string(observed) +
                " numbers, but there must be at least " + std::to_string(kFewestObservations));
  }
  return task;
}

}  // namespace skein
