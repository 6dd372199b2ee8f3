#pragma once

#include <string>
#include <string_view>

namespace skein {

/// A file that only grows. What is appended reaches the system at once, so that a killed process
/// loses nothing; Sync makes it survive a power cut.
class AppendFile {
 public:
  /// Opens or creates. Throws Error (path, reason of the system), as do the others.
  explicit AppendFile(const std::string& path);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  void Append(std::string_view bytes);
  void Sync();
  bool empty() const { return size_ == 0; }

 private:
  std::string path_;
  int descriptor_ = -1;
  long long size_ = 0;
};

}  // namespace skein
