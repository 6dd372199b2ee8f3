#pragma once

#include <string>

#include "src/append_file.h"
#include "src/progress.h"

namespace skein {

/// What a run says: to log.txt with the time, and to the standard output.
class RunLog {
 public:
  explicit RunLog(const std::string& path) : file_(path) {}

  /// To both.
  void Say(const std::string& line);
  /// To the file alone.
  void Note(const std::string& line);
  /// To the output alone, replacing the last such line on a terminal.
  void Show(const std::string& line) { display_.Update(line); }
  void Sync() { file_.Sync(); }

 private:
  AppendFile file_;
  ProgressDisplay display_;
};

}  // namespace skein
