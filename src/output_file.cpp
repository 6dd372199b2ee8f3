#include "src/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "simd/error.h"

namespace skein {
namespace {

/// Writes, syncs and closes; false with errno set on the first failure.
bool WriteAndSync(int descriptor, const std::string& text, bool sync) {
  std::size_t done = 0;
  bool good = true;
  while (good && done < text.size()) {
    const ssize_t written = write(descriptor, text.data() + done, text.size() - done);
    if (written > 0) {
      done += static_cast<std::size_t>(written);
    } else if (errno != EINTR) {
      good = false;
    }
  }
  good = good && (!sync || fsync(descriptor) == 0);
  const int reason = errno;
  const bool closed = close(descriptor) == 0;
  if (!good) errno = reason;
  return good && closed;
}

[[noreturn]] void Fail(const std::string& path) {
  throw Error(fmt::format("{}: cannot be written: {}", path, SystemReason()));
}

}  // namespace

std::string SystemReason() { return std::strerror(errno); }

void WriteFile(const std::string& path, const std::string& text) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0 || !WriteAndSync(descriptor, text, false)) Fail(path);
    return;
  }
  const std::string temporary = fmt::format("{}.{}.tmp", path, getpid());
  const int descriptor = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) Fail(path);
  if (!WriteAndSync(descriptor, text, true) || std::rename(temporary.c_str(), path.c_str()) != 0) {
    const int reason = errno;
    unlink(temporary.c_str());
    errno = reason;
    Fail(path);
  }
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const int directory =
      open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0 || fsync(directory) != 0) Fail(path);
  close(directory);
}

std::string ReadFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  // An empty file sets failbit on `text`, so only the file's own state is asked.
  if (!file.is_open() || file.bad() || std::filesystem::is_directory(path)) {
    throw Error(fmt::format("{}: cannot be read: {}", path, SystemReason()));
  }
  return text.str();
}

}  // namespace skein
