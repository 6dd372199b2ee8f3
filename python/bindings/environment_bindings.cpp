// SPDX-License-Identifier: Apache-2.0
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/fnv_hash.h"
#include "base/worker_pool.h"
#include "envs/aircraft/registry.h"
#include "envs/interface_names.h"
#include "envs/step_memory.h"
#include "envs/task_registry.h"
#include "envs/vec_env.h"
#include "python/bindings/bindings.h"
#include "python/bindings/flying_agent.h"
#include "python/bindings/interpreter_lock.h"
#include "python/bindings/last_states.h"
#include "python/bindings/settings_text.h"
#include "python/bindings/shown_state.h"
#include "python/bindings/snapshot_origin.h"
#include "src/agents/low_level_option.h"
#include "src/config/program_config.h"
#include "train/policy/low_level_file.h"
#include "train/policy/stored_policy.h"

namespace nb = nanobind;

namespace skein {
namespace {

constexpr int kMostPerTile = 256;  // few enough that all threads end at about the same time
constexpr int kTileGrain = 32;     // VecEnv's tiles are multiples of it

int ThreadsFor(int num_envs, int threads) {
  const int asked = threads == 0 ? WorkerPool().threads() : threads;
  return std::clamp((num_envs + kTileGrain - 1) / kTileGrain, 1, std::max(asked, 1));
}

/// As long as every thread has one.
int TileSize(int num_envs, int threads) {
  const int share = (num_envs + threads - 1) / threads;
  return std::min((share + kTileGrain - 1) / kTileGrain * kTileGrain, kMostPerTile);
}

/// Of all that says what is flown: every setting, and the low-level policy, if it is a stored one.
std::uint64_t HashOfEnvironment(const ProgramConfig& config, const Policy* low_level) {
  const std::string text = SettingsText(config, "env.");
  FnvHash hash;
  hash.Add(text.data(), text.size());
  if (const auto* const stored = dynamic_cast<const StoredPolicy*>(low_level)) {
    TensorFile file;
    StoreLowLevelPolicy(*stored, file);
    const std::string bytes = file.Bytes();
    hash.Add(bytes.data(), bytes.size());
  }
  return hash.value();
}

/// Lets one thread of Python use an environment at a time. It waits without the interpreter's lock,
/// which whoever it waits for takes back before it is done.
class Turn {
 public:
  explicit Turn(std::mutex& mutex) : lock_(mutex, std::try_to_lock) {
    if (lock_.owns_lock()) return;
    const InterpreterUnlocked unlocked;
    lock_.lock();
  }

 private:
  std::unique_lock<std::mutex> lock_;
};

/// An environment's aircraft all at once: a VecEnv and the threads that step its tiles. Rows of
/// arrays are aircraft, in the order of their numbers. Throws Error if an `agent` is given that was
/// made for something else. What touches the aircraft takes its Turn; `env_` itself is replaced
/// with the interpreter's lock, with which its sizes are read.
class BatchEnv {
 public:
  BatchEnv(const ProgramConfig& config, int num_envs, std::uint64_t seed, int threads,
           std::shared_ptr<const Policy> low_level, const std::optional<FlyingAgent>& agent)
      : config_(config.train.env),
        origin_{seed, HashOfEnvironment(config, low_level.get())},
        low_level_(std::move(low_level)),
        pool_(ThreadsFor(num_envs, threads)),
        env_(Make(num_envs, seed)),
        ended_(static_cast<std::size_t>(env_->num_tiles())),
        memory_(num_envs, {env_->observation_size()}) {
    if (agent) agent->agent.CheckFits(*env_);
    pool_.StayAwake();  // what Python does between two steps is often short
  }

  const VecEnv& env() const { return *env_; }
  const EnvConfig& config() const { return config_; }
  int threads() const { return pool_.threads(); }
  /// Of the episodes that are flown: the latest of Reset and Restore.
  std::uint64_t seed() const { return origin_.seed; }

  /// The episodes that a fresh environment with this seed begins with.
  void Reset(std::uint64_t seed) {
    const Turn turn(mutex_);
    std::unique_ptr<VecEnv> fresh;
    {
      const InterpreterUnlocked unlocked;
      fresh = Make(env_->num_aircraft(), seed);
    }
    env_ = std::move(fresh);
    origin_.seed = seed;
  }

