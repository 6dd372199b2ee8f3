#include "train/record_flights.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "envs/vec_env.h"
#include "simd/error.h"
#include "train/tile_pilot.h"

namespace skein {
namespace {

std::array<float, kNumRecordedColumns> StateOf(const VecEnv& env, int aircraft) {
  std::array<float, kNumRecordedColumns> state;
  for (int column = 0; column < kNumRecordedColumns; ++column) {
    state[column] = env.StateOf(aircraft, column);
  }
  return state;
}

/// Flies the first episodes of a tile's first `flights.size()` aircraft.
class TileRecorder {
 public:
  TileRecorder(VecEnv& env, int tile, std::vector<RecordedFlight*> flights)
      : env_(env),
        tile_(tile),
        begin_(env.tile_begin(tile)),
        flights_(std::move(flights)),
        flying_(flights_.size(), true),
        reward_(env.tile_count(tile)),
        episode_return_(reward_.size()),
        final_observation_(reward_.size() * env.observation_size()),
        final_state_(reward_.size() * kNumRecordedColumns),
        termination_(reward_.size()),
        steps_(reward_.size()) {
    for (std::size_t i = 0; i < flights_.size(); ++i) {
      const int aircraft = begin_ + static_cast<int>(i);
      flights_[i]->initial_state = StateOf(env_, aircraft);
      flights_[i]->target = env_.TargetOf(aircraft);
    }
  }

  bool IsDone() const { return std::find(flying_.begin(), flying_.end(), true) == flying_.end(); }

  /// One control step with the tile's actions.
  void Step(const std::vector<float>& action) {
    env_.Step(tile_, action.data(),
              {reward_.data(), termination_.data(), episode_return_.data(), steps_.data(),
               final_observation_.data(), final_state_.data()});
    const int actions = env_.action_size();
    for (std::size_t i = 0; i < flights_.size(); ++i) {
      if (!flying_[i]) continue;
      RecordedStep& step = flights_[i]->steps.emplace_back();
      step.termination = static_cast<Termination>(termination_[i]);
      flying_[i] = step.termination == Termination::kNone;
      if (flying_[i]) {
        step.state = StateOf(env_, begin_ + static_cast<int>(i));
      } else {
        std::copy_n(final_state_.begin() + static_cast<std::int64_t>(i) * kNumRecordedColumns,
                    kNumRecordedColumns, step.state.begin());
      }
      for (int k = 0; k < actions; ++k) {
        step.action.push_back(std::clamp(action[i * actions + k], -1.0f, 1.0f));
      }
      step.reward = reward_[i];
    }
  }

 private:
  VecEnv& env_;
  int tile_, begin_;
  std::vector<RecordedFlight*> flights_;
  std::vector<bool> flying_;
  std::vector<float> reward_, episode_return_, final_observation_, final_state_;
  std::vector<std::uint8_t> termination_;
  std::vector<std::int32_t> steps_;
};

}  // namespace

std::vector<RecordedFlight> RecordFlights(const Policy& policy, const EnvConfig& config,
                                          const EvaluationOptions& options, int count,
                                          WorkerPool& pool) {
  if (count < 1) throw Error("cannot record " + std::to_string(count) + " flights");
  // Nothing but rewards depends on where decisions end, so steps can be taken one by one.
  EnvConfig every_step = config;
  every_step.action_repeat = 1;
  VecEnv env = MakeEvaluationEnv(policy, every_step, options);
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
    TilePilot pilot = MakeEvaluationPilot(policy, env, tile, options);
    while (!recorder.IsDone()) {
      // Whole tiles fly, the aircraft that are not recorded too: matrix products may round by
      // shape.
      const std::vector<float>& action = pilot.Decide();
      for (int step = 0; step < config.action_repeat && !recorder.IsDone(); ++step) {
        recorder.Step(action);
      }
    }
  });
  return flights;
}

}  // namespace skein
