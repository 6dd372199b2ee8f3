// SPDX-License-Identifier: Apache-2.0
#include "envs/autopilot/autopilot.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>

#include "base/denormals.h"
#include "base/error.h"
#include "envs/actions.h"
#include "envs/aircraft/f16_units.h"
#include "envs/tasks/observation.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/autopilot/autopilot.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/autopilot/laws-inl.h"
#include "envs/autopilot/rows-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// A full vector of aircraft.
template <template <class> class Law>
HWY_INLINE void ActForGroup(const AutopilotGains& gains, const AutopilotTiming& timing,
                            const float* observation, float* state, float* action) {
  using Memory = typename Law<Lanes>::Memory;
  static_assert(std::is_trivially_copyable_v<Memory> && sizeof(Memory) % sizeof(Lanes) == 0);
  constexpr int kStateSize = sizeof(Memory) / sizeof(Lanes);
  const FloatTag d;
  alignas(64) float columns[std::max(kStateSize, kObservationSize) * kLanes];

  Lanes observed[kObservationSize];
  ColumnsFromRows(observation, kObservationSize, columns);
  std::memcpy(static_cast<void*>(observed), columns, sizeof(observed));
  Memory memory;
  ColumnsFromRows(state, kStateSize, columns);
  std::memcpy(static_cast<void*>(&memory), columns, sizeof(memory));

  Lanes actions[kActionSize];
  Law<Lanes>::Act(gains, timing, observed, memory, actions);

  std::memcpy(columns, static_cast<const void*>(&memory), sizeof(memory));
  RowsFromColumns(columns, kStateSize, state);
  hn::StoreInterleaved4(actions[0].v, actions[1].v, actions[2].v, actions[3].v, d, action);
}

template <template <class> class Law>
HWY_INLINE void ActForAll(const AutopilotGains& gains, const AutopilotTiming& timing, int count,
                          const float* observation, float* state, float* action) {
  constexpr int kStateSize = sizeof(typename Law<Lanes>::Memory) / sizeof(Lanes);
  int first = 0;
  for (; first + kLanes <= count; first += kLanes) {
    ActForGroup<Law>(gains, timing, observation + first * kObservationSize,
                     state + first * kStateSize, action + first * kActionSize);
  }
  const int rest = count - first;
  if (rest == 0) return;
  float last_observation[kLanes * kObservationSize] = {}, last_state[kLanes * kStateSize] = {};
  float last_action[kLanes * kActionSize];
  std::copy_n(observation + first * kObservationSize, rest * kObservationSize, last_observation);
  std::copy_n(state + first * kStateSize, rest * kStateSize, last_state);
  ActForGroup<Law>(gains, timing, last_observation, last_state, last_action);
  std::copy_n(last_state, rest * kStateSize, state + first * kStateSize);
  std::copy_n(last_action, rest * kActionSize, action + first * kActionSize);
}

void ActInHeading(const AutopilotGains& gains, const AutopilotTiming& timing, int count,
                  const float* observation, float* state, float* action) {
  ActForAll<HeadingLaw>(gains, timing, count, observation, state, action);
}
void ActInControl(const AutopilotGains& gains, const AutopilotTiming& timing, int count,
                  const float* observation, float* state, float* action) {
  ActForAll<ControlLaw>(gains, timing, count, observation, state, action);
}
void ActInTracking(const AutopilotGains& gains, const AutopilotTiming& timing, int count,
                   const float* observation, float* state, float* action) {
  ActForAll<TrackingLaw>(gains, timing, count, observation, state, action);
}