  void Restart(const Row<const bool>& begins) {
    const Turn turn(mutex_);
    Require(begins.shape(0) == rows(), "restart: one flag for every environment");
    for (int tile = 0; tile < env_->num_tiles(); ++tile) {
      env_->Restart(tile, begins.data() + env_->tile_begin(tile));
    }
  }

  void Observe(const Rows<float>& observation) {
    const Turn turn(mutex_);
    CheckObservation(observation);
    const InterpreterUnlocked unlocked;
    pool_.ForEach(env_->num_tiles(), [&](int tile, int) {
      env_->Observe(tile, observation.data() + FirstOf(tile) * observation_size());
    });
  }

  /// Steps, then observes. Returns how many episodes ended.
  int Step(const Rows<const float>& action, const Rows<float>& observation,
           const Row<float>& reward, const Row<std::uint8_t>& termination,
           const Row<bool>& terminated, const Row<bool>& truncated) {
    const Turn turn(mutex_);
    CheckActions(action);
    CheckObservation(observation);
    Require(reward.shape(0) == rows() && termination.shape(0) == rows() &&
                terminated.shape(0) == rows() && truncated.shape(0) == rows(),
            "step: one reward, termination and flag for every environment");
    const InterpreterUnlocked unlocked;
    if (last_states_) last_states_->Begin();
    pool_.ForEach(env_->num_tiles(), [&](int tile, int) {
      const std::size_t first = FirstOf(tile);
      StepOutput output = memory_.output(env_->tile_begin(tile));
      output.reward = reward.data() + first;
      output.termination = termination.data() + first;
      output.observes_every_end = true;
      output.observer = last_states_.get();
      env_->Step(tile, action.data() + first * action_size(), output);
      env_->Observe(tile, observation.data() + first * observation_size());
      SplitEnds(tile, termination.data(), terminated.data(), truncated.data());
    });
    std::size_t count = 0;
    for (const std::vector<std::int64_t>& ended : ended_) count += ended.size();
    return static_cast<int>(count);
  }

  /// Of the episodes that ended in the latest step: environments and last observations; and of all
  /// environments, zero where none ended, returns and lengths in control steps.
  nb::tuple Ends() const {
    const Turn turn(mutex_);
    std::vector<std::int64_t> index;
    std::vector<float> observation, episode_return(rows());
    std::vector<std::int32_t> steps(rows());
    for (const std::vector<std::int64_t>& ended : ended_) {
      index.insert(index.end(), ended.begin(), ended.end());
    }
    const std::size_t count = index.size();
    observation.reserve(count * observation_size());
    for (const std::int64_t i : index) {
      const auto row = static_cast<std::size_t>(i);
      const float* const last = memory_.final_observation.data() + row * observation_size();
      observation.insert(observation.end(), last, last + observation_size());
      episode_return[row] = memory_.episode_return[row];
      steps[row] = memory_.episode_steps[row] - memory_.first_clock[row];
    }
    return nb::make_tuple(ToNumpy(std::move(index), {count}),
                          ToNumpy(std::move(observation), {count, observation_size()}),
                          ToNumpy(std::move(episode_return), {rows()}),
                          ToNumpy(std::move(steps), {rows()}));
  }

  nb::object State() const {
    const Turn turn(mutex_);
    std::vector<float> state(rows() * kShownColumns.size()), column(rows());
    for (std::size_t k = 0; k < kShownColumns.size(); ++k) {
      for (int tile = 0; tile < env_->num_tiles(); ++tile) {
        env_->ReadColumn(tile, kShownColumns[k].column, column.data() + env_->tile_begin(tile));
      }
      for (std::size_t i = 0; i < rows(); ++i) state[i * kShownColumns.size() + k] = column[i];
    }
    return nb::cast(ToNumpy(std::move(state), {rows(), kShownColumns.size()}));
  }

  /// From now on steps remember the states that they end with.
  void KeepLastStates() {
    const Turn turn(mutex_);
    last_states_ = std::make_unique<LastStates>(
        env_->num_aircraft(), MakeTask(config_)->num_targets(), config_.action_repeat);
  }
  /// As of LastStates::Columns().
  nb::object LastStatesSeen() const {
    const Turn turn(mutex_);
    Require(last_states_ != nullptr, "last_states: they are not kept");
    return nb::cast(ToNumpy(last_states_->Columns(), {last_states_->num_columns(), rows()}));
  }

  nb::list TargetNames() const {
    nb::list names;
    for (const TargetQuantity& quantity : MakeTask(config_)->target_quantities()) {
      std::string name = std::string("target_") + quantity.column;
      if (quantity.is_angle) name.replace(name.size() - 3, 3, "rad");
      names.append(name);
    }
    return names;
  }

