// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace skein {

enum class OpenMode {
  kRead,       ///< must exist
  kMake,       ///< made if absent, as it is if not; no symbolic link
  kWrite,      ///< must exist; as it is, for devices and pipes
  kAppend,     ///< made if absent; every write goes to the end
  kDirectory,  ///< to sync it
};

/// An open file that closes itself. Every function throws Error (its name, what failed, the
/// system's reason). Writes reach the system at once, so that a killed process loses nothing.
class FileDescriptor {
 public:
  /// `name`: what errors call the file, if not by its path.
  FileDescriptor(const std::string& path, OpenMode mode, const std::string& name = "");
  FileDescriptor(FileDescriptor&& other) noexcept;
  ~FileDescriptor();
  FileDescriptor& operator=(FileDescriptor&&) = delete;

  int value() const { return value_; }
  std::uint64_t size() const;  ///< bytes

  /// All of `bytes`.
  void Write(std::string_view bytes);
  /// Exactly `size` bytes; a file that ends before is an Error.
  void ReadExactly(char* bytes, std::size_t size);
  /// Everything up to the end; more than `largest` bytes are an Error.
  std::string ReadToEnd(std::uint64_t largest);
  /// Drops all bytes.
  void Empty();
  /// Waits until nobody else has the lock of the file. Does nothing where there are no locks
  /// (LacksLocks).
  void Lock();
  /// Gives the lock of the file and its copies back; so does closing them all, in all processes.
  void Unlock();
  /// Another descriptor of the open file, with its lock.
  FileDescriptor Copy() const;
  /// Waits until what was written survives a power cut.
  void Sync();
  /// Some file systems report a failed write only here.
  void Close();

 private:
  FileDescriptor(std::string name, int value) : name_(std::move(name)), value_(value) {}
  std::size_t ReadSome(char* bytes, std::size_t size);
  [[noreturn]] void Fail(const char* what) const;

  std::string name_;
  int value_ = -1;
};

/// What ReplaceFile appends to a file's name for its temporary file. It overwrites one that is
/// there, so it is nothing that a user would choose.
inline constexpr char kTemporaryExtension[] = ".skein-tmp";

/// Replaces the file `path` by what `write` writes: temporary file beside it, fsync, rename, fsync
/// of the directory. It has the permissions of the file that it replaces. Of two that replace a
/// file at once, processes or threads, one waits for the other. Throws Error, as `write` may; an
/// existing file is then untouched, unless it was the directory that could not be synced.
void ReplaceFile(const std::string& path, const std::function<void(FileDescriptor&)>& write);

/// Makes ReplaceFile's temporary file and removes it, as rights alone do not say whether that is
/// possible (a file system that is read-only or makes no files, a name that is too long). Throws
/// FileError, whose reason is that of errno, if it is not.
void TryReplacing(const std::string& path);

/// Makes the names in a directory survive a power cut.
void SyncDirectory(const std::string& path);

/// "No space left on device" and the like for the current errno.
std::string SystemReason();

/// Whether the current errno, of flock, says that a file system has no locks, or none left.
bool LacksLocks();

}  // namespace skein
