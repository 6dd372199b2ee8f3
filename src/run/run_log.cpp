// SPDX-License-Identifier: Apache-2.0
#include "src/run/run_log.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <sstream>

namespace skein {

void RunLog::Say(const std::string& text) { Say(text, text); }

void RunLog::Say(const std::string& text, const std::string& in_short) {
  display_.Print(display_.is_terminal() ? in_short : text);
  NoteBrokenOutput();
  Note(text);
}

void RunLog::Show(const Progress& progress) {
  display_.Update(progress);
  NoteBrokenOutput();
}

void RunLog::NoteBrokenOutput() {
  const std::string reason = display_.TakeFailure();
  if (!reason.empty()) {
    Note("warning: the standard output broke: " + reason +
         "; the run continues, recorded only here");
  }
}

void RunLog::Note(const std::string& text) {
  const std::string time = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    file_.Write(fmt::format("{} {}\n", time, line));
  }
}

}  // namespace skein
