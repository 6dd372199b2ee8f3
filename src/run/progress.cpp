// SPDX-License-Identifier: Apache-2.0
#include "src/run/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "train/files/file_descriptor.h"

namespace skein {
namespace {

std::size_t TerminalWidth() {
  winsize size{};
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// The variable's value; empty if there is none.
std::string Environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

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

std::string FormatProgress(const Progress& p, Spacing spacing) {
  const double done = static_cast<double>(p.env_steps), total = static_cast<double>(p.total_steps);
  const bool known = p.steps_per_s > 0;
  const std::string steps =
      fmt::format("{}/{}", FormatCount(done, spacing), FormatCount(total, spacing));
  const std::string rate = known ? FormatCount(p.steps_per_s, spacing) : "-";
  const std::string left =
      known ? FormatDuration(std::max(0.0, total - done) / p.steps_per_s, spacing) : "-";
  const std::string rollout = Percent(p.rollout_share, spacing, 0);
  const std::string update = Percent(p.update_share, spacing, 0);
  const std::string mean_return =
      std::isfinite(p.return_mean) ? fmt::format("{:.1f}", p.return_mean) : "-";
  const std::string success = Percent(p.success_rate, spacing, 1);
  if (spacing == Spacing::kTight) {
    return fmt::format("{} {}/s return {} success {} left {}", steps, rate, mean_return, success,
                       left);
  }
  return fmt::format(
      "{} steps ({}) | {} steps/s | rollout {} update {} | return {} | success {}{} | left {}",
      steps, Percent(done / total, spacing, 1), rate, rollout, update, mean_return, success,
      p.evaluation_success_rate < 0
          ? ""
          : fmt::format(" (evaluated {})", Percent(p.evaluation_success_rate, spacing, 1)),
      left);
}

std::string FormatProgressBar(const Progress& progress, std::size_t width, bool colour) {
  constexpr std::size_t kShortestBar = 8, kLongestBar = 32, kFrame = 3;  // brackets and a space
  constexpr const char* kGreen = "\x1b[32m";
  constexpr const char* kPlain = "\x1b[0m";
  const std::string line = FormatProgress(progress, Spacing::kTight);
  if (width < line.size() + kFrame + kShortestBar) return line.substr(0, width);
  const std::size_t bar = std::min(width - line.size() - kFrame, kLongestBar);
  const double done = progress.total_steps == 0 ? 0
                                                : static_cast<double>(progress.env_steps) /
                                                      static_cast<double>(progress.total_steps);
  const auto filled =
      static_cast<std::size_t>(std::clamp(done, 0.0, 1.0) * static_cast<double>(bar));
  return fmt::format("[{}{}{}{}] {}", colour ? kGreen : "", std::string(filled, '='),
                     colour ? kPlain : "", std::string(bar - filled, ' '), line);
}

ProgressMeter::ProgressMeter(std::uint64_t env_steps, std::uint64_t total_steps,
                             Clock::time_point start) {
  progress_.env_steps = env_steps;
  progress_.total_steps = total_steps;
  progress_.return_mean = progress_.success_rate = std::nan("");
  samples_.push_back({start, env_steps, 0, 0});
}

void ProgressMeter::Add(const IterationReport& report, Clock::time_point now) {
  constexpr double kWindowSeconds = 30;
  const Sample& newest = samples_.back();
  samples_.push_back({now, report.env_steps, newest.rollout_s + report.rollout_seconds,
                      newest.update_s + report.update_seconds});
  while (samples_.size() > 2 && Seconds(now - samples_[1].time) >= kWindowSeconds) {
    samples_.pop_front();
  }
  const Sample& first = samples_.front();
  const Sample& last = samples_.back();
  progress_.env_steps = report.env_steps;
  if (const double seconds = Seconds(now - first.time); seconds > 0) {
    progress_.steps_per_s = static_cast<double>(last.env_steps - first.env_steps) / seconds;
    progress_.rollout_share = (last.rollout_s - first.rollout_s) / seconds;
    progress_.update_share = (last.update_s - first.update_s) / seconds;
  }
  if (std::isfinite(report.return_mean)) progress_.return_mean = report.return_mean;
  if (std::isfinite(report.success_rate)) progress_.success_rate = report.success_rate;
  if (report.evaluation_success_rate >= 0) {
    progress_.evaluation_success_rate = report.evaluation_success_rate;
  }
}

ProgressDisplay::ProgressDisplay()
    : terminal_(isatty(STDOUT_FILENO) == 1 && Environment("TERM") != "dumb"),
      colour_(terminal_ && Environment("NO_COLOR").empty()) {}

void ProgressDisplay::Update(const Progress& progress) {
  constexpr double kTerminalInterval = 0.2, kPlainInterval = 10;
  const auto now = ProgressMeter::Clock::now();
  if (shown_ && Seconds(now - last_) < (terminal_ ? kTerminalInterval : kPlainInterval)) return;
  shown_ = true;
  last_ = now;
  if (terminal_) {
    Write(fmt::format("\r{}\x1b[K", FormatProgressBar(progress, TerminalWidth() - 1, colour_)));
    line_open_ = true;
  } else {
    Write(FormatProgress(progress, Spacing::kTight) + "\n");
  }
}

void ProgressDisplay::Print(const std::string& line) {
  Write(fmt::format("{}{}\n", line_open_ ? "\r\x1b[K" : "", line));
  line_open_ = false;
}

void ProgressDisplay::Write(const std::string& text) {
  if (silent_) return;
  if (std::fputs(text.c_str(), stdout) != EOF && std::fflush(stdout) == 0) return;
  failure_ = SystemReason();
  silent_ = true;
  // Also drops what the stream still holds, which would fail again when the program ends.
  static_cast<void>(std::freopen("/dev/null", "w", stdout));
}

}  // namespace skein
