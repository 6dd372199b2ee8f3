// SPDX-License-Identifier: Apache-2.0
// Flights of real environments, measured.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "envs/autopilot/autopilot.h"
#include "envs/step_memory.h"
#include "envs/tasks/observation.h"
#include "tests/envs/plant/drawn_plants.h"
#include "train/measures/flight_measurer.h"
#include "train/policy/evaluate.h"

namespace skein {
namespace {

constexpr int kEpisodes = 150;  // two tiles

EnvConfig Env(const char* task = "heading") {
  EnvConfig env;
  env.task = task;
  env.time_limit_steps = 1200;
  return env;
}

Agent AutopilotOf(const EnvConfig& env) {
  return Agent::Of(MakeAutopilot(env, AutopilotVariant::kAggressive));
}

std::vector<Episode> FlyBy(const Agent& agent, const EnvConfig& env, int threads,
                           bool flight_metrics = true) {
  WorkerPool pool(threads);
  EvaluationOptions options;
  options.episodes = kEpisodes;
  options.flight_metrics = flight_metrics;
  return FlyEpisodes(agent, env, options, pool).episodes;
}

std::vector<Episode> Fly(const EnvConfig& env, int threads = 2, bool flight_metrics = true) {
  return FlyBy(AutopilotOf(env), env, threads, flight_metrics);
}

bool IsSame(const FlightMeasures& a, const FlightMeasures& b) {
  // All of them are 32 bits wide, so there is no padding; NaN equals NaN.
  static_assert(sizeof(FlightMeasures) % sizeof(float) == 0);
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(MeasuredFlightsTest, AHoldChangesNeitherSuccessNorTimeToTarget) {
  for (const char* task : {"heading", "control"}) {
    EnvConfig env = Env(task);
    const std::vector<Episode> plain = Fly(env);
    env.hold_s = 4;
    const std::vector<Episode> held = Fly(env);
    int reached = 0;
    for (int i = 0; i < kEpisodes; ++i) {
      EXPECT_EQ(held[i].succeeded, plain[i].succeeded);
      EXPECT_EQ(held[i].reached_step, plain[i].reached_step);
      EXPECT_EQ(held[i].entered_step, plain[i].entered_step);
      reached += held[i].succeeded;
      if (held[i].termination != Termination::kTargetReached) continue;
      EXPECT_EQ(held[i].steps, plain[i].steps + 200) << "4 s";
      EXPECT_GE(held[i].measures.hold.within, 0);
      EXPECT_LE(held[i].measures.hold.within, 1);
    }
    EXPECT_GT(reached, kEpisodes / 2);
    const EvaluationResult a = Summarise(plain, 0.02), b = Summarise(held, 0.02);
    EXPECT_EQ(a.success_rate, b.success_rate);
    EXPECT_EQ(a.time_to_target_mean_s, b.time_to_target_mean_s);
  }
}

TEST(MeasuredFlightsTest, TimeToTargetLeavesTheDwellOut) {
  EnvConfig env = Env();
  env.heading.dwell_s = 2;
  int reached = 0;
  for (const Episode& episode : Fly(env)) {
    if (!episode.succeeded) continue;
    ++reached;
    EXPECT_EQ(episode.reached_step, episode.steps);
    EXPECT_EQ(episode.entered_step, episode.reached_step - 99) << "the first of 100 steps within";
    EXPECT_GE(episode.entered_step, env.heading.earliest_success_step);
  }
  EXPECT_GT(reached, kEpisodes / 2);
}

TEST(MeasuredFlightsTest, SuccessOfAHoldIsThatOfReachingWithoutMetricsToo) {
  EnvConfig env = Env();
  env.hold_s = 2;
  const std::vector<Episode> measured = Fly(env), plain = Fly(env, 2, false);
  for (int i = 0; i < kEpisodes; ++i) {
    EXPECT_EQ(plain[i].reached_step, measured[i].reached_step);
    EXPECT_TRUE(std::isnan(plain[i].metrics[kMeanMach]));
  }
}

TEST(MeasuredFlightsTest, NothingIsMeasuredUnlessAskedFor) {
  for (const Episode& episode : Fly(Env(), 1, false)) {
    EXPECT_TRUE(std::isnan(episode.measures.actions[0].variation_per_s));
    EXPECT_TRUE(std::isnan(episode.measures.hold.within));
  }
}

/// Flies twice with one thread and once with three, and returns how many targets were reached.
int TargetsOfEqualFlights(const Agent& agent, const EnvConfig& env) {
  const std::vector<Episode> first = FlyBy(agent, env, 1), again = FlyBy(agent, env, 1),
                             threads = FlyBy(agent, env, 3);
  int targets = 0;
  for (int i = 0; i < kEpisodes; ++i) {
    for (const Episode& other : {again[i], threads[i]}) {
      EXPECT_TRUE(IsSame(first[i].measures, other.measures)) << i;
      EXPECT_EQ(first[i].episode_return, other.episode_return) << i;
      EXPECT_EQ(first[i].steps, other.steps) << i;
    }
    targets += first[i].measures.targets_reached;
  }
  return targets;
}

TEST(MeasuredFlightsTest, HoldsAndMissionsRepeatExactlyWhateverTheThreads) {
  EnvConfig hold = Env(), mission = Env("control");
  hold.hold_s = 2;
  hold.wind.speed_fps = {0, 50};
  mission.mission.length_s = 40;
  EXPECT_LE(TargetsOfEqualFlights(AutopilotOf(hold), hold), kEpisodes);
  EXPECT_GT(TargetsOfEqualFlights(AutopilotOf(mission), mission), kEpisodes);
}

/// A mission in turbulence and under noise, every episode by an aircraft of its own.
EnvConfig DisturbedMission(const char* task) {
  EnvConfig env = Env(task);
  env.mission.length_s = 40;
  env.plant = DrawnPlants();
  env.observation_noise_max = 0.05;
  env.wind.speed_fps = {0, 50};
  env.wind.turbulence_fps = {0, 10};
  return env;
}

TEST(MeasuredFlightsTest, MissionsInDrawnPlantsWindAndNoiseRepeatExactlyWhateverTheThreads) {
  for (const char* task : {"heading", "control", "tracking"}) {
    const EnvConfig env = DisturbedMission(task);
    EXPECT_GT(TargetsOfEqualFlights(AutopilotOf(env), env), 0) << task;
  }
}

TEST(MeasuredFlightsTest, FlightsOfARecurrentPolicyRepeatExactlyWhateverTheThreads) {
  EnvConfig env = DisturbedMission("control");
  env.action_repeat = 5;
  NetworkConfig network;
  network.hidden_size = network.gru_size = 32;
  const RecurrentPolicy policy =
      RecurrentPolicy::Untrained(network, kObservationSize, kActionSize, 3, env.action_repeat);
  TargetsOfEqualFlights(Agent::MeanOf(policy), env);
  TargetsOfEqualFlights(Agent::SamplingFrom(policy), env);
}

TEST(MeasuredFlightsTest, AMissionThatIsFlownToItsEndIsASuccess) {
  EnvConfig env = Env();
  env.mission.length_s = 30;
  int lost = 0;
  for (const Episode& episode : Fly(env)) {
    const bool is_whole = episode.termination == Termination::kTimeLimit;
    EXPECT_EQ(episode.succeeded, is_whole);
    EXPECT_EQ(episode.steps == 1500, is_whole);
    EXPECT_EQ(episode.reached_step, 0);
    lost += !is_whole;
  }
  EXPECT_LT(lost, kEpisodes);
}

TEST(MeasuredFlightsTest, MeasuresDoNotDependOnTheTiles) {
  EnvConfig env = Env();
  env.action_repeat = 5;
  env.hold_s = 1;
  env.heading.yaw_tolerance_deg = 180;
  env.heading.altitude_tolerance_ft = env.heading.speed_tolerance_fps = 1000;
  constexpr int kAircraft = 70;
  const auto fly = [&](int tile_size) {
    VecEnv vec_env(env, kAircraft, 3, tile_size);
    std::vector<FlightMeasures> measures;
    for (int tile = 0; tile < vec_env.num_tiles(); ++tile) {
      const int count = vec_env.tile_count(tile), begin = vec_env.tile_begin(tile);
      FlightMeasurer measurer(env);
      measurer.Begin(begin, count);
      StepMemory memory(count);
      StepOutput output = memory.output();
      output.observer = &measurer;
      std::vector<float> action(static_cast<std::size_t>(count) * kActionSize);
      for (int step = 0; step < 90; ++step) {
        for (std::size_t k = 0; k < action.size(); ++k) {
          const std::size_t global = k + static_cast<std::size_t>(begin) * kActionSize;
          action[k] = 0.1f * std::sin(static_cast<float>(global + 3 * step));
        }
        vec_env.Step(tile, action.data(), output);
      }
      for (int i = 0; i < count; ++i) measures.push_back(measurer.Report(i));
    }
    return measures;
  };
  const std::vector<FlightMeasures> small = fly(32), large = fly(96);
  int reached = 0;
  for (int i = 0; i < kAircraft; ++i) {
    EXPECT_TRUE(IsSame(small[i], large[i])) << i;
    reached += small[i].reached_step > 0;
  }
  EXPECT_GT(reached, kAircraft / 4);
}

}  // namespace
}  // namespace skein
