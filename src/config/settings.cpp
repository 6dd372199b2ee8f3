// SPDX-License-Identifier: Apache-2.0
#include "src/config/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "src/config/nearest_name.h"

namespace skein {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kMaxInt = std::numeric_limits<int>::max();
// TOML integers are signed 64-bit, and a double holds every step count up to 2^53 exactly.
constexpr double kMaxCount = 9007199254740992.0;

template <typename Enum, std::size_t kCount>
using Names = std::array<std::pair<Enum, const char*>, kCount>;

const auto& NamesOf(AtmosphereModel) { return kAtmosphereNames; }
const auto& NamesOf(FlightControlMode) { return kFlightControlNames; }
const auto& NamesOf(TrackingAxes) { return kTrackingAxesNames; }
const auto& NamesOf(Activation) { return kActivationNames; }
const auto& NamesOf(Backend) { return kBackendNames; }
const auto& NamesOf(LearnerPrecision) { return kPrecisionNames; }

/// "a", "b" or "c".
template <typename Enum, std::size_t kCount>
std::string ListNames(const Names<Enum, kCount>& names) {
  std::string list;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (i > 0) list += i + 1 < kCount ? ", " : " or ";
    list += fmt::format("\"{}\"", names[i].second);
  }
  return list;
}

std::string FormatNumber(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string Quote(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string Describe(const SettingValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *integer);
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  return Quote(std::get<std::string>(value));
}

std::vector<Setting> MakeSettings() {
  using C = ProgramConfig;
  using F = SettingField;
  const Bounds any{-kUnbounded, kUnbounded}, positive{0, kUnbounded, true},
      not_negative{0, kUnbounded}, fraction{0, 1}, share{0, 1, true}, count{1, kMaxInt},
      count_or_none{0, kMaxInt}, name{};
  return {
      {"run.total_steps",
       [](C& c) -> F { return &c.train.total_steps; },
       {1, kMaxCount},
       "budget in control steps (50 Hz), summed over all aircraft"},
      {"run.seed",
       [](C& c) -> F { return &c.train.seed; },
       {0, kMaxCount},
       "seed of every random number"},

      {"env.task", [](C& c) -> F { return &c.train.env.task; }, name, "what is flown"},
      {"env.aircraft", [](C& c) -> F { return &c.train.env.aircraft; }, name, "what flies"},
      {"env.atmosphere", [](C& c) -> F { return &c.train.env.atmosphere; }, name,
       "air: the published F-16 models' or the U.S. Standard Atmosphere 1976"},
      {"env.flight_control", [](C& c) -> F { return &c.train.env.flight_control; }, name,
       "the four-channel flight control system, or commands straight to the actuators"},
      {"env.cg_chord_fraction", [](C& c) -> F { return &c.train.env.cg; }, share,
       "centre of gravity, fraction of the mean chord"},
      {"env.engine_angular_momentum_slug_ft2_per_s",
       [](C& c) -> F { return &c.train.env.engine_angular_momentum; }, not_negative,
       "gyroscopic effect of the engine; 0 leaves it out"},
      {"env.thrust_growth_above_mach_1", [](C& c) -> F { return &c.train.env.thrust_grows; }, name,
       "true: thrust grows above Mach 1; false: it is held at its value there"},
      {"env.drag_rise", [](C& c) -> F { return &c.train.env.drag_rises; }, name,
       "drag rises with the Mach number"},
      {"env.control_interval_s",
       [](C& c) -> F { return &c.train.env.control_interval_s; },
       {0, 0.04, true},
       "time between control steps"},
      {"env.substeps",
       [](C& c) -> F { return &c.train.env.substeps; },
       {1, 1000},
       "RK4 steps per control step"},
      {"env.action_repeat",
       [](C& c) -> F { return &c.train.env.action_repeat; },
       {1, 1000},
       "control steps for which the policy's action is held; 5 is 10 Hz"},
      {"env.time_limit_steps", [](C& c) -> F { return &c.train.env.time_limit_steps; }, count,
       "longest episode in control steps"},
      {"env.truncate_at_time_limit", [](C& c) -> F { return &c.train.env.truncate_at_time_limit; },
       name, "true: the value is bootstrapped at the limit; false: the limit is a failure"},
      {"env.stagger_clocks", [](C& c) -> F { return &c.train.env.stagger_clocks; }, name,
       "first episodes begin with their clocks spread over the time limit (training only)"},
      {"env.observation_noise", [](C& c) -> F { return &c.train.env.observation_noise; },
       not_negative, "standard deviation of the noise on every observation"},
      {"env.observation_noise_max", [](C& c) -> F { return &c.train.env.observation_noise_max; },
       not_negative,
       "if larger, every episode draws its standard deviation between the two (--condition noisy "
       "sets "
       "both)"},
      {"env.reward_scale", [](C& c) -> F { return &c.train.env.reward_scale; }, not_negative,
       "multiplies the step rewards, not the terminal ones"},

      {"env.initial.altitude_min_ft",
       [](C& c) -> F { return &c.train.env.initial.altitude_ft.min; },
       {0, 60000},
       "lowest initial altitude"},
      {"env.initial.altitude_max_ft",
       [](C& c) -> F { return &c.train.env.initial.altitude_ft.max; },
       {0, 60000},
       "highest initial altitude"},
      {"env.initial.true_airspeed_min_fps",
       [](C& c) -> F { return &c.train.env.initial.true_airspeed_fps.min; },
       {10, 3000},
       "lowest initial true airspeed"},
      {"env.initial.true_airspeed_max_fps",
       [](C& c) -> F { return &c.train.env.initial.true_airspeed_fps.max; },
       {10, 3000},
       "highest initial true airspeed"},
      {"env.initial.trimmed", [](C& c) -> F { return &c.train.env.initial.trimmed; }, name,
       "true: steady flight; false: level, alpha 0, surfaces centred, a set thrust (F-16: 2000 "
       "lbf)"},

      {"env.wind.speed_min_fps",
       [](C& c) -> F { return &c.train.env.wind.speed_fps.min; },
       {0, 500},
       "lowest speed of the steady wind, which is horizontal"},
      {"env.wind.speed_max_fps",
       [](C& c) -> F { return &c.train.env.wind.speed_fps.max; },
       {0, 500},
       "highest speed of the steady wind; each episode draws its own"},
      {"env.wind.from_min_deg",
       [](C& c) -> F { return &c.train.env.wind.from_deg.min; },
       {-360, 360},
       "where the steady wind comes from: 0 is north, 90 east"},
      {"env.wind.from_max_deg",
       [](C& c) -> F { return &c.train.env.wind.from_deg.max; },
       {-360, 360},
       "the other end of that range"},
      {"env.wind.turbulence_min_fps",
       [](C& c) -> F { return &c.train.env.wind.turbulence_fps.min; },
       {0, 500},
       "lowest standard deviation of Dryden turbulence"},
      {"env.wind.turbulence_max_fps",
       [](C& c) -> F { return &c.train.env.wind.turbulence_fps.max; },
       {0, 500},
       "highest standard deviation of Dryden turbulence; each episode draws its own"},
      {"env.wind.step_at_reset", [](C& c) -> F { return &c.train.env.wind.step_at_reset; }, name,
       "true: trimmed in still air, the steady wind then is a step; false: trimmed in the wind"},

      {"env.heading.altitude_change_ft",
       [](C& c) -> F { return &c.train.env.heading.altitude_change_ft; }, not_negative,
       "target altitude: initial + U(-x, x)"},
      {"env.heading.yaw_change_rad",
       [](C& c) -> F { return &c.train.env.heading.yaw_change_rad; },
       {0, 3.1415926535897932},
       "target yaw: initial + U(-x, x)"},
      {"env.heading.speed_change_fps",
       [](C& c) -> F { return &c.train.env.heading.speed_change_fps; }, not_negative,
       "target true airspeed: initial + U(-x, x)"},
      {"env.heading.altitude_tolerance_ft",
       [](C& c) -> F { return &c.train.env.heading.altitude_tolerance_ft; }, positive,
       "altitude error that counts as reached"},
      {"env.heading.yaw_tolerance_deg",
       [](C& c) -> F { return &c.train.env.heading.yaw_tolerance_deg; },
       {0, 180, true},
       "yaw error that counts as reached"},
      {"env.heading.speed_tolerance_fps",
       [](C& c) -> F { return &c.train.env.heading.speed_tolerance_fps; }, positive,
       "speed error that counts as reached"},
      {"env.heading.training_tolerance_min",
       [](C& c) -> F { return &c.train.env.heading.training_tolerance_min; }, share,
       "in training an episode's tolerances are these times U(x, 1); evaluations take them whole"},
      {"env.heading.earliest_success_step",
       [](C& c) -> F { return &c.train.env.heading.earliest_success_step; }, count_or_none,
       "control step before which nothing counts as reached"},
      {"env.heading.speed_error_weight",
       [](C& c) -> F { return &c.train.env.heading.speed_error_weight; }, not_negative,
       "reward lost per step and unit of speed error (F-16: 340 m/s), beside the errors' norm"},

      {"env.control.pitch_change_rad",
       [](C& c) -> F { return &c.train.env.control.pitch_change_rad; },
       {0, 3.1415926535897932},
       "target pitch: initial + U(-x, x), folded into +-pi/2"},
      {"env.control.yaw_change_rad",
       [](C& c) -> F { return &c.train.env.control.yaw_change_rad; },
       {0, 3.1415926535897932},
       "target yaw: initial + U(-x, x)"},
      {"env.control.speed_change_fps",
       [](C& c) -> F { return &c.train.env.control.speed_change_fps; }, not_negative,
       "target true airspeed: initial + U(-x, x)"},
      {"env.control.pitch_tolerance_deg",
       [](C& c) -> F { return &c.train.env.control.pitch_tolerance_deg; },
       {0, 180, true},
       "pitch error that counts as reached"},
      {"env.control.yaw_tolerance_deg",
       [](C& c) -> F { return &c.train.env.control.yaw_tolerance_deg; },
       {0, 180, true},
       "yaw error that counts as reached"},
      {"env.control.speed_tolerance_fps",
       [](C& c) -> F { return &c.train.env.control.speed_tolerance_fps; }, positive,
       "speed error that counts as reached"},
      {"env.control.training_tolerance_min",
       [](C& c) -> F { return &c.train.env.control.training_tolerance_min; }, share,
       "in training an episode's tolerances are these times U(x, 1); evaluations take them whole"},
      {"env.control.reward_includes_roll",
       [](C& c) -> F { return &c.train.env.control.reward_includes_roll; }, name,
       "true: the reward's angle is to the attitude, wings level; false: to where the nose points"},
      {"env.control.speed_error_weight",
       [](C& c) -> F { return &c.train.env.control.speed_error_weight; }, not_negative,
       "reward lost per step and unit of speed error (F-16: 340 m/s), beside the angle's"},

      {"env.tracking.distance_min_ft",
       [](C& c) -> F { return &c.train.env.tracking.distance_ft.min; },
       {0, 1e6},
       "nearest target"},
      {"env.tracking.distance_max_ft",
       [](C& c) -> F { return &c.train.env.tracking.distance_ft.max; },
       {0, 1e6},
       "farthest target"},
      {"env.tracking.azimuth_deg",
       [](C& c) -> F { return &c.train.env.tracking.azimuth_deg; },
       {0, 180},
       "target's direction: left or right of the initial nose by U(-x, x)"},
      {"env.tracking.elevation_deg",
       [](C& c) -> F { return &c.train.env.tracking.elevation_deg; },
       {0, 90},
       "target's direction: above or below the initial nose by U(-x, x)"},
      {"env.tracking.position_tolerance_ft",
       [](C& c) -> F { return &c.train.env.tracking.position_tolerance_ft; }, positive,
       "distance north, east and up of the target that counts as reached"},
      {"env.tracking.training_tolerance_max",
       [](C& c) -> F { return &c.train.env.tracking.training_tolerance_max; },
       {1, 1000},
       "in training an episode's tolerance is that times exp(U(0, ln x)); evaluations take it as "
       "it is"},
      {"env.tracking.error_axes", [](C& c) -> F { return &c.train.env.tracking.error_axes; }, name,
       "what the errors are: ahead, right and up of the heading; along, right of and above the "
       "path over ground; or north, east and up"},

      {"env.high_level.pitch_change_rad",
       [](C& c) -> F { return &c.train.env.high_level.pitch_change_rad; },
       {0, 3.1415926535897932},
       "full action of a high-level policy: target pitch above the present one"},
      {"env.high_level.yaw_change_rad",
       [](C& c) -> F { return &c.train.env.high_level.yaw_change_rad; },
       {0, 3.1415926535897932},
       "full action of a high-level policy: target yaw to the right of the present one"},
      {"env.high_level.speed_change_fps",
       [](C& c) -> F { return &c.train.env.high_level.speed_change_fps; }, not_negative,
       "full action of a high-level policy: target true airspeed beyond the present one"},
      {"env.high_level.averages_observations",
       [](C& c) -> F { return &c.train.env.high_level.averages_observations; }, name,
       "true: a high-level policy sees the mean of its low-level policy's looks since it last "
       "decided; false: the "
       "last"},

      {"env.termination.alpha_min_deg",
       [](C& c) -> F { return &c.train.env.termination.alpha_deg.min; },
       {-180, 180},
       "extreme_state below this angle of attack"},
      {"env.termination.alpha_max_deg",
       [](C& c) -> F { return &c.train.env.termination.alpha_deg.max; },
       {-180, 180},
       "extreme_state above this angle of attack"},
      {"env.termination.beta_min_deg",
       [](C& c) -> F { return &c.train.env.termination.beta_deg.min; },
       {-90, 90},
       "extreme_state below this sideslip angle"},
      {"env.termination.beta_max_deg",
       [](C& c) -> F { return &c.train.env.termination.beta_deg.max; },
       {-90, 90},
       "extreme_state above this sideslip angle"},
      {"env.termination.max_mach", [](C& c) -> F { return &c.train.env.termination.max_mach; },
       positive, "high_speed above this Mach number"},
      {"env.termination.min_mach", [](C& c) -> F { return &c.train.env.termination.min_mach; },
       not_negative, "low_speed below this Mach number"},
      {"env.termination.min_altitude_ft",
       [](C& c) -> F { return &c.train.env.termination.min_altitude_ft; }, any,
       "low_altitude below this altitude"},
      {"env.termination.max_load_factor_g",
       [](C& c) -> F { return &c.train.env.termination.max_load_factor; }, positive,
       "overload above this load factor"},
      {"env.termination.failure_reward",
       [](C& c) -> F { return &c.train.env.termination.failure_reward; }, any,
       "reward for ending at a limit"},
      {"env.termination.success_reward",
       [](C& c) -> F { return &c.train.env.termination.success_reward; }, any,
       "reward for reaching the target"},

      {"network.hidden_layers",
       [](C& c) -> F { return &c.train.network.hidden_layers; },
       {0, kMaxHiddenLayers},
       "linear layers before the gated recurrent ones, and as many behind them"},
      {"network.hidden_size",
       [](C& c) -> F { return &c.train.network.hidden_size; },
       {1, kMaxWidth},
       "units of each linear layer of actor and critic"},
      {"network.gru_layers",
       [](C& c) -> F { return &c.train.network.gru_layers; },
       {1, kMaxGruLayers},
       "gated recurrent layers, each on top of the other"},
      {"network.gru_size",
       [](C& c) -> F { return &c.train.network.gru_size; },
       {1, kMaxWidth},
       "units of each gated recurrent layer"},
      {"network.activation", [](C& c) -> F { return &c.train.network.activation; }, name,
       "of the linear layers; all but relu are computed by LibTorch"},
      {"network.tanh_mean", [](C& c) -> F { return &c.train.network.tanh_mean; }, name,
       "the Gaussian's mean goes through tanh"},
      {"network.initial_log_std",
       [](C& c) -> F { return &c.train.network.initial_log_std; },
       {-10, 5},
       "initial logarithm of the actions' standard deviation"},
      {"network.actor_head_scale", [](C& c) -> F { return &c.train.network.actor_head_scale; },
       positive, "scale of the actor's last layer at the start"},

      {"ppo.num_aircraft",
       [](C& c) -> F { return &c.train.ppo.num_aircraft; },
       {1, 10000000},
       "aircraft flown at once"},
      {"ppo.rollout_steps",
       [](C& c) -> F { return &c.train.ppo.rollout_steps; },
       {1, 1000000},
       "policy steps per aircraft and iteration"},
      {"ppo.chunk_length",
       [](C& c) -> F { return &c.train.ppo.chunk_length; },
       {1, 1000000},
       "steps of truncated backpropagation through time"},
      {"ppo.epochs",
       [](C& c) -> F { return &c.train.ppo.epochs; },
       {1, 1000},
       "passes over each rollout"},
      {"ppo.minibatches", [](C& c) -> F { return &c.train.ppo.minibatches; }, count,
       "optimiser steps per pass"},
      {"ppo.learning_rate",
       [](C& c) -> F { return &c.train.ppo.learning_rate; },
       {0, 1, true},
       "Adam's learning rate at the start"},
      {"ppo.final_learning_rate_fraction",
       [](C& c) -> F { return &c.train.ppo.final_learning_rate_fraction; }, fraction,
       "share of it at the budget's end, linear in between; 1 keeps it constant"},
      {"ppo.adam_epsilon",
       [](C& c) -> F { return &c.train.ppo.adam_epsilon; },
       {0, 1, true},
       "Adam's epsilon"},
      {"ppo.gamma", [](C& c) -> F { return &c.train.ppo.gamma; }, fraction,
       "discount per policy step"},
      {"ppo.gae_lambda", [](C& c) -> F { return &c.train.ppo.gae_lambda; }, fraction,
       "lambda of the generalised advantage estimate"},
      {"ppo.clip", [](C& c) -> F { return &c.train.ppo.clip; }, positive,
       "clip range of the probability ratio"},
      {"ppo.max_gradient_norm", [](C& c) -> F { return &c.train.ppo.max_gradient_norm; }, positive,
       "largest gradient norm, actor and critic separately"},
      {"ppo.entropy_coefficient", [](C& c) -> F { return &c.train.ppo.entropy_coefficient; },
       not_negative, "weight of the entropy bonus"},
      {"ppo.value_coefficient", [](C& c) -> F { return &c.train.ppo.value_coefficient; }, positive,
       "weight of the value loss"},
      {"ppo.clip_value_loss", [](C& c) -> F { return &c.train.ppo.clip_value_loss; }, name,
       "clip the value's change like the ratio"},
      {"ppo.normalise_advantages", [](C& c) -> F { return &c.train.ppo.normalise_advantages; },
       name, "advantages get zero mean and unit variance"},
      {"ppo.popart", [](C& c) -> F { return &c.train.ppo.popart; }, name,
       "value targets normalised with the head rescaled (PopArt)"},
      {"ppo.popart_rate",
       [](C& c) -> F { return &c.train.ppo.popart_rate; },
       {0, 1, true},
       "weight of an iteration in PopArt's moving moments"},

      {"learner.backend", [](C& c) -> F { return &c.train.learner.backend; }, name,
       "networks computed by own kernels (fused) or by LibTorch, the slow reference"},
      {"learner.precision", [](C& c) -> F { return &c.train.learner.precision; }, name,
       "products of the networks in fp32, mixed (forward fp32, backward bf16), bf16, or fast "
       "(actor "
       "mixed, critic bf16); auto: fast where the processor has bf16, else fp32"},
      {"learner.tile_samples",
       [](C& c) -> F { return &c.train.learner.tile_samples; },
       {1, 1000000},
       "samples per gradient tile; part of the result, as sums are ordered by it"},
      {"learner.rollout_tile",
       [](C& c) -> F { return &c.train.learner.rollout_tile; },
       {1, 1000000},
       "aircraft per rollout tile"},

      {"evaluation.interval_iterations",
       [](C& c) -> F { return &c.train.evaluation.interval_iterations; }, count_or_none,
       "iterations between evaluations, which choose the best policy; 0: never"},
      {"evaluation.episodes", [](C& c) -> F { return &c.train.evaluation.episodes; }, count,
       "episodes of each of them"},
      {"evaluation.final_episodes", [](C& c) -> F { return &c.final_evaluation_episodes; }, count,
       "fresh episodes flown when training has finished"},

      {"checkpoint.interval_iterations",
       [](C& c) -> F { return &c.checkpoint.interval_iterations; }, count_or_none,
       "iterations between checkpoints; 0: by time alone"},
      {"checkpoint.interval_s", [](C& c) -> F { return &c.checkpoint.interval_s; }, not_negative,
       "seconds between checkpoints; 0: by iterations alone"},
      {"checkpoint.keep", [](C& c) -> F { return &c.checkpoint.keep; }, count,
       "newest checkpoints that stay on disk"},
  };
}

std::string WrongType(const Setting& setting, const SettingValue& value, const std::string& where) {
  return fmt::format("{}: {} must be {}, not {}", where, setting.key, setting.TypeName(),
                     Describe(value));
}

double CheckBounds(const Setting& setting, double number, const SettingValue& value,
                   const std::string& where) {
  const Bounds& b = setting.bounds;
  const bool above = b.min_open ? number > b.min : number >= b.min;
  if (!std::isfinite(number) || !above || number > b.max) {
    throw Error(fmt::format("{}: {} = {} is out of range; it must be in {}", where, setting.key,
                            Describe(value), setting.BoundsText()));
  }
  return number;
}

/// Puts a value into each kind of field.
struct Assigner {
  const Setting& setting;
  const SettingValue& value;
  const std::string& where;

  double Number() const {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
      return CheckBounds(setting, static_cast<double>(*integer), value, where);
    }
    if (const auto* number = std::get_if<double>(&value)) {
      return CheckBounds(setting, *number, value, where);
    }
    throw Error(WrongType(setting, value, where));
  }
  double WholeNumber() const {
    const double number = Number();
    if (number != std::floor(number)) throw Error(WrongType(setting, value, where));
    return number;
  }
  template <typename T>
  const T& Exactly() const {
    if (const auto* exact = std::get_if<T>(&value)) return *exact;
    throw Error(WrongType(setting, value, where));
  }

  void operator()(bool* field) const { *field = Exactly<bool>(); }
  void operator()(int* field) const { *field = static_cast<int>(WholeNumber()); }
  void operator()(std::uint64_t* field) const {
    *field = static_cast<std::uint64_t>(WholeNumber());
  }
  void operator()(double* field) const { *field = Number(); }
  void operator()(std::string* field) const { *field = Exactly<std::string>(); }
  template <typename Enum>
  void operator()(Enum* field) const {
    const auto& text = Exactly<std::string>();
    for (const auto& [option, option_name] : NamesOf(Enum{})) {
      if (text == option_name) {
        *field = option;
        return;
      }
    }
    throw Error(WrongType(setting, value, where));
  }
};

