// SPDX-License-Identifier: Apache-2.0
#include "envs/env_stepper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/range.h"
#include "envs/actions.h"
#include "envs/aircraft/engine.h"
#include "envs/configured_aircraft.h"
#include "envs/mission_rules.h"
#include "envs/plant/sensor_freeze.h"
#include "envs/state/attitude.h"
#include "envs/task_registry.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/termination.h"
#include "simd/random.h"

namespace skein {
namespace {

constexpr std::size_t kCacheLine = 64;

const EnvConfig& Validated(const EnvConfig& config) {
  Validate(config);
  return config;
}

bool Is(std::int32_t termination, Termination which) {
  return termination == static_cast<std::int32_t>(which);
}

/// Of a target that is held its reward comes when it is reached (AdvanceTargets), not at the end of
/// the hold.
TerminationConfig EndsOf(const EnvConfig& config) {
  TerminationConfig ends = config.termination.Flown();
  if (config.hold_s > 0) ends.success_reward = 0;
  return ends;
}

}  // namespace

/// What a block needs during a policy step only.
struct alignas(kCacheLine) EnvStepper::Scratch {
  float command[kActionSize][kAircraftPerBlock];          // throttle and sticks
  float delayed_command[kActionSize][kAircraftPerBlock];  // what of them arrives
  float step_reward[kAircraftPerBlock];
  float policy_step_reward[kAircraftPerBlock] = {};
  std::int32_t reached[kAircraftPerBlock];
  std::int32_t ends[kAircraftPerBlock];
  std::int32_t termination[kAircraftPerBlock] = {};
  bool final_observed[kAircraftPerBlock] = {};
  float errors[kNumTaskErrors * kAircraftPerBlock];
  std::int32_t deadline[kAircraftPerBlock] = {};
  std::int32_t target_end[kAircraftPerBlock];
  float bonus[kAircraftPerBlock] = {};
  LowLevelFlight::Scratch low_level;

