// SPDX-License-Identifier: Apache-2.0
#include "src/run/live_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace skein {
namespace {

constexpr const char* kPlain = "\x1b[0m";
constexpr const char* kDim = "\x1b[2m";
constexpr const char* kGreen = "\x1b[32m";
constexpr const char* kCyan = "\x1b[36m";

constexpr std::array<const char*, 8> kBlocks = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr std::array<const char*, 8> kAscii = {"_", ".", ":", "-", "=", "+", "*", "#"};

/// A line that grows while it fits.
class Line {
 public:
  Line(const std::string& label, const TerminalStyle& style) : style_(style) {
    constexpr std::size_t kLabelWidth = 9;
    Append(fmt::format("{:{}}", label, kLabelWidth).substr(0, style.width), kDim,
           std::min(kLabelWidth, style.width));
  }

  /// Columns that the next part may fill.
  std::size_t Room() const {
    const std::size_t gap = is_empty_ ? 0 : kGap;
    return style_.width > columns_ + gap ? style_.width - columns_ - gap : 0;
  }

  /// Nothing, and no part after it, if it does not fit.
  void Add(const std::string& part, const char* colour = "") { AddWide(part, part.size(), colour); }
  /// Of `columns` characters, which may have several bytes.
  void AddWide(const std::string& part, std::size_t columns, const char* colour) {
    is_full_ = is_full_ || columns > Room();
    if (is_full_) return;
    if (!is_empty_) Append(std::string(kGap, ' '), "", kGap);
    Append(part, colour, columns);
    is_empty_ = false;
  }

  const std::string& text() const { return text_; }

 private:
  static constexpr std::size_t kGap = 2;

  void Append(const std::string& part, const std::string& colour, std::size_t columns) {
    const bool coloured = style_.colour && !colour.empty();
    text_ += coloured ? colour + part + kPlain : part;
    columns_ += columns;
  }

  const TerminalStyle& style_;
  std::string text_;
  std::size_t columns_ = 0;
  bool is_empty_ = true, is_full_ = false;
};

std::string Percent(double share, int decimals) {
  return std::isfinite(share) ? fmt::format("{:.{}f} %", 100 * share, decimals) : "-";
}

double DoneShare(const Progress& p) {
  if (p.total_steps == 0) return 0;
  return std::clamp(static_cast<double>(p.env_steps) / static_cast<double>(p.total_steps), 0.0,
                    1.0);
}

std::string BarLine(const Progress& p, const TerminalStyle& style) {
  constexpr std::size_t kLongestBar = 40, kShortestBar = 8, kBrackets = 2, kGap = 2;
  Line line("training", style);
  const std::string done = fmt::format("{:5.1f} %", 100 * DoneShare(p));
  const std::string left = "left " + FormatDuration(SecondsLeft(p));
  const std::size_t texts = done.size() + left.size() + 2 * kGap + kBrackets;
  if (line.Room() >= texts + kShortestBar) {
    const std::size_t width = std::min(line.Room() - texts, kLongestBar);
    const auto filled = static_cast<std::size_t>(DoneShare(p) * static_cast<double>(width));
    const std::string full(filled, '='), empty(width - filled, ' ');
    line.AddWide(style.colour ? fmt::format("[{}{}{}{}]", kGreen, full, kPlain, empty)
                              : fmt::format("[{}{}]", full, empty),
                 width + kBrackets, "");
  }
  line.Add(done);
  line.Add(left);
  return line.text();
}

std::string StepsLine(const Progress& p, const TerminalStyle& style) {
  Line line("steps", style);
  line.Add(fmt::format("{} of {}", FormatCount(static_cast<double>(p.env_steps)),
                       FormatCount(static_cast<double>(p.total_steps))));
  line.Add(p.steps_per_s > 0 ? FormatCount(p.steps_per_s) + "/s" : "-/s");
  line.Add(fmt::format("iteration {}", p.iteration));
  line.Add(FormatDuration(p.elapsed_s) + " so far");
  return line.text();
}

std::string TimeLine(const Progress& p, const TerminalStyle& style) {
  Line line("time", style);
  if (!(p.steps_per_s > 0)) {
    line.Add("-");
    return line.text();
  }
  line.Add("rollout " + Percent(p.rollout_share, 0));
  line.Add("update " + Percent(p.update_share, 0));
  line.Add("other " + Percent(std::max(0.0, 1 - p.rollout_share - p.update_share), 0));
  return line.text();
}

std::string SuccessLine(const Progress& p, const TerminalStyle& style) {
  constexpr std::size_t kLongestSparkline = 40;
  Line line(p.flies_missions ? "to end" : "success", style);
  line.Add(Percent(p.success_rate, 1) + OfHowMany(p));
  std::string evaluated;
  if (p.evaluation_success_rate >= 0) {
    evaluated = fmt::format("{} {}, best {}", EvaluatedWords(p),
                            Percent(p.evaluation_success_rate, 1), Percent(p.best_evaluation, 1));
  }
  const std::size_t kept = evaluated.empty() ? 0 : evaluated.size() + 2;
  const std::size_t room = line.Room() > kept ? line.Room() - kept : line.Room();
  const std::size_t columns = std::min({room, kLongestSparkline, p.success_history.size()});
  if (columns > 1) {
    line.AddWide(Sparkline(p.success_history, columns, style.unicode), columns, kCyan);
  }
  if (!evaluated.empty()) line.Add(evaluated);
  return line.text();
}

std::string ReturnLine(const Progress& p, const TerminalStyle& style) {
  Line line("return", style);
  line.Add(std::isfinite(p.return_mean) ? fmt::format("{:.1f}", p.return_mean) : "-");
  return line.text();
}

std::string EndsLine(const Progress& p, const TerminalStyle& style) {
  Line line("ends", style);
  std::array<std::size_t, kNumTerminations> kinds{};
  std::iota(kinds.begin(), kinds.end(), std::size_t{0});
  std::stable_sort(kinds.begin(), kinds.end(),
                   [&](std::size_t a, std::size_t b) { return p.end_shares[a] > p.end_shares[b]; });
  for (const std::size_t kind : kinds) {
    if (p.end_shares[kind] > 0) {
      line.Add(fmt::format("{} {}", kTerminationNames[kind], Percent(p.end_shares[kind], 0)));
    }
  }
  return line.text();
}

}  // namespace

std::string Sparkline(const std::vector<double>& shares, std::size_t columns, bool unicode) {
  const auto& levels = unicode ? kBlocks : kAscii;
  columns = std::min(columns, shares.size());
  std::string text;
  for (std::size_t column = 0; column < columns; ++column) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = column * shares.size() / columns;
         i < (column + 1) * shares.size() / columns; ++i) {
      if (!std::isfinite(shares[i])) continue;
      sum += shares[i];
      ++count;
    }
    const double level = std::clamp(sum / std::max(count, 1), 0.0, 1.0) * (levels.size() - 1);
    text += count == 0 ? " " : levels[static_cast<std::size_t>(std::lround(level))];
  }
  return text;
}

std::vector<std::string> LiveView(const Progress& progress, const TerminalStyle& style) {
  return {BarLine(progress, style),     StepsLine(progress, style),  TimeLine(progress, style),
          SuccessLine(progress, style), ReturnLine(progress, style), EndsLine(progress, style)};
}

}  // namespace skein