struct Formatter {
  std::string operator()(const bool* field) const { return *field ? "true" : "false"; }
  std::string operator()(const int* field) const { return fmt::format("{}", *field); }
  std::string operator()(const std::uint64_t* field) const { return fmt::format("{}", *field); }
  std::string operator()(const double* field) const { return FormatNumber(*field); }
  std::string operator()(const std::string* field) const { return Quote(*field); }
  template <typename Enum>
  std::string operator()(const Enum* field) const {
    for (const auto& [option, option_name] : NamesOf(*field)) {
      if (option == *field) return Quote(option_name);
    }
    throw Error("a configuration field holds a value without a name");
  }
};

struct TypeNamer {
  std::string operator()(bool*) const { return "true or false"; }
  std::string operator()(int*) const { return "an integer"; }
  std::string operator()(std::uint64_t*) const { return "an integer"; }
  std::string operator()(double*) const { return "a number"; }
  std::string operator()(std::string*) const { return "a name in quotes"; }
  template <typename Enum>
  std::string operator()(Enum*) const {
    return ListNames(NamesOf(Enum{}));
  }
};

}  // namespace

std::string Setting::TypeName() const {
  ProgramConfig config;
  return std::visit(TypeNamer{}, field(config));
}

std::string Setting::BoundsText() const {
  ProgramConfig config;
  const SettingField place = field(config);
  if (!std::holds_alternative<int*>(place) && !std::holds_alternative<double*>(place) &&
      !std::holds_alternative<std::uint64_t*>(place)) {
    return "";
  }
  const bool open_below = bounds.min_open || std::isinf(bounds.min);
  const std::string max = bounds.max == kMaxCount ? "2^53" : fmt::format("{:.10g}", bounds.max);
  return fmt::format("{}{:.10g}, {}{}", open_below ? '(' : '[', bounds.min, max,
                     std::isinf(bounds.max) ? ')' : ']');
}

const std::vector<Setting>& Settings() {
  static const std::vector<Setting> settings = MakeSettings();
  return settings;
}

const Setting& FindSetting(const std::string& key, const std::string& where) {
  const auto& settings = Settings();
  const auto found = std::find_if(settings.begin(), settings.end(),
                                  [&key](const Setting& setting) { return setting.key == key; });
  if (found != settings.end()) return *found;
  std::vector<std::string> keys;
  keys.reserve(settings.size());
  for (const Setting& setting : settings) keys.push_back(setting.key);
  const std::string suggestion = DidYouMean(key, keys);
  throw Error(
      fmt::format("{}: unknown key {}{}", where, key,
                  suggestion.empty() ? "; `skein train --help-keys` lists all keys" : suggestion));
}

void Assign(const Setting& setting, const SettingValue& value, const std::string& where,
            ProgramConfig* config) {
  std::visit(Assigner{setting, value, where}, setting.field(*config));
}

std::string FormatValue(const Setting& setting, const ProgramConfig& config) {
  ProgramConfig copy = config;
  return std::visit(Formatter{}, setting.field(copy));
}

}  // namespace skein
