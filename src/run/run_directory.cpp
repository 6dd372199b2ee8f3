// SPDX-License-Identifier: Apache-2.0
#include "src/run/run_directory.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <ctime>
#include <exception>
#include <filesystem>
#include <utility>

#include "base/choice_error.h"
#include "base/ends_with.h"
#include "base/error.h"
#include "src/config/configuration.h"
#include "src/files/shell_text.h"
#include "src/run/require_run.h"
#include "train/files/file_descriptor.h"

namespace skein {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCheckpointPrefix = "checkpoint-";
constexpr const char* kExtension = ".skein";

/// `path` without slashes at its end, which would double in the names of files below it.
std::string WithoutTrailingSlashes(const std::string& path) {
  const auto last = path.find_last_not_of('/');
  return last == std::string::npos ? path : path.substr(0, last + 1);
}

std::optional<std::uint64_t> IterationOf(const std::string& name) {
  const std::string prefix = kCheckpointPrefix, extension = kExtension;
  if (name.size() <= prefix.size() + extension.size() ||
      name.compare(0, prefix.size(), prefix) != 0 || !EndsWith(name, extension)) {
    return std::nullopt;
  }
  std::uint64_t iteration = 0;
  const char* end = name.data() + name.size() - extension.size();
  const auto [stop, failure] = std::from_chars(name.data() + prefix.size(), end, iteration);
  if (failure != std::errc() || stop != end) return std::nullopt;
  return iteration;
}

/// The latest change of a run's files, as a sortable time.
fs::file_time_type LastWritten(const std::string& run) {
  fs::file_time_type latest = fs::file_time_type::min();
  for (const char* name : {"/config.toml", "/metrics.csv", "/log.txt"}) {
    std::error_code failure;
    const auto time = fs::last_write_time(run + name, failure);
    if (!failure) latest = std::max(latest, time);
  }
  return latest;
}

std::string LockFileOf(const std::string& directory) { return directory + "/lock"; }

/// Makes a directory, durably; false if it is there already.
bool Make(const std::string& path) {
  std::error_code failure;
  const bool made = fs::create_directory(path, failure);
  if (failure) {
    throw Error(fmt::format("{}: cannot be made a directory: {}", path, failure.message()));
  }
  if (made) SyncDirectory(fs::absolute(path).parent_path().string());
  return made;
}

}  // namespace

FileDescriptor LockDirectory(const std::string& directory) {
  FileDescriptor file(LockFileOf(directory), OpenMode::kAppend);
  if (flock(file.value(), LOCK_EX | LOCK_NB) == 0) return file;
  if (errno == EWOULDBLOCK) {
    throw Error(fmt::format("{}: another skein is at work here", directory));
  }
  if (!LacksLocks()) {
    throw Error(fmt::format("{}: cannot be locked: {}", directory, SystemReason()));
  }
  fmt::print(stderr,
             "warning: {}: its file system has no locks ({}): nothing keeps a second skein out\n",
             directory, SystemReason());
  return file;
}