template <template <class> class Law>
constexpr int StateSizeOf() {
  return sizeof(typename Law<double>::Memory) / sizeof(double);
}
constexpr int kHeadingStateSize = StateSizeOf<HeadingLaw>();
constexpr int kControlStateSize = StateSizeOf<ControlLaw>();
constexpr int kTrackingStateSize = StateSizeOf<TrackingLaw>();

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
namespace {

HWY_EXPORT(ActInHeading);
HWY_EXPORT(ActInControl);
HWY_EXPORT(ActInTracking);

using ActFunction = void (*)(const AutopilotGains&, const AutopilotTiming&, int, const float*,
                             float*, float*);

/// An autopilot of one task.
struct Registration {
  const char* task;
  int state_size;
  ActFunction (*act)();  ///< the build for the active target
};

const Registration kAutopilots[] = {
    {"heading", HWY_NAMESPACE::kHeadingStateSize, [] { return SKEIN_DISPATCH(ActInHeading); }},
    {"control", HWY_NAMESPACE::kControlStateSize, [] { return SKEIN_DISPATCH(ActInControl); }},
    {"tracking", HWY_NAMESPACE::kTrackingStateSize, [] { return SKEIN_DISPATCH(ActInTracking); }},
};

const Registration& AutopilotFor(const std::string& task) {
  for (const Registration& autopilot : kAutopilots) {
    if (autopilot.task == task) return autopilot;
  }
  throw Error("the autopilot does not fly env.task = \"" + task +
              "\", but \"heading\", \"control\" and \"tracking\"");
}

void CheckFlies(const EnvConfig& config) {
  if (config.aircraft != "f16") {
    throw Error("the autopilot flies env.aircraft = \"f16\", not \"" + config.aircraft + "\"");
  }
  if (config.flight_control != FlightControlMode::kFull) {
    throw Error(
        "the autopilot flies with env.flight_control = \"full\": its stick commands ask for load "
        "factor and roll rate");
  }
  if (config.task == "tracking" && config.tracking.error_axes != kAutopilotErrorAxes) {
    throw Error(std::string("the autopilot flies with env.tracking.error_axes = \"") +
                Name(kAutopilotErrorAxes) + '"');
  }
}

class Autopilot : public Policy {
 public:
  Autopilot(const Registration& law, const AutopilotGains& gains, const AutopilotTiming& timing)
      : law_(law), gains_(gains), timing_(timing) {}

  int observation_size() const override { return kObservationSize; }
  int action_size() const override { return kActionSize; }
  int state_size() const override { return law_.state_size; }
  int action_repeat() const override { return 1; }
  EnvConfig EnvironmentFor(const EnvConfig& env) const override {
    EnvConfig own = Policy::EnvironmentFor(env);
    own.tracking.error_axes = kAutopilotErrorAxes;
    return own;
  }
  void CheckMadeFor(const EnvConfig& env, const std::string& who) const override {
    const auto quoted = [](const std::string& text) { return '"' + text + '"'; };
    if (env.task != law_.task) {
      throw Error(who + ": it flies env.task = " + quoted(law_.task) + ", not " + quoted(env.task));
    }
    if (env.control_interval_s != timing_.dt) {
      throw Error(who + ": it flies at another env.control_interval_s");
    }
    try {
      CheckFlies(env);
    } catch (const Error& error) {
      throw Error(who + ": " + error.what());
    }
  }

  void Act(int count, const float* observation, float* state, float* action) const override {
    const DenormalsFlushed flushed;
    law_.act()(gains_, timing_, count, observation, state, action);
  }

 private:
  const Registration& law_;
  AutopilotGains gains_;
  AutopilotTiming timing_;
};

}  // namespace

std::unique_ptr<Policy> MakeAutopilot(const EnvConfig& config, const AutopilotGains& gains) {
  CheckFlies(config);
  AutopilotTiming timing;
  timing.dt = config.control_interval_s;
  timing.control_steps_per_outer_step =
      std::max(1, static_cast<int>(std::lround(gains.outer_interval_s / timing.dt)));
  return std::make_unique<Autopilot>(AutopilotFor(config.task), gains, timing);
}

AutopilotGains GainsFor(const EnvConfig& config, AutopilotVariant variant) {
  CheckFlies(config);
  AutopilotGains gains = GainsOf(variant);
  gains.tecs.level_throttle = TrimmedLevelThrottle(config);
  return gains;
}

std::unique_ptr<Policy> MakeAutopilot(const EnvConfig& config, AutopilotVariant variant) {
  return MakeAutopilot(config, GainsFor(config, variant));
}

}  // namespace skein
#endif