  nb::object Targets() const {
    const Turn turn(mutex_);
    std::vector<float> targets;
    for (int i = 0; i < env_->num_aircraft(); ++i) {
      const std::vector<float> target = env_->TargetOf(i);
      targets.insert(targets.end(), target.begin(), target.end());
    }
    const std::size_t size = targets.size() / rows();
    return nb::cast(ToNumpy(std::move(targets), {rows(), size}));
  }

  nb::object Snapshot() const {
    const Turn turn(mutex_);
    std::vector<std::uint32_t> words = env_->Snapshot();
    AddOrigin(origin_, &words);
    const std::size_t size = words.size();
    return nb::cast(ToNumpy(std::move(words), {size}));
  }
  /// Goes on from a Snapshot, with its seed. Throws Error on one of another configuration or number
  /// of aircraft, and changes nothing then.
  void Restore(const Row<const std::uint32_t>& snapshot) {
    const Turn turn(mutex_);
    std::vector<std::uint32_t> words(snapshot.data(), snapshot.data() + snapshot.size());
    const SnapshotOrigin origin = TakeOrigin(&words);
    if (origin.configuration != origin_.configuration) {
      throw Error("restore: the snapshot is of another configuration, or of another Skein");
    }
    if (origin.seed == origin_.seed) {
      env_->Restore(words);
      return;
    }
    std::unique_ptr<VecEnv> env = Make(env_->num_aircraft(), origin.seed);
    env->Restore(words);
    env_ = std::move(env);
    origin_ = origin;
  }

 private:
  static void Require(bool holds, const char* message) {
    if (!holds) throw Error(message);
  }
  std::unique_ptr<VecEnv> Make(int num_envs, std::uint64_t seed) const {
    return std::make_unique<VecEnv>(config_, num_envs, seed, TileSize(num_envs, pool_.threads()),
                                    low_level_);
  }
  std::size_t rows() const { return static_cast<std::size_t>(env_->num_aircraft()); }
  std::size_t observation_size() const {
    return static_cast<std::size_t>(env_->observation_size());
  }
  std::size_t action_size() const { return static_cast<std::size_t>(env_->action_size()); }
  std::size_t FirstOf(int tile) const { return static_cast<std::size_t>(env_->tile_begin(tile)); }

  void CheckObservation(const Rows<float>& observation) const {
    Require(observation.shape(0) == rows() && observation.shape(1) == observation_size(),
            "observations: one row for every environment");
  }
  void CheckActions(const Rows<const float>& action) const {
    if (action.shape(0) == rows() && action.shape(1) == action_size()) return;
    throw Error("actions of shape (" + std::to_string(action.shape(0)) + ", " +
                std::to_string(action.shape(1)) + "), but the environment takes (" +
                std::to_string(rows()) + ", " + std::to_string(action_size()) + ")");
  }

  /// Of a tile's aircraft: the time limit ends an episode as truncated where it is no failure.
  void SplitEnds(int tile, const std::uint8_t* termination, bool* terminated, bool* truncated) {
    const bool truncates = config_.episode().truncate_at_time_limit;
    constexpr auto kNone = static_cast<std::uint8_t>(Termination::kNone);
    constexpr auto kTimeLimit = static_cast<std::uint8_t>(Termination::kTimeLimit);
    std::vector<std::int64_t>& ended = ended_[static_cast<std::size_t>(tile)];
    ended.clear();
    const std::size_t first = FirstOf(tile);
    const auto count = static_cast<std::size_t>(env_->tile_count(tile));
    std::fill_n(terminated + first, count, false);
    std::fill_n(truncated + first, count, false);
    for (std::size_t i = first; i < first + count; ++i) {
      if (termination[i] == kNone) continue;
      const bool is_truncated = truncates && termination[i] == kTimeLimit;
      (is_truncated ? truncated : terminated)[i] = true;
      ended.push_back(static_cast<std::int64_t>(i));
    }
  }

