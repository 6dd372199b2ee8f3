// SPDX-License-Identifier: Apache-2.0
// Flights of real environments, measured.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "envs/autopilot/autopilot.h"
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

std::vector<Episode> Fly(const EnvConfig& env, int threads = 2, bool flight_metrics = true) {
  WorkerPool pool(threads);
  EvaluationOptions options;
  options.episodes = kEpisodes;
  options.flight_metrics = flight_metrics;
  const Agent autopilot = Agent::Of(MakeAutopilot(env, AutopilotVariant::kAggressive));
  return FlyEpisodes(autopilot, env, options, pool).episodes;
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

TEST(MeasuredFlightsTest, HoldsAndMissionsRepeatExactlyWhateverTheThreads) {
  EnvConfig hold = Env(), mission = Env("control");
  hold.hold_s = 2;
  hold.wind.speed_fps = {0, 50};
  mission.mission.length_s = 40;
  for (const EnvConfig& env : {hold, mission}) {
    const std::vector<Episode> first = Fly(env, 1), again = Fly(env, 1), threads = Fly(env, 3);
    int targets = 0;
    for (int i = 0; i < kEpisodes; ++i) {
      EXPECT_TRUE(IsSame(first[i].measures, again[i].measures)) << i;
      EXPECT_TRUE(IsSame(first[i].measures, threads[i].measures)) << i;
      EXPECT_EQ(first[i].episode_return, threads[i].episode_return);
      targets += first[i].measures.targets_reached;
    }
    EXPECT_EQ(targets > kEpisodes, env.mission.enabled());
  }
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
      std::vector<float> reward(count), episode_return(count), observation(22 * count);
      std::vector<std::uint8_t> termination(count);
      std::vector<std::int32_t> steps(count);
      StepOutput output{reward.data(), termination.data(), episode_return.data(), steps.data(),
                        observation.data()};
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
