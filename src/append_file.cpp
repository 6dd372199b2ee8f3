#include "src/append_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>

#include "simd/error.h"
#include "src/output_file.h"

namespace skein {

AppendFile::AppendFile(const std::string& path) : path_(path) {
  descriptor_ = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    throw Error(fmt::format("{}: cannot be opened: {}", path_, SystemReason()));
  }
  size_ = lseek(descriptor_, 0, SEEK_END);
}

AppendFile::~AppendFile() { close(descriptor_); }

void AppendFile::Append(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      throw Error(fmt::format("{}: cannot be written: {}", path_, SystemReason()));
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
    size_ += written;
  }
}

void AppendFile::Sync() {
  if (fsync(descriptor_) != 0) {
    throw Error(fmt::format("{}: cannot be synced: {}", path_, SystemReason()));
  }
}

}  // namespace skein
