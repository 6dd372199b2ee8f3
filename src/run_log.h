#pragma once

#include <string>

#include "src/append_file.h"
#include "src/progress.h"

namespace skein {

/// What a run says: to log.txt with the time, and to the standard output.
class RunLog {
 public:
  explicit RunLog(const std::string& path) : file_(path) {}

  /// To both; `text` may have several lines.
  void Say(const std::string& text);
  /// To the file alone.
  void Note(const std::string& text);
  /// To the output alone, replacing what was last shown on a terminal.
  void Show(const Progress& progress) { display_.Update(progress); }
  void Sync() { file_.Sync(); }

 private:
  AppendFile file_;
  ProgressDisplay display_;
};

}  // namespace skein
