#include "src/run_log.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

namespace skein {

void RunLog::Say(const std::string& line) {
  display_.Print(line);
  Note(line);
}

void RunLog::Note(const std::string& line) {
  file_.Append(fmt::format("{:%Y-%m-%dT%H:%M:%SZ} {}\n", fmt::gmtime(std::time(nullptr)), line));
}

}  // namespace skein
