// SPDX-License-Identifier: Apache-2.0
#include "train/policy/record_flights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "base/error.h"
#include "tests/tolerance.h"
#include "tests/train/small_config.h"

namespace skein {
namespace {

constexpr int kEpisodes = 150;  // more than a tile

class RecordFlightsTest : public ::testing::Test {
 protected:
  RecordFlightsTest() {
    options_.episodes = kEpisodes;
    options_.seed = 4;
  }

  std::vector<RecordedFlight> Record(int count, WorkerPool& pool) const {
    return RecordFlights(agent_, env_, options_, count, pool);
  }

  EnvConfig env_ = SmallConfig().env;
  Agent mean_ = Agent::MeanOf(RecurrentPolicy::Untrained(SmallConfig().network, 22, 4, 3));
  Agent sampling_ =
      Agent::SamplingFrom(RecurrentPolicy::Untrained(SmallConfig().network, 22, 4, 3));
  Agent agent_ = mean_;
  EvaluationOptions options_;
  WorkerPool pool_{2};
};

bool Same(const RecordedFlight& a, const RecordedFlight& b) {
  return a.initial_state == b.initial_state && a.target == b.target &&
         std::equal(a.steps.begin(), a.steps.end(), b.steps.begin(), b.steps.end(),
                    [](const RecordedStep& x, const RecordedStep& y) {
                      return x.state == y.state && x.action == y.action && x.reward == y.reward &&
                             x.termination == y.termination;
                    });
}

TEST_F(RecordFlightsTest, FliesWhatWasEvaluated) {
  // Some end early, in the middle of a policy step too.
  env_.termination.max_load_factor = 1.4;
  for (const bool deterministic : {true, false}) {
    agent_ = deterministic ? mean_ : sampling_;
    const EvaluationResult evaluated = Evaluate(agent_, env_, options_, pool_);
    std::array<int, kNumTerminations> terminations{};
    double return_sum = 0;
    bool mid_policy_step = false;
    for (const RecordedFlight& flight : Record(kEpisodes, pool_)) {
      ASSERT_FALSE(flight.steps.empty());
      for (const RecordedStep& step : flight.steps) {
        EXPECT_EQ(step.termination != Termination::kNone, &step == &flight.steps.back());
        return_sum += step.reward;
      }
      ++terminations[static_cast<std::size_t>(flight.steps.back().termination)];
      mid_policy_step |= flight.steps.size() % env_.action_repeat != 0;
    }
    EXPECT_EQ(terminations, evaluated.terminations);
    constexpr Tolerance kSumOrder{1e-3, "a hundred float32 rewards of one, in another order"};
    EXPECT_NEAR(return_sum / kEpisodes, evaluated.return_mean, kSumOrder);
    if (!deterministic) {
      EXPECT_TRUE(mid_policy_step);
    }
  }
}

TEST_F(RecordFlightsTest, FliesNoFurtherOnceThePoolIsAskedToStop) {
  pool_.RequestStop();
  for (const RecordedFlight& flight : Record(3, pool_)) EXPECT_TRUE(flight.steps.empty());
}

TEST_F(RecordFlightsTest, DependsNeitherOnThreadsNorOnHowManyAreRecorded) {
  agent_ = sampling_;
  WorkerPool one(1), three(3);
  const std::vector<RecordedFlight> all = Record(kEpisodes, one);
  ASSERT_EQ(all.size(), static_cast<std::size_t>(kEpisodes));
  for (const int count : {1, 5, 140}) {
    const std::vector<RecordedFlight> some = Record(count, three);
    ASSERT_EQ(some.size(), static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < some.size(); ++i) EXPECT_TRUE(Same(some[i], all[i])) << i;
  }
  EXPECT_FALSE(Same(all[0], all[1]));
  EXPECT_EQ(Record(kEpisodes + 1, one).size(), all.size());
}

TEST_F(RecordFlightsTest, HoldsActionsForAPolicyStep) {
  // Random actions depend on no observation: they change as what is drawn does.
  for (const Agent& agent : {sampling_, Agent::Random(env_.action_repeat)}) {
    agent_ = agent;
    for (const RecordedFlight& flight : Record(4, pool_)) {
      int changes = 0;
      for (std::size_t i = 1; i < flight.steps.size(); ++i) {
        const bool changes_here = flight.steps[i].action != flight.steps[i - 1].action;
        EXPECT_EQ(changes_here, i % env_.action_repeat == 0) << "step " << i;
        changes += changes_here;
        for (const float value : flight.steps[i].action) EXPECT_LE(std::abs(value), 1);
      }
      EXPECT_GT(changes, 0);
    }
  }
}

TEST_F(RecordFlightsTest, RandomActionsAreOthersForEverySeedAndEpisode) {
  agent_ = Agent::Random(env_.action_repeat);
  std::set<std::vector<float>> first_actions;
  for (const std::uint64_t seed :
       {std::uint64_t{4}, std::uint64_t{5}, 4 + (std::uint64_t{1} << 32)}) {
    options_.seed = seed;
    for (const RecordedFlight& flight : Record(kEpisodes, pool_)) {
      first_actions.insert(flight.steps.front().action);
    }
  }
  EXPECT_EQ(first_actions.size(), std::size_t{3 * kEpisodes});
}

TEST_F(RecordFlightsTest, StatesAreOfOneUnbrokenFlight) {
  constexpr Tolerance kTrapezoid{0.02, "trapezoidal rule, and float32 of 20,000 ft"};
  for (const RecordedFlight& flight : Record(6, pool_)) {
    const std::array<float, kNumRecordedColumns>* before = &flight.initial_state;
    for (const RecordedStep& step : flight.steps) {
      const auto speed = [](const std::array<float, kNumRecordedColumns>& state) {
        return std::hypot(state[kU], state[kV], state[kW]);
      };
      const double moved =
          std::hypot(step.state[kNorth] - (*before)[kNorth], step.state[kEast] - (*before)[kEast],
                     step.state[kDown] - (*before)[kDown]);
      const double flown = env_.control_interval_s * 0.5 * (speed(*before) + speed(step.state));
      ASSERT_NEAR(moved, flown, kTrapezoid) << "step " << &step - flight.steps.data();
      before = &step.state;
    }
  }
}

TEST_F(RecordFlightsTest, TheLastStateIsTheOneThatEndedTheFlight) {
  env_.termination.max_load_factor = 1.2;
  agent_ = sampling_;
  int overloads = 0;
  for (const RecordedFlight& flight : Record(40, pool_)) {
    for (const RecordedStep& step : flight.steps) {
      EXPECT_EQ(step.state[kNz] > 1.2f, step.termination == Termination::kOverload);
      overloads += step.termination == Termination::kOverload;
    }
  }
  EXPECT_GT(overloads, 5);
}

// A target that is given is flown as one that was drawn, and what follows from it, too: Control's
// reward is by a quaternion of the target's angles.
TEST_F(RecordFlightsTest, FliesToTheTargetThatIsGiven) {
  constexpr Tolerance kFloat32{1e-5, "a quaternion of angles in float32"};
  for (const char* task : {"heading", "control"}) {
    env_.task = task;
    options_.target.clear();
    const RecordedFlight drawn = Record(1, pool_).front();
    options_.target.assign(drawn.target.begin(), drawn.target.end());
    const RecordedFlight given = Record(1, pool_).front();
    ASSERT_EQ(given.steps.size(), drawn.steps.size()) << task;
    for (std::size_t i = 0; i < drawn.steps.size(); ++i) {
      ASSERT_EQ(given.steps[i].state, drawn.steps[i].state) << task << ", step " << i;
      ASSERT_NEAR(given.steps[i].reward, drawn.steps[i].reward, kFloat32) << task;
    }
    options_.target = {std::nullopt, 0.5f};
    const RecordedFlight other = Record(1, pool_).front();
    EXPECT_EQ(other.initial_state, drawn.initial_state);
    EXPECT_EQ(other.target, (std::vector<float>{drawn.target[0], 0.5f, drawn.target[2]}));
    EXPECT_NE(other.steps.back().state, drawn.steps.back().state);
    options_.target.resize(4);
    EXPECT_THROW(Record(1, pool_), Error);
  }
}

TEST_F(RecordFlightsTest, MissionsShowTheTargetOfEveryStepAndWhenItIsReached) {
  env_.mission.length_s = 20;
  env_.mission.dwell_s = 0;
  // Whatever is flown is within tolerances, so that every step reaches a target.
  env_.heading.altitude_tolerance_ft = env_.heading.speed_tolerance_fps = 1e6;
  env_.heading.yaw_tolerance_deg = 180;
  env_.heading.earliest_success_step = 100;
  for (const RecordedFlight& flight : Record(3, pool_)) {
    EXPECT_EQ(flight.steps[0].target, flight.target);
    for (std::size_t i = 1; i < flight.steps.size(); ++i) {
      EXPECT_EQ(flight.steps[i].target != flight.steps[i - 1].target,
                flight.steps[i - 1].reaches_target)
          << "step " << i;
      EXPECT_EQ(flight.steps[i - 1].reaches_target, i >= 100) << "step " << i;
    }
  }
}

TEST_F(RecordFlightsTest, AFlightThatGoesOnReachesItsTargetOnce) {
  env_.hold_s = 1;
  env_.heading.altitude_tolerance_ft = env_.heading.speed_tolerance_fps = 1e6;
  env_.heading.yaw_tolerance_deg = 180;
  env_.heading.earliest_success_step = 100;
  for (const RecordedFlight& flight : Record(3, pool_)) {
    for (std::size_t i = 0; i < flight.steps.size(); ++i) {
      EXPECT_EQ(flight.steps[i].reaches_target, i + 1 == 100) << "step " << i;
    }
    EXPECT_EQ(flight.steps.back().termination, Termination::kTargetReached);
  }
}

TEST_F(RecordFlightsTest, RefusesToRecordNothing) {
  EXPECT_THROW(Record(0, pool_), Error);
  options_.episodes = 0;
  EXPECT_THROW(Record(1, pool_), Error);
}

TEST(RecordMissionsTest, TargetsOfAMissionAreReachedUpToItsLastStep) {
  EnvConfig env;
  env.task = "control";
  env.control.pitch_tolerance_deg = env.control.yaw_tolerance_deg = 180;
  env.control.speed_tolerance_fps = 1e6;  // within them in every state
  env.mission.dwell_s = 1;
  env.mission.length_s = 5;
  EvaluationOptions options;
  options.episodes = 1;
  WorkerPool pool(1);
  const RecordedFlight flight = RecordFlights(Agent::Zero(), env, options, 1, pool).front();
  ASSERT_EQ(flight.steps.size(), 250u);
  EXPECT_EQ(flight.steps.back().termination, Termination::kTimeLimit);
  for (std::size_t step = 0; step < flight.steps.size(); ++step) {
    EXPECT_EQ(flight.steps[step].reaches_target, step % 50 == 49) << step;
  }
}

}  // namespace
}  // namespace skein
