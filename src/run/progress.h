// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "envs/tasks/termination.h"
#include "train/ppo/trainer.h"

namespace skein {

/// With spaces and long units, or as short as can be.
enum class Spacing { kWide, kTight };

/// "1.35 G", "12.3 M", "999"; tight "1.35G".
std::string FormatCount(double count, Spacing spacing = Spacing::kWide);
/// "47 s", "12 min 05 s", "3 h 07 min", "2 d 04 h"; tight "12m05s".
std::string FormatDuration(double seconds, Spacing spacing = Spacing::kWide);

/// What the progress line shows.
struct Progress {
  std::uint64_t env_steps = 0, total_steps = 0;
  double steps_per_s = 0;  ///< 0: not known yet
  double rollout_share = 0, update_share = 0;
  double return_mean = 0, success_rate = 0;  ///< NaN: no episode has ended yet
  std::uint64_t success_episodes = 0;        ///< that success_rate is of
  bool flies_missions = false;               ///< success_rate is of flights flown to the end
  bool evaluates_missions = false;           ///< the same of evaluation_success_rate
  double evaluation_success_rate = -1;       ///< latest; negative: none yet
  double best_evaluation = -1;               ///< of those this process has seen
  std::uint64_t iteration = 0;               ///< of the run
  double elapsed_s = 0;                      ///< of this process
  /// By Termination: shares of the episodes that ended lately; all 0 if none did.
  std::array<double, kNumTerminations> end_shares{};
  std::vector<double> success_history;  ///< by iteration; NaN where no episode ended
};

/// NaN if it is not known yet.
double SecondsLeft(const Progress& progress);

/// " of 3" if success_rate is of so few episodes that it says little; else nothing.
std::string OfHowMany(const Progress& progress);

/// "evaluated", and of what if training's success is of something else.
std::string EvaluatedWords(const Progress& progress);

/// One line: steps and budget, steps per second, shares of time, mean return, success, time left.
/// The tight one fits 72 columns and leaves shares and evaluation out.
std::string FormatProgress(const Progress& progress, Spacing spacing = Spacing::kWide);

/// Collects iteration reports into a Progress: rates over the last iterations that took about half
/// a minute, the latest values that exist of the others.
class ProgressMeter {
 public:
  using Clock = std::chrono::steady_clock;

  /// `env_steps`: where this process begins (above 0 when resumed); `env`: what is trained on.
  ProgressMeter(std::uint64_t env_steps, std::uint64_t total_steps, const EnvConfig& env,
                Clock::time_point start);

  void Add(const IterationReport& report, Clock::time_point now);
  const Progress& progress() const { return progress_; }

 private:
  struct Sample {
    Clock::time_point time;
    std::uint64_t env_steps = 0;
    double rollout_s = 0, update_s = 0;
    std::array<int, kNumTerminations> terminations{};  ///< since the start
  };
  void CountEnds();

  Clock::time_point start_;
  std::deque<Sample> samples_;
  Progress progress_;
};

}  // namespace skein
