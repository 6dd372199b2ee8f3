// SPDX-License-Identifier: Apache-2.0
#include "train/policy/record_flights.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "base/error.h"
#include "envs/control_step.h"
#include "envs/low_level_flight.h"
#include "envs/step_memory.h"
#include "envs/vec_env.h"
#include "train/policy/tile_agent.h"

namespace skein {
namespace {

std::array<float, kNumRecordedColumns> StateOf(const VecEnv& env, int aircraft) {
  std::array<float, kNumRecordedColumns> state;
  for (int column = 0; column < kNumRecordedColumns; ++column) {
    state[column] = env.StateOf(aircraft, column);
  }
  return state;
}

float Clipped(float command) { return std::clamp(command, -1.0f, 1.0f); }

/// Whether aircraft `i` has one target more than the `targets_reached` before the step. What fails
/// in the very step has not reached it.
bool ReachesTarget(const ControlStep& seen, int i, Termination termination, int* targets_reached) {
  if (seen.progress.steps_within == nullptr) return termination == Termination::kTargetReached;
  const int reached = seen.progress.targets_reached[i] + (seen.progress.reached_step[i] > 0);
  const bool is_new = reached > std::exchange(*targets_reached, reached);
  // The time limit is a mission's end.
  return is_new &&
         (termination == Termination::kNone || termination == Termination::kTargetReached ||
          termination == Termination::kTimeLimit);
}

/// Flies the first episodes of a tile's first `flights.size()` aircraft.
class TileRecorder : private ControlStepObserver {
 public:
  TileRecorder(VecEnv& env, int tile, std::vector<RecordedFlight*> flights)
      : env_(env),
        tile_(tile),
        begin_(env.tile_begin(tile)),
        flights_(std::move(flights)),
        flying_(flights_.size(), true),
        targets_reached_(flights_.size(), 0),
        memory_(env.tile_count(tile)) {
    for (std::size_t i = 0; i < flights_.size(); ++i) {
      const int aircraft = begin_ + static_cast<int>(i);
      flights_[i]->initial_state = StateOf(env_, aircraft);
      flights_[i]->target = env_.TargetOf(aircraft);
    }
  }

  bool IsDone() const { return std::find(flying_.begin(), flying_.end(), true) == flying_.end(); }

  /// One policy step: what the tile's agent observed, and its actions.
  void Step(const std::vector<float>& observation, const std::vector<float>& action) {
    const int size = env_.observation_size();
    for (std::size_t i = 0; i < flights_.size(); ++i) {
      const float* const row = observation.data() + i * size;
      if (flying_[i])
        flights_[i]->observations.insert(flights_[i]->observations.end(), row, row + size);
    }
    action_ = action.data();
    StepOutput output = memory_.output();
    output.observer = this;
    env_.Step(tile_, action.data(), output);
  }

 private:
  void See(const ControlStep& seen) override {
    const int actions = env_.action_size();
    for (int i = 0; i < seen.state.count; ++i) {
      const int index = seen.first_aircraft - begin_ + i;
      if (index >= static_cast<int>(flights_.size()) || !flying_[index]) continue;
      RecordedStep& step = flights_[index]->steps.emplace_back();
      step.termination = static_cast<Termination>(seen.termination[i]);
      flying_[index] = step.termination == Termination::kNone;
      // In still air the wind stays zero.
      const int columns = seen.state.windy ? kNumRecordedColumns : kNumColumns;
      for (int column = 0; column < columns; ++column) step.state[column] = seen.state[column][i];
      for (std::size_t k = 0; k < flights_[index]->target.size(); ++k) {
        step.target.push_back(seen.task[static_cast<int>(k)][i]);
      }
      step.reaches_target = ReachesTarget(seen, i, step.termination, &targets_reached_[index]);
      for (int k = 0; k < actions; ++k) {
        step.action.push_back(Clipped(action_[index * actions + k]));
      }
      for (int k = 0; k < kActionSize; ++k) {
        step.stick[k] = Clipped(seen.action[i * kActionSize + k]);
      }
      if (seen.command.base != nullptr) {
        for (int k = 0; k < kHighLevelActionSize; ++k) step.command.push_back(seen.command[k][i]);
      }
      step.reward = seen.reward[i];
    }
  }

  VecEnv& env_;
  int tile_, begin_;
  std::vector<RecordedFlight*> flights_;
  std::vector<bool> flying_;
  std::vector<int> targets_reached_;
  const float* action_ = nullptr;  // of the policy step under way
  StepMemory memory_;
};

}  // namespace

std::vector<RecordedFlight> RecordFlights(const Agent& agent, const EnvConfig& config,
                                          const EvaluationOptions& options, int count,
                                          WorkerPool& pool) {
  if (count < 1) throw Error("cannot record " + std::to_string(count) + " flights");
  VecEnv env = MakeEvaluationEnv(agent, config, options);
  std::vector<RecordedFlight> flights(std::min(count, options.episodes));
  int tiles = 0;
  while (tiles < env.num_tiles() && env.tile_begin(tiles) < static_cast<int>(flights.size())) {
    ++tiles;
  }
  pool.ForEach(tiles, [&](int tile, int) {
    const int begin = env.tile_begin(tile);
    const int end = std::min(begin + env.tile_count(tile), static_cast<int>(flights.size()));
    std::vector<RecordedFlight*> recorded;
    for (int i = begin; i < end; ++i) recorded.push_back(&flights[i]);
    TileRecorder recorder(env, tile, std::move(recorded));
    TileAgent flying_agent = MakeEvaluationAgent(agent, env, tile, options);
    while (!recorder.IsDone() && !pool.stopping()) {
      // Whole tiles fly, the aircraft that are not recorded too: matrix products may round by
      // shape.
      const std::vector<float>& action = flying_agent.Act();
      recorder.Step(flying_agent.observation(), action);
    }
  });
  return flights;
}

}  // namespace skein