bool IsHeld(const std::string& directory) {
  std::error_code failure;
  if (!fs::exists(LockFileOf(directory), failure)) return false;
  const FileDescriptor file(LockFileOf(directory), OpenMode::kRead);
  return flock(file.value(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

const std::string& MakeDirectories(const std::string& path) {
  const fs::path parent = fs::absolute(path).parent_path();
  std::error_code failure;
  if (!fs::exists(parent, failure)) MakeDirectories(parent.string());
  Make(path);
  return path;
}

bool IsRunDirectory(const std::string& path) {
  std::error_code failure;
  return fs::is_regular_file(path + "/config.toml", failure);
}

RunDirectory RunDirectory::Create(const std::string& path) {
  std::error_code failure;
  if (fs::exists(path, failure) && !(fs::is_directory(path) && fs::is_empty(path, failure))) {
    throw ChoiceError(
        IsRunDirectory(path)
            ? fmt::format("{}: holds a run already; continue it with --resume {}, or "
                          "choose another --out",
                          path, ShellWord(path))
            : fmt::format("{}: exists and is not an empty directory; choose another --out", path));
  }
  return RunDirectory(path);
}

RunDirectory RunDirectory::CreateIn(const std::string& root, const std::string& task) {
  MakeDirectories(root);
  const std::string base =
      fmt::format("{}/{}-{:%Y%m%d-%H%M%S}", root, task, fmt::localtime(std::time(nullptr)));
  std::string path = base;
  // Made and not asked for: another program may begin a run in the same second.
  for (int copy = 2; !Make(path); ++copy) path = fmt::format("{}-{}", base, copy);
  return RunDirectory(path);
}

RunDirectory RunDirectory::Open(const std::string& path) {
  RequireRun(path);
  return RunDirectory(path);
}

RunDirectory RunDirectory::Visit(const std::string& path) {
  RequireRun(path);
  return {path, FileDescriptor(path + "/config.toml", OpenMode::kRead)};
}

void RunDirectory::RemoveStub(const std::string& path) {
  std::error_code ignored;  // what stays is in the way of Create
  if (!fs::is_directory(path, ignored) || IsRunDirectory(path)) return;
  const RunDirectory stub(path, FileDescriptor(path, OpenMode::kDirectory));
  for (const std::string& file :
       {stub.config(), stub.low_level(), stub.task_file(), stub.aircraft(), stub.checkpoint(0)}) {
    fs::remove(file, ignored);
    fs::remove(file + kTemporaryExtension, ignored);
  }
  for (const std::string& last : {LockFileOf(stub.path()), stub.checkpoints()}) {
    fs::remove(last, ignored);
  }
}

RunDirectory::RunDirectory(const std::string& path)
    : RunDirectory(path, LockDirectory(MakeDirectories(WithoutTrailingSlashes(path)))) {
  MakeDirectories(checkpoints());
}

RunDirectory::RunDirectory(const std::string& path, FileDescriptor lock)
    : path_(WithoutTrailingSlashes(path)), lock_(std::move(lock)) {}

std::string RunDirectory::low_level() const {
  const std::string path = path_ + "/low_level.skein", older = path_ + "/controller.skein";
  std::error_code failure;
  return !fs::exists(path, failure) && fs::exists(older, failure) ? older : path;
}

std::string RunDirectory::checkpoint(std::uint64_t iteration) const {
  return fmt::format("{}/{}{:06}{}", checkpoints(), kCheckpointPrefix, iteration, kExtension);
}

std::vector<Checkpoint> CheckpointsIn(const std::string& folder) {
  std::vector<Checkpoint> found;
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder, failure)) {
    if (const auto iteration = IterationOf(entry.path().filename().string())) {
      found.push_back({*iteration, entry.path().string()});
    }
  }
  if (failure && failure != std::errc::no_such_file_or_directory) {
    throw Error(fmt::format("{}: cannot be read: {}", folder, failure.message()));
  }
  std::sort(found.begin(), found.end(),
            [](const Checkpoint& a, const Checkpoint& b) { return a.iteration < b.iteration; });
  return found;
}

void RunDirectory::Prune(int keep) const {
  const std::vector<Checkpoint> all = Checkpoints();
  for (std::size_t i = 0; i + static_cast<std::size_t>(keep) < all.size(); ++i) {
    std::error_code failure;
    fs::remove(all[i].path, failure);
    if (failure) {
      throw Error(fmt::format("{}: cannot be removed: {}", all[i].path, failure.message()));
    }
  }
}

void RunDirectory::RemoveTemporaries() const {
  for (const std::string& folder : {path_, checkpoints()}) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.is_regular_file() && entry.path().extension() == kTemporaryExtension) {
        fs::remove(entry.path());
      }
    }
  }
}

std::vector<std::string> FilesOfRuns(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    for (const char* name :
         {"config.toml", kTaskFileOfRun, "aircraft.json", "low_level.skein", "controller.skein",
          "log.txt", "metrics.csv", "timing.csv", "evaluation.json",
          "checkpoints/policy-best.skein", "checkpoints/policy-final.skein"}) {
      files.push_back(path + "/" + name);
    }
    if (!IsRunDirectory(path)) continue;
    for (const Checkpoint& checkpoint : CheckpointsIn(path + "/checkpoints")) {
      files.push_back(checkpoint.path);
    }
  }
  return files;
}

std::optional<std::string> LatestRun(const std::string& root, const std::string& task) {
  std::error_code failure;
  std::vector<std::pair<fs::file_time_type, std::string>> runs;
  for (const auto& entry : fs::directory_iterator(root, failure)) {
    const std::string run = entry.path().string();
    if (IsRunDirectory(run)) runs.emplace_back(LastWritten(run), run);
  }
  if (failure && failure != std::errc::no_such_file_or_directory) {
    throw Error(fmt::format("{}: cannot be read: {}", root, failure.message()));
  }
  std::sort(runs.rbegin(), runs.rend());
  std::exception_ptr unreadable;
  for (const auto& [time, run] : runs) {
    if (task.empty()) return run;
    try {
      if (ReadRecord(run + "/config.toml").train.env.task == task) return run;
    } catch (const Error&) {
      if (unreadable == nullptr) unreadable = std::current_exception();
    }
  }
  if (unreadable != nullptr) std::rethrow_exception(unreadable);
  return std::nullopt;
}

}  // namespace skein
