// SPDX-License-Identifier: Apache-2.0
#include "train/files/file_descriptor.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

#include "base/choice_error.h"
#include "base/error.h"
#include "base/file_error.h"

namespace skein {
namespace {

int FlagsOf(OpenMode mode) {
  switch (mode) {
    case OpenMode::kRead:
      return O_RDONLY;
    case OpenMode::kMake:
      return O_WRONLY | O_CREAT | O_NOFOLLOW;
    case OpenMode::kWrite:
      return O_WRONLY;
    case OpenMode::kAppend:
      return O_WRONLY | O_CREAT | O_APPEND;
    case OpenMode::kDirectory:
      break;
  }
  return O_RDONLY | O_DIRECTORY;
}

}  // namespace

std::string SystemReason() { return std::strerror(errno); }

bool LacksLocks() {
  return errno == EOPNOTSUPP || errno == ENOSYS || errno == EINVAL || errno == ENOLCK;
}

FileDescriptor::FileDescriptor(const std::string& path, OpenMode mode, const std::string& name)
    : name_(name.empty() ? path : name),
      value_(open(path.c_str(), FlagsOf(mode) | O_CLOEXEC, 0666)) {
  if (value_ >= 0) return;
  const bool leads_nowhere =
      errno == ENOENT || errno == ENOTDIR || errno == ELOOP || errno == ENAMETOOLONG;
  if (mode == OpenMode::kRead && leads_nowhere) {
    throw ChoiceError(name_ + ": cannot be opened: " + SystemReason());
  }
  Fail("cannot be opened");
}

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept
    : name_(std::move(other.name_)), value_(std::exchange(other.value_, -1)) {}

FileDescriptor::~FileDescriptor() {
  if (value_ >= 0) close(value_);
}

std::uint64_t FileDescriptor::size() const {
  struct stat status {};
  if (fstat(value_, &status) != 0) Fail("cannot be examined");
  return static_cast<std::uint64_t>(status.st_size);
}

void FileDescriptor::Write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(value_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) Fail("cannot be written");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::size_t FileDescriptor::ReadSome(char* bytes, std::size_t size) {
  ssize_t count = -1;
  do {
    count = read(value_, bytes, size);
  } while (count < 0 && errno == EINTR);
  if (count < 0 && errno == EISDIR) throw ChoiceError(name_ + ": is a directory, not a file");
  if (count < 0) Fail("cannot be read");
  return static_cast<std::size_t>(count);
}

void FileDescriptor::ReadExactly(char* bytes, std::size_t size) {
  while (size > 0) {
    const std::size_t count = ReadSome(bytes, size);
    if (count == 0) throw Error(name_ + ": cannot be read: it ends too early");
    bytes += count;
    size -= count;
  }
}

std::string FileDescriptor::ReadToEnd(std::uint64_t largest) {
  std::string text;
  std::array<char, 65536> part;
  for (;;) {
    const std::size_t count = ReadSome(part.data(), part.size());
    if (count == 0) return text;
    if (text.size() + count > largest) {
      throw Error(name_ + ": cannot be read: it has more than " + std::to_string(largest >> 20) +
                  " MiB");
    }
    text.append(part.data(), count);
  }
}

void FileDescriptor::Empty() {
  if (ftruncate(value_, 0) != 0) Fail("cannot be written");
}

void FileDescriptor::Lock() {
  while (flock(value_, LOCK_EX) != 0) {
    if (errno == EINTR) continue;
    if (LacksLocks()) return;
    Fail("cannot be locked");
  }
}

void FileDescriptor::Unlock() { static_cast<void>(flock(value_, LOCK_UN)); }

FileDescriptor FileDescriptor::Copy() const {
  FileDescriptor copy(name_, fcntl(value_, F_DUPFD_CLOEXEC, 0));
  if (copy.value_ < 0) Fail("cannot be opened");
  return copy;
}

void FileDescriptor::Sync() {
  if (fsync(value_) != 0) Fail("cannot be synced");
}

void FileDescriptor::Close() {
  if (close(std::exchange(value_, -1)) != 0) Fail("cannot be closed");
}

void FileDescriptor::Fail(const char* what) const {
  throw FileError(name_ + ": " + what + ": " + SystemReason());
}

namespace {

void SyncNames(const FileDescriptor& directory, const std::string& path) {
  // Some file systems have nothing to sync in a directory, and say so by EINVAL.
  if (fsync(directory.value()) != 0 && errno != EINVAL) {
    throw Error(path + ": cannot be synced: " + SystemReason());
  }
}

/// Gives a file the permissions of the one that it replaces, if there is one, on file systems that
/// have them.
void TakePermissions(const FileDescriptor& file, const std::string& replaced) {
  struct stat old {
  }, own{};
  if (stat(replaced.c_str(), &old) != 0 || fstat(file.value(), &own) != 0) return;
  if (old.st_mode != own.st_mode) static_cast<void>(fchmod(file.value(), old.st_mode & 07777));
}

bool IsAt(const FileDescriptor& file, const std::string& path) {
  struct stat own {
  }, there{};
  return fstat(file.value(), &own) == 0 && stat(path.c_str(), &there) == 0 &&
         own.st_dev == there.st_dev && own.st_ino == there.st_ino;
}

/// The empty file `temporary`, locked. Who had the lock before has renamed or removed that file.
FileDescriptor OwnTemporary(const std::string& temporary, const std::string& name) {
  for (;;) {
    FileDescriptor file(temporary, OpenMode::kMake, name);
    file.Lock();
    if (!IsAt(file, temporary)) continue;
    file.Empty();
    return file;
  }
}

}  // namespace

void ReplaceFile(const std::string& path, const std::function<void(FileDescriptor&)>& write) {
  const std::string temporary = path + kTemporaryExtension;
  const std::string parent = std::filesystem::path(path).parent_path().string();
  const std::string folder = parent.empty() ? "." : parent;
  std::optional<FileDescriptor> directory, lock;
  FileDescriptor file = OwnTemporary(temporary, path);
  try {
    lock.emplace(file.Copy());  // until the file is in its place, for which it is closed
    TakePermissions(file, path);
    directory.emplace(folder, OpenMode::kDirectory);
    write(file);
    file.Sync();
    file.Close();
    if (std::rename(temporary.c_str(), path.c_str()) != 0) {
      throw Error(path + ": cannot be replaced: " + SystemReason());
    }
  } catch (...) {
    unlink(temporary.c_str());
    throw;
  }
  lock->Unlock();
  SyncNames(*directory, folder);
}

void TryReplacing(const std::string& path) {
  const std::string temporary = path + kTemporaryExtension;
  const FileDescriptor locked = OwnTemporary(temporary, path);
  if (unlink(temporary.c_str()) != 0) {
    throw FileError(temporary + ": cannot be removed: " + SystemReason());
  }
}

void SyncDirectory(const std::string& path) {
  SyncNames(FileDescriptor(path, OpenMode::kDirectory), path);
}

}  // namespace skein
