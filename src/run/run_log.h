// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "src/run/progress_display.h"
#include "train/files/file_descriptor.h"

namespace skein {

/// What a run says: to log.txt with the time, and to the standard output, which may break (and that
/// is noted) without ending the run. Throws Error if the file cannot be written.
class RunLog {
 public:
  /// One that does not print writes to the file alone.
  RunLog(const std::string& path, bool prints) : file_(path, OpenMode::kAppend), display_(prints) {}

  /// To both; `text` may have several lines.
  void Say(const std::string& text);
  /// The same, but to a terminal `in_short`.
  void Say(const std::string& text, const std::string& in_short);
  /// To the file alone.
  void Note(const std::string& text);
  /// To the output alone, replacing what was last shown on a terminal.
  void Show(const Progress& progress);
  void Sync() { file_.Sync(); }

 private:
  void NoteBrokenOutput();

  FileDescriptor file_;
  ProgressDisplay display_;
};

}  // namespace skein
