// SPDX-License-Identifier: Apache-2.0
#include "src/run/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein {
namespace {

double Seconds(ProgressMeter::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

std::string Percent(double fraction, Spacing spacing, int digits) {
  if (!std::isfinite(fraction)) return "-";
  return fmt::format("{:.{}f}{}%", 100 * fraction, digits, spacing == Spacing::kWide ? " " : "");
}

}  // namespace

std::string FormatCount(double count, Spacing spacing) {
  constexpr const char* kPrefixes[] = {"", "k", "M", "G", "T"};
  int prefix = 0;
  // 999.5 would print as 1000 with three digits.
  while (count >= 999.5 && prefix < 4) {
    count /= 1000;
    ++prefix;
  }
  if (prefix == 0) return fmt::format("{:.0f}", count);
  return fmt::format("{:.{}f}{}{}", count,
                     count < 9.995   ? 2
                     : count < 99.95 ? 1
                                     : 0,
                     spacing == Spacing::kWide ? " " : "", kPrefixes[prefix]);
}

std::string FormatDuration(double seconds, Spacing spacing) {
  if (!std::isfinite(seconds) || seconds < 0) return "-";
  const long long s = std::llround(seconds);
  const bool wide = spacing == Spacing::kWide;
  if (s < 60) return fmt::format(wide ? "{} s" : "{}s", s);
  if (s < 3600) return fmt::format(wide ? "{} min {:02} s" : "{}m{:02}s", s / 60, s % 60);
  if (s < 86400) return fmt::format(wide ? "{} h {:02} min" : "{}h{:02}m", s / 3600, s / 60 % 60);
  return fmt::format(wide ? "{} d {:02} h" : "{}d{:02}h", s / 86400, s / 3600 % 24);
}

double SecondsLeft(const Progress& p) {
  if (!(p.steps_per_s > 0)) return std::numeric_limits<double>::quiet_NaN();
  const std::uint64_t left = p.total_steps - std::min(p.env_steps, p.total_steps);
  return static_cast<double>(left) / p.steps_per_s;
}

std::string OfHowMany(const Progress& p) {
  constexpr std::uint64_t kEnough = 50;  // a rate of one half is known to 14 % by then
  const bool is_few = p.success_episodes > 0 && p.success_episodes < kEnough;
  return is_few ? fmt::format(" of {}", p.success_episodes) : "";
}

std::string EvaluatedWords(const Progress& p) {
  const bool is_of_other = p.flies_missions && !p.evaluates_missions;
  return is_of_other ? "evaluated success" : "evaluated";
}

std::string FormatProgress(const Progress& p, Spacing spacing) {
  const double done = static_cast<double>(p.env_steps), total = static_cast<double>(p.total_steps);
  const bool known = p.steps_per_s > 0;
  const std::string steps =
      fmt::format("{}/{}", FormatCount(done, spacing), FormatCount(total, spacing));
  const std::string rate = known ? FormatCount(p.steps_per_s, spacing) : "-";
  const std::string left = FormatDuration(SecondsLeft(p), spacing);
  const std::string rollout = Percent(p.rollout_share, spacing, 0);
  const std::string update = Percent(p.update_share, spacing, 0);
  const std::string mean_return =
      std::isfinite(p.return_mean) ? fmt::format("{:.1f}", p.return_mean) : "-";
  const std::string success = fmt::format("{} {}", p.flies_missions ? "to the end" : "success",
                                          Percent(p.success_rate, spacing, 1) + OfHowMany(p));
  if (spacing == Spacing::kTight) {
    return fmt::format("{} {}/s return {} {} left {}", steps, rate, mean_return, success, left);
  }
  return fmt::format(
      "{} steps ({}) | {} steps/s | rollout {} update {} | return {} | {}{} | left {}", steps,
      Percent(done / total, spacing, 1), rate, rollout, update, mean_return, success,
      p.evaluation_success_rate < 0 ? ""
                                    : fmt::format(" ({} {})", EvaluatedWords(p),
                                                  Percent(p.evaluation_success_rate, spacing, 1)),
      left);
}

ProgressMeter::ProgressMeter(std::uint64_t env_steps, std::uint64_t total_steps,
                             const EnvConfig& env, Clock::time_point start)
    : start_(start) {
  progress_.env_steps = env_steps;
  progress_.flies_missions = env.mission.enabled();
  progress_.evaluates_missions = EvaluationConfig(env).mission.enabled();
  progress_.total_steps = total_steps;
  progress_.return_mean = progress_.success_rate = std::nan("");
  samples_.push_back({start, env_steps, 0, 0, {}});
}

void ProgressMeter::Add(const IterationReport& report, Clock::time_point now) {
  constexpr double kWindowSeconds = 30;
  const Sample& newest = samples_.back();
  samples_.push_back({now, report.env_steps, newest.rollout_s + report.rollout_seconds,
                      newest.update_s + report.update_seconds, newest.terminations});
  for (std::size_t kind = 0; kind < kNumTerminations; ++kind) {
    samples_.back().terminations[kind] += report.terminations[kind];
  }
  while (samples_.size() > 2 && Seconds(now - samples_[1].time) >= kWindowSeconds) {
    samples_.pop_front();
  }
  const Sample& first = samples_.front();
  const Sample& last = samples_.back();
  progress_.env_steps = report.env_steps;
  progress_.iteration = report.iteration;
  progress_.elapsed_s = Seconds(now - start_);
  progress_.success_history.push_back(report.success_rate);
  CountEnds();
  if (const double seconds = Seconds(now - first.time); seconds > 0) {
    progress_.steps_per_s = static_cast<double>(last.env_steps - first.env_steps) / seconds;
    progress_.rollout_share = (last.rollout_s - first.rollout_s) / seconds;
    progress_.update_share = (last.update_s - first.update_s) / seconds;
  }
  if (std::isfinite(report.return_mean)) progress_.return_mean = report.return_mean;
  if (std::isfinite(report.success_rate)) {
    progress_.success_rate = report.success_rate;
    progress_.success_episodes = report.episodes;
  }
  if (report.evaluation_success_rate >= 0) {
    progress_.evaluation_success_rate = report.evaluation_success_rate;
    progress_.best_evaluation = std::max(progress_.best_evaluation, report.evaluation_success_rate);
  }
}

void ProgressMeter::CountEnds() {
  const auto& last = samples_.back().terminations;
  const auto& first = samples_.front().terminations;
  std::array<int, kNumTerminations> ends{};
  int episodes = 0;
  for (std::size_t kind = 0; kind < kNumTerminations; ++kind) {
    ends[kind] = last[kind] - first[kind];
    episodes += ends[kind];
  }
  if (episodes == 0) return;  // what was known stays
  for (std::size_t kind = 0; kind < kNumTerminations; ++kind) {
    progress_.end_shares[kind] = static_cast<double>(ends[kind]) / episodes;
  }
}

}  // namespace skein