  /// Whether an episode of the first `count` aircraft ended in the policy step so far. That is
  /// rare, so it is asked of all at once before anything is asked of each.
  bool HasEnds(int count) const {
    std::int32_t any = 0;
    for (int i = 0; i < count; ++i) any |= termination[i];
    return any != 0;
  }
};

/// Where a state that sensors show late is put together.
struct alignas(kCacheLine) EnvStepper::SensedState {
  static constexpr std::size_t kStride = TileStride(kAircraftPerBlock);
  float columns[kNumWindyColumns][kStride];
};

EnvStepper::EnvStepper(const EnvConfig& config, std::uint64_t seed, int num_aircraft,
                       std::shared_ptr<const Policy> low_level, int first_aircraft)
    : config_(Validated(config)),
      seed_(seed),
      first_aircraft_(first_aircraft),
      task_(MakeTask(config_)),
      aircraft_(ConfiguredAircraft(config_)),
      kernel_aircraft_(MakeKernelAircraft(aircraft_, config_.atmosphere, config_.gravity)),
      flight_control_(aircraft_, config_.flight_control, config_.control_interval_s),
      limits_(EndsOf(config_), config_.episode()),
      remembers_actions_(config_.reward.action_change > 0 ||
                         task_->observation_layout().actions > 0),
      progress_(RulesOf(config_, *task_)),
      costs_(config_.reward),
      reset_(config_, aircraft_),
      wind_(config_.wind, config_.draw_power, aircraft_.airframe.span_ft),
      drawn_plant_(config_.plant),
      most_noise_(config_.most_noise()),
      privileged_(*task_, progress_, wind_.enabled(), config_.plant.enabled()) {
  static_assert(kAircraftPerBlock == LowLevelFlight::kMaxCount);
  static_assert(kObservedActions == kActionSize);
  if (low_level != nullptr) {
    if (!(task_->observation_layout() == kStandardObservation)) {
      throw Error(
          "a policy for a high-level policy's commands needs the standard observation: not " +
          config_.task + "'s");
    }
    low_level_ = std::make_unique<LowLevelFlight>(config_, num_aircraft, std::move(low_level));
  }
}

EnvColumns EnvStepper::columns() const {
  EnvColumns columns;
  columns.windy = wind_.enabled();
  columns.rotational_gusts = config_.wind.has_rotational_gusts();
  columns.task = task_->num_columns();
  if (remembers_actions_) columns.last_action = action_size();
  columns.progress = progress_.enabled();
  if (config_.plant.enabled()) {
    columns.plant =
        config_.plant.has_sensor_errors() ? kNumPlantColumnsWithSensors : kNumPlantColumns;
    columns.delays = {config_.plant.action_delay_steps.max,
                      config_.plant.observation_delay_steps.max, columns.windy,
                      task_->observes_over_ground()};
  }
  return columns;
}

void EnvStepper::SetConditionShare(double share) {
  reset_.SetShare(share);
  wind_.SetShare(share);
  drawn_plant_ = config_.plant.Narrowed(share);
  const double least = config_.observation_noise, most = config_.most_noise();
  most_noise_ = most > least ? Lowest({least, most}, share).max : most;
}

void EnvStepper::SetTimeLimitShare(double share) {
  progress_.time_limit_steps = TimeLimitSteps(config_, share);
}

void EnvStepper::ResetMetrics(std::size_t num_blocks) {
  metric_sums_.assign(num_blocks, FlightMetricSums());
}

void EnvStepper::BeginEpisode(const EnvBlock& block, int i, std::int32_t episode) {
  block.episode[i] = episode;
  block.step[i] = FirstClock(block, i);
  block.episode_return[i] = 0;
  block.progress.Reset(i, block.step[i]);
  if (remembers_actions_) {
    for (int k = 0; k < action_size(); ++k) block.last_action[k][i] = 0;
  }
  if (low_level_ != nullptr) low_level_->Reset(block.first_aircraft + i);
  const auto stream = [&](simd::RandomPurpose purpose) {
    return simd::RandomStream(
        {seed_, KeyOf(block, i), static_cast<std::uint32_t>(episode), 0, purpose});
  };
  simd::RandomStream initial = stream(simd::RandomPurpose::kInitialState);
  FreshFlight flight = reset_.Draw(&initial);
  for (int column = 0; column < kNumColumns; ++column) {
    block.flight[column][i] = flight.columns[static_cast<std::size_t>(column)];
  }
  if (wind_.enabled()) wind_.Begin(block.flight, i, GustKeysOf(block));
  if (block.plants.is_drawn()) BeginPlant(block, i);
  simd::RandomStream target = stream(simd::RandomPurpose::kTarget);
  const double share = config_.mission.training_target_share;
  if (config_.mission.enabled()) {
    LimitDescent(config_, flight.start.altitude_ft, &flight.start);
  } else if (share > 0 && initial.Uniform() < share) {
    JoinMission(config_, task_->is_point(), &initial, &flight.start);
  }
  task_->Reset(flight.start, &target, block.task, i);
}

std::int32_t EnvStepper::FirstClock(const EnvBlock& block, int i) const {
  if (!config_.stagger_clocks || block.episode[i] != 0) return 0;
  simd::RandomStream clock({seed_, KeyOf(block, i), 0, 0, simd::RandomPurpose::kClockStagger});
  return static_cast<std::int32_t>(clock.Uniform(0, LongestFlightSteps()));
}

int EnvStepper::LongestFlightSteps() const {
  return config_.mission.enabled() ? progress_.mission_steps : config_.time_limit_steps;
}

/// Draws the plant of an aircraft whose episode and flight are set: it is the nominal one's trim.
void EnvStepper::BeginPlant(const EnvBlock& block, int i) const {
  simd::RandomStream random({seed_, KeyOf(block, i), static_cast<std::uint32_t>(block.episode[i]),
                             0, simd::RandomPurpose::kPlant});
  SetPlant(PlantOf(&random), aircraft_, config_.control_interval_s, block.plants, i);
  if (block.delay_line.delays.columns() == 0) return;
  const double throttle = ThrottleForPower(aircraft_.throttle_gearing, block.flight[kPower][i]);
  FillDelayLine(block.delay_line, block.flight, {static_cast<float>(throttle), 0, 0, 0}, i);
}

PlantDraw EnvStepper::PlantOf(simd::RandomStream* random) const {
  if (config_.draw_power == 1) return DrawPlant(drawn_plant_, random);
  const double share = WholePower(random->Uniform(), config_.draw_power - 1);
  return DrawPlant(drawn_plant_.Narrowed(share), random);
}

GustKeys EnvStepper::GustKeysOf(const EnvBlock& block) const {
  return {seed_, KeyOf(block, 0), block.episode, block.step};
}

ObservationNoise EnvStepper::NoiseOf(const EnvBlock& block) const {
  ObservationNoise noise;
  noise.standard_deviation = config_.observation_noise;
  noise.max_standard_deviation = most_noise_;
  noise.power = config_.draw_power;
  noise.seed = seed_;
  noise.first_aircraft = KeyOf(block, 0);
  noise.episode = block.episode;
  noise.step = block.step;
  return noise;
}

/// The flight as its sensors show it: `state` is filled if that is another than the present one.
Tile EnvStepper::Sensed(const EnvBlock& block, SensedState& state) const {
  if (config_.plant.observation_delay_steps.max == 0) return block.flight;
  Tile sensed = block.flight;
  sensed.base = state.columns[0];
  sensed.rotational_gusts = false;  // no sensor shows them
  sensed.stride = SensedState::kStride;
  DelayState(block.delay_line, block.plants, block.flight, sensed);
  return sensed;
}

/// What sensors show now.
void EnvStepper::ObserveSample(const EnvBlock& block, float* observation) const {
  SensedState state;
  const Tile sensed = Sensed(block, state);
  alignas(kCacheLine) float numbers[kMostLeadingNumbers * kAircraftPerBlock];
  task_->LeadingObservations(sensed, block.task, numbers, kAircraftPerBlock);
  const ObservedTask task{numbers, kAircraftPerBlock, task_->observation_layout(),
                          block.last_action};
  ObserveTile(*kernel_aircraft_, sensed, task, NoiseOf(block), observation, block.plants);
}

void EnvStepper::Observe(const EnvBlock& block, float* observation) const {
  ObserveSample(block, observation);
  if (low_level_ != nullptr && low_level_->averages_observations()) {
    low_level_->AverageObservations(block.first_aircraft, block.count, observation);
  }
}

void EnvStepper::ObservePrivileged(const EnvBlock& block, float* rows) const {
  privileged_.Observe(block, rows);
}

/// Turns the actions that hold during the control step into commands, and returns them: `action`,
/// or those of the low-level policy, which acts when its policy step begins.
const float* EnvStepper::StickActions(const EnvBlock& block, const float* action, int step,
                                      Scratch& scratch) {
  const bool is_first = step == 0;
  if (low_level_ == nullptr) {
    if (is_first) TakeActions(action, block.flight, scratch.command[0], kAircraftPerBlock);
    return action;
  }
  if (low_level_->IsPolicyStep(step)) {
    SensedState state;
    const Tile sensed = Sensed(block, state);
    if (is_first) {
      low_level_->SetTargets(action, block.flight, sensed, scratch.low_level);
      low_level_->ResetObservationMean(block.first_aircraft, block.count);
    }
    low_level_->Act(block.first_aircraft, *kernel_aircraft_, sensed, NoiseOf(block), block.plants,
                    scratch.low_level);
    // The first sample is the one in the observation that the high-level policy has just acted by.
    if (low_level_->averages_observations() && !is_first) {
      alignas(kCacheLine) float errors[kNumTaskErrors * kAircraftPerBlock];
      task_->Errors(sensed, block.task, errors, kAircraftPerBlock);
      low_level_->AccumulateObservations(block.first_aircraft, block.count, errors,
                                         scratch.low_level);
    }
    TakeActions(scratch.low_level.action, block.flight, scratch.command[0], kAircraftPerBlock);
  }
  return scratch.low_level.action;
}

/// The commands that reach the aircraft in this control step of the policy step, which remembers
/// what was given.
PilotColumns EnvStepper::Commands(const EnvBlock& block, int step, Scratch& scratch) const {
  const auto columns = [](const float(*command)[kAircraftPerBlock]) {
    return PilotColumns{command[0], command[1], command[2], command[3]};
  };
  // An action that has been held for the longest delay is all that is remembered.
  const bool has_arrived = low_level_ == nullptr && step >= block.delay_line.delays.action;
  if (block.delay_line.delays.action == 0 || has_arrived) return columns(scratch.command);
  DelayCommands(block.delay_line, block.plants, block.count, scratch.command[0], kAircraftPerBlock,
                scratch.delayed_command[0]);
  return columns(scratch.delayed_command);
}

/// Whether a sensor of the block may freeze within the policy step that begins.
bool EnvStepper::MayFreeze(const EnvBlock& block) const {
  return config_.plant.sensor_freeze_chance > 0 &&
         AnySensorFreezes(block.plants, block.count, block.step, config_.action_repeat);
}

/// Lets the sensors keep what they show now whose time has come.
void EnvStepper::FreezeSensors(const EnvBlock& block) const {
  if (!AnySensorFreezes(block.plants, block.count, block.step, 0)) return;
  const ObservationLayout& layout = task_->observation_layout();
  if (!layout.flight) return;
  float observation[kAircraftPerBlock * kMostObservations];
  ObserveSample(block, observation);
  skein::FreezeSensors(block.plants, block.count, block.step,
                       observation + layout.lead - kNumTaskErrors, layout.size());
}

/// Takes the costs of handling off the control step's reward. The scratch's errors are those of its
/// state, if there are costs of control steps.
void EnvStepper::SubtractCosts(const EnvBlock& block, const float* policy_action,
                               Scratch& scratch) const {
  if (costs_.of_control_steps()) {
    SubtractHandlingCosts(costs_, block.flight, scratch.errors, kAircraftPerBlock,
                          block.progress.reached_step, scratch.step_reward);
  }
  if (costs_.of_tolerances()) {
    RewardTolerances(costs_, block.count, scratch.reached, block.progress.reached_step,
                     scratch.step_reward);
  }
  // Also while its weight is 0 for now: what is remembered is what was flown last.
  if (remembers_actions_ && policy_action != nullptr) {
    const int throttles = low_level_ == nullptr ? 1 : 0;
    SubtractActionChange(costs_, policy_action, action_size(), throttles, block.last_action,
                         scratch.step_reward);
  }
}

/// Gives aircraft on missions their next targets.
void EnvStepper::DrawTargets(const EnvBlock& block, const Scratch& scratch) const {
  for (int i = 0; i < block.count; ++i) {
    const bool has_ended = static_cast<TargetEnd>(scratch.target_end[i]) != TargetEnd::kNone;
    if (has_ended && Is(scratch.termination[i], Termination::kNone)) DrawTarget(block, i);
  }
}

/// Around where the episode began, and of points around where the aircraft is.
void EnvStepper::DrawTarget(const EnvBlock& block, int i) const {
  const auto episode = static_cast<std::uint32_t>(block.episode[i]);
  const std::uint32_t aircraft = KeyOf(block, i);
  simd::RandomStream initial({seed_, aircraft, episode, 0, simd::RandomPurpose::kInitialState});
  FlightStart start = reset_.Draw(&initial).start;
  const double altitude_ft = -block.flight[kDown][i];
  LimitDescent(config_, altitude_ft, &start);
  LeadBack(altitude_ft, &start);
  if (task_->is_point()) {
    Eigen::Vector4d attitude;
    for (int k = 0; k < 4; ++k) attitude[k] = block.flight[kQ0 + k][i];
    start.yaw_rad = EulerFromQuaternion(attitude).yaw;
    start.altitude_ft = altitude_ft;
    start.north_ft = block.flight[kNorth][i];
    start.east_ft = block.flight[kEast][i];
  }
  const std::uint32_t given = static_cast<std::uint32_t>(block.progress.targets_reached[i]) +
                              static_cast<std::uint32_t>(block.progress.targets_missed[i]);
  simd::RandomStream target({seed_, aircraft, episode, given, simd::RandomPurpose::kTarget});
  task_->Reset(start, &target, block.task, i);
}

/// Finds out how far each aircraft has come, and rewards targets after which flights go on.
void EnvStepper::AdvanceTargets(const EnvBlock& block, Scratch& scratch) const {
  AdvanceProgress(progress_, block.count, block.step, scratch.termination, block.progress,
                  {scratch.reached, scratch.deadline, scratch.target_end, scratch.bonus});
}

/// Rewards a control step and ends episodes, and shows it to the observer, if there is one.
/// `policy_action` are the actions of a policy step that begins with it, else null.
void EnvStepper::ComputeReward(const EnvBlock& block, const float* action,
                               const float* policy_action, ControlStepObserver* observer,
                               Scratch& scratch) const {
  StepResult step_result{scratch.step_reward, scratch.reached};
  if (task_->has_ends()) step_result.ends = scratch.ends;
  const bool needs_errors = costs_.of_control_steps() || observer != nullptr;
  if (needs_errors && task_->rewards_by_errors()) {
    step_result.errors = scratch.errors;
    step_result.error_stride = kAircraftPerBlock;
  }
  EpisodeColumns episodes{block.step, scratch.termination, scratch.policy_step_reward,
                          block.episode_return};
  task_->ComputeReward(block.flight, block.task, block.step, step_result);
  if (needs_errors && !task_->rewards_by_errors()) {
    task_->Errors(block.flight, block.task, scratch.errors, kAircraftPerBlock);
  }
  if (config_.reward.enabled() || remembers_actions_) SubtractCosts(block, policy_action, scratch);
  if (progress_.enabled()) {
    AdvanceTargets(block, scratch);
    step_result.deadline = scratch.deadline;
    step_result.bonus = scratch.bonus;
  }
  if (observer == nullptr) {
    ComputeRewardAndTermination(*kernel_aircraft_, limits_, block.flight, step_result, episodes);
    return;
  }
  alignas(kCacheLine) float reward[kAircraftPerBlock] = {};
  episodes.policy_step_reward = reward;
  ComputeRewardAndTermination(*kernel_aircraft_, limits_, block.flight, step_result, episodes);
  for (int i = 0; i < block.count; ++i) scratch.policy_step_reward[i] += reward[i];
  const Tile command = low_level_ == nullptr ? Tile{} : scratch.low_level.targets(block.count);
  observer->See({block.first_aircraft, block.flight, action, reward, episodes.termination,
                 scratch.errors, kAircraftPerBlock, block.progress, block.task, command});
}

/// Copies the rows of aircraft whose episodes ended in this control step, by time or, if asked for,
/// by anything: their observations, and what no policy observes if it is asked for.
void EnvStepper::ObserveEnds(const EnvBlock& block, Scratch& scratch,
                             const StepOutput& output) const {
  const auto is_new = [&](int i) {
    if (scratch.final_observed[i]) return false;
    return output.observes_every_end ? !Is(scratch.termination[i], Termination::kNone)
                                     : Is(scratch.termination[i], Termination::kTimeLimit);
  };
  if (!scratch.HasEnds(block.count)) return;
  bool any = false;
  for (int i = 0; i < block.count; ++i) any = any || is_new(i);
  if (!any) return;
  const int observed = observation_size();
  float observation[kAircraftPerBlock * kMostObservations];
  Observe(block, observation);
  const int size = output.final_privileged == nullptr ? 0 : privileged_.size();
  std::vector<float> privileged(static_cast<std::size_t>(block.count * size));
  if (size > 0) ObservePrivileged(block, privileged.data());
  for (int i = 0; i < block.count; ++i) {
    if (!is_new(i)) continue;
    std::copy_n(observation + i * observed, observed, output.final_observation + i * observed);
    std::copy_n(privileged.data() + i * size, size, output.final_privileged + i * size);
    scratch.final_observed[i] = true;
  }
}

/// Reports the episodes that ended and begins new ones.
void EnvStepper::RestartEnded(const EnvBlock& block, const Scratch& scratch,
                              const StepOutput& output) {
  FlightMetricSums& metrics = metric_sums_[block.index];
  for (int i = 0; i < block.count; ++i) {
    if (Is(scratch.termination[i], Termination::kNone)) continue;
    output.episode_return[i] = block.episode_return[i];
    output.episode_steps[i] = block.step[i];
    if (output.first_clock != nullptr) output.first_clock[i] = FirstClock(block, i);
    if (output.flight_metrics != nullptr) {
      float* const row = output.flight_metrics + i * kNumFlightMetrics;
      metrics.Report(i, block.step[i], config_.control_interval_s, row);
      // Not every column that is not finite shows in them, nor is every infinity NaN.
      if (Is(scratch.termination[i], Termination::kNonFinite)) {
        std::fill_n(row, kNumFlightMetrics, std::numeric_limits<float>::quiet_NaN());
      }
    }
    BeginNextEpisode(block, i);
  }
}

void EnvStepper::Step(const EnvBlock& block, const float* action, const StepOutput& output,
                      MemoryAhead ahead) {
  Scratch scratch;
  const bool keeps_final = output.observes_every_end || (config_.episode().truncate_at_time_limit &&
                                                         output.final_observation != nullptr);
  const float dt = static_cast<float>(config_.control_interval_s);
  const bool may_freeze = MayFreeze(block);
  // What is observed late, at the policy step's end, are states of its last control steps.
  const bool observes_between = keeps_final || low_level_ != nullptr || may_freeze;
  const int longest_delay = block.delay_line.delays.observation;
  const int first_remembered = observes_between ? 0 : config_.action_repeat - longest_delay;
  for (int step = 0; step < config_.action_repeat; ++step) {
    const float* const stick_action = StickActions(block, action, step, scratch);
    if (longest_delay > 0 && step >= first_remembered)
      RememberState(block.delay_line, block.flight);
    const PilotColumns commands = Commands(block, step, scratch);
    if (wind_.enabled()) wind_.Advance(block.flight, dt, GustKeysOf(block));
    ControlTile(*kernel_aircraft_, flight_control_, block.flight, commands, block.plants);
    // What lies ahead is needed after the last control step.
    const bool is_last = step + 1 == config_.action_repeat;
    StepTile(*kernel_aircraft_, block.flight, dt, config_.substeps, is_last ? ahead : MemoryAhead(),
             block.plants);
    if (output.flight_metrics != nullptr) {
      metric_sums_[block.index].Add(*kernel_aircraft_, block.flight, scratch.termination);
    }
    ComputeReward(block, stick_action, step == 0 ? action : nullptr, output.observer, scratch);
    if (progress_.mission_steps > 0) DrawTargets(block, scratch);
    if (may_freeze) FreezeSensors(block);
    if (keeps_final) ObserveEnds(block, scratch, output);
  }
  std::copy_n(scratch.policy_step_reward, block.count, output.reward);
  std::copy_n(scratch.termination, block.count, output.termination);
  if (scratch.HasEnds(block.count)) RestartEnded(block, scratch, output);
}

}  // namespace skein
