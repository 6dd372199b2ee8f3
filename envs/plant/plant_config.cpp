// SPDX-License-Identifier: Apache-2.0
#include "envs/plant/plant_config.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/field_list.h"

namespace skein {
namespace {

constexpr Bounds kFactor{0.1, 10};

/// A quantity that is drawn from a Range. Its nominal value is the range's default.
struct Quantity {
  const char* name;  // of its keys, with _min and _max behind it
  const char* unit;
  Range PlantConfig::*range;
  Bounds bounds;
  const char* help;  // what it is
};

const std::vector<Quantity>& Quantities() {
  static const std::vector<Quantity> quantities = {
      {"mass", "", &PlantConfig::mass, kFactor, "factor of the mass"},
      {"inertia", "", &PlantConfig::inertia, kFactor, "factor of all moments of inertia"},
      {"cg_shift",
       "",
       &PlantConfig::cg_shift,
       {-0.5, 0.5},
       "shift of the centre of gravity, aft, fraction of the mean chord"},
      {"axial_force", "", &PlantConfig::axial_force, kFactor, "factor of static Cx (drag)"},
      {"normal_force", "", &PlantConfig::normal_force, kFactor, "factor of static Cz (lift)"},
      {"pitching_moment", "", &PlantConfig::pitching_moment, kFactor, "factor of static Cm"},
      {"lateral", "", &PlantConfig::lateral, kFactor, "factor of static Cy, Cl and Cn"},
      {"control", "", &PlantConfig::control, kFactor,
       "factor of the effect of elevator, aileron and rudder"},
      {"weak_surface",
       "",
       &PlantConfig::weak_surface,
       {0.1, 1},
       "factor of the effect of one of the three, drawn"},
      {"damping", "", &PlantConfig::damping, kFactor, "factor of all derivatives by p, q and r"},
      {"thrust", "", &PlantConfig::thrust, kFactor, "factor of the thrust"},
      {"thrust_lag", "", &PlantConfig::thrust_lag, kFactor, "factor of the time that power takes"},
      {"engine_momentum",
       "slug_ft2_per_s",
       &PlantConfig::engine_momentum,
       {-1e6, 1e6},
       "angular momentum of the engine beyond the aircraft's"},
      {"density", "", &PlantConfig::density, kFactor, "factor of the air's density"},
      {"pitch_stick", "", &PlantConfig::pitch_stick, kFactor, "factor of pitch commands"},
      {"roll_stick", "", &PlantConfig::roll_stick, kFactor, "factor of roll commands"},
      {"yaw_stick", "", &PlantConfig::yaw_stick, kFactor, "factor of yaw commands"},
      {"actuator_rate", "", &PlantConfig::actuator_rate, kFactor,
       "factor of the actuators' rate limits"},
      {"actuator_bandwidth", "", &PlantConfig::actuator_bandwidth, kFactor,
       "factor of the actuators' bandwidths"}};
  return quantities;
}

void ListDelay(const std::string& name, const std::string& what, WholeRange* range,
               FieldList& list) {
  const Bounds bounds{0, kLongestDelay};
  list.Add((name + "_min_steps").c_str(), &range->min, bounds,
           ("shortest delay of " + what + ", control steps").c_str());
  list.Add((name + "_max_steps").c_str(), &range->max, bounds,
           ("longest delay of " + what + ", control steps").c_str());
}

void RequireOrder(const char* name, const WholeRange& range) {
  if (range.min <= range.max) return;
  throw Error("configuration: env.plant." + std::string(name) + "_min_steps = " +
              std::to_string(range.min) + ", but it must be no more than env.plant." + name +
              "_max_steps, " + std::to_string(range.max));
}

}  // namespace

bool PlantConfig::enabled() const {
  const PlantConfig nominal;
  const auto differs = [&](const Quantity& quantity) {
    const Range &range = this->*quantity.range, &usual = nominal.*quantity.range;
    return range.min != usual.min || range.max != usual.max;
  };
  const std::vector<Quantity>& quantities = Quantities();
  return std::any_of(quantities.begin(), quantities.end(), differs) || action_delay_steps.max > 0 ||
         observation_delay_steps.max > 0 || has_sensor_errors() || sensor_freeze_chance > 0;
}

PlantConfig PlantConfig::Narrowed(double share) const {
  const PlantConfig nominal;
  PlantConfig narrowed = *this;
  for (const Quantity& quantity : Quantities()) {
    Range& range = narrowed.*quantity.range;
    range = skein::Narrowed(range, (nominal.*quantity.range).min, share);
  }
  for (WholeRange* const delay :
       {&narrowed.action_delay_steps, &narrowed.observation_delay_steps}) {
    delay->min = static_cast<int>(std::lround(share * delay->min));
    delay->max = static_cast<int>(std::lround(share * delay->max));
  }
  narrowed.sensor_bias *= share;
  narrowed.sensor_scale *= share;
  narrowed.sensor_freeze_chance *= share;
  return narrowed;
}

void ListFields(PlantConfig& config, FieldList& list) {
  for (const Quantity& quantity : Quantities()) {
    const std::string help = quantity.help;
    list.AddRange(quantity.name, quantity.unit, &(config.*quantity.range), quantity.bounds,
                  ("least " + help).c_str(), ("greatest " + help).c_str());
  }
  ListDelay("action_delay", "throttle and stick commands", &config.action_delay_steps, list);
  ListDelay("observation_delay", "the state that is observed", &config.observation_delay_steps,
            list);
  list.Add("sensor_bias", &config.sensor_bias, Bounds::Fraction(),
           "every observed number but the task's errors is off by its own U(-x, x)");
  list.Add("sensor_scale", &config.sensor_scale, Bounds::Fraction(),
           "every observed number but the task's errors is multiplied with its own 1 + U(-x, x)");
  list.Add("sensor_freeze_chance", &config.sensor_freeze_chance, Bounds::Fraction(),
           "chance of an episode in which one sensor keeps its last value from some time on");
  list.AddRange("sensor_freeze", "s", &config.sensor_freeze_s, Bounds::NotNegative(),
                "earliest time at which it freezes", "latest time at which it freezes");
}

void Validate(const PlantConfig& config) {
  RequireOrder("action_delay", config.action_delay_steps);
  RequireOrder("observation_delay", config.observation_delay_steps);
}

}  // namespace skein