  mutable std::mutex mutex_;
  EnvConfig config_;
  SnapshotOrigin origin_;
  std::shared_ptr<const Policy> low_level_;
  WorkerPool pool_;
  std::unique_ptr<VecEnv> env_;
  std::unique_ptr<LastStates> last_states_;       ///< null: not kept
  std::vector<std::vector<std::int64_t>> ended_;  ///< in the latest step, by tile
  StepMemory memory_;  ///< of all environments; rewards and terminations are the caller's
};

/// By the name under which each surface is observed, how far it goes up or down, as a multiple of
/// its upper limit.
nb::dict SurfaceReaches(const EnvConfig& env) {
  const Actuators surfaces = LoadAircraft(env.aircraft).actuators;
  nb::dict reaches;
  const auto add = [&](const char* name, const Actuator& surface) {
    reaches[name] = std::max(-surface.min_deg / surface.max_deg, 1.0);
  };
  add("elevator_fraction", surfaces.elevator);
  add("aileron_fraction", surfaces.aileron);
  add("rudder_fraction", surfaces.rudder);
  add("leading_edge_flap_fraction", surfaces.leading_edge_flap);
  return reaches;
}

/// The low-level policy that an environment flies with: that of `agent` if it is a high-level
/// policy, else what `low_level` names; where the task can do without, none.
std::shared_ptr<const Policy> LowLevelFor(const EnvConfig& env, const std::string& low_level,
                                          const std::optional<FlyingAgent>& agent) {
  if (agent) {
    if (auto own = agent->agent.low_level()) return own;
    if (low_level.empty()) return nullptr;
  }
  return ChooseLowLevelPolicy(env, low_level).policy;
}

}  // namespace

void BindEnvironment(nb::module_& module) {
  nb::list names;
  for (const NamedColumn& shown : kShownColumns) names.append(shown.name);
  module.attr("SHOWN_STATE_NAMES") = nb::tuple(names);
  nb::class_<BatchEnv>(module, "BatchEnv")
      .def(
          "__init__",
          [](BatchEnv* place, const ProgramConfig& config, int num_envs, std::uint64_t seed,
             int threads, const std::string& low_level, const std::optional<FlyingAgent>& agent) {
            ProgramConfig flown = config;
            if (agent) flown.train.env = agent->agent.EnvironmentFor(config.train.env);
            auto below = LowLevelFor(flown.train.env, low_level, agent);
            new (place) BatchEnv(flown, num_envs, seed, threads, std::move(below), agent);
          },
          nb::arg("config"), nb::arg("num_envs"), nb::arg("seed"), nb::arg("threads"),
          nb::arg("low_level"), nb::arg("agent").none())
      .def("reset", &BatchEnv::Reset, nb::arg("seed"))
      .def("restart", &BatchEnv::Restart, nb::arg("begins"))
      .def("observe", &BatchEnv::Observe, nb::arg("observation").noconvert())
      .def("step", &BatchEnv::Step, nb::arg("action"), nb::arg("observation").noconvert(),
           nb::arg("reward").noconvert(), nb::arg("termination").noconvert(),
           nb::arg("terminated").noconvert(), nb::arg("truncated").noconvert())
      .def("ends", &BatchEnv::Ends)
      .def("state", &BatchEnv::State)
      .def("targets", &BatchEnv::Targets)
      .def("keep_last_states", &BatchEnv::KeepLastStates)
      .def("last_states", &BatchEnv::LastStatesSeen)
      .def("snapshot", &BatchEnv::Snapshot)
      .def("restore", &BatchEnv::Restore, nb::arg("words"))
      .def_prop_ro("num_envs", [](const BatchEnv& env) { return env.env().num_aircraft(); })
      .def_prop_ro("observation_size",
                   [](const BatchEnv& env) { return env.env().observation_size(); })
      .def_prop_ro("observation_names",
                   [](const BatchEnv& env) { return ObservationNames(*MakeTask(env.config())); })
      .def_prop_ro("action_size", [](const BatchEnv& env) { return env.env().action_size(); })
      .def_prop_ro("target_names", &BatchEnv::TargetNames)
      .def_prop_ro("action_repeat", [](const BatchEnv& env) { return env.config().action_repeat; })
      .def_prop_ro("control_interval_s",
                   [](const BatchEnv& env) { return env.config().control_interval_s; })
      .def_prop_ro("observation_noise",
                   [](const BatchEnv& env) {
                     return std::max(env.config().observation_noise, env.config().most_noise());
                   })
      .def_prop_ro("surface_reaches",
                   [](const BatchEnv& env) { return SurfaceReaches(env.config()); })
      .def_prop_ro("draws_plants", [](const BatchEnv& env) { return env.config().plant.enabled(); })
      .def_prop_ro("threads", &BatchEnv::threads)
      .def_prop_ro("seed", &BatchEnv::seed);
}

}  // namespace skein
