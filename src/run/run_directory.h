// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/config/task_file.h"
#include "train/files/file_descriptor.h"

namespace skein {

/// A checkpoint on disk.
struct Checkpoint {
  std::uint64_t iteration = 0;
  std::string path;
};

/// The checkpoints in a run's folder of checkpoints, oldest first; none if there is no such folder.
/// Throws Error if it cannot be read.
std::vector<Checkpoint> CheckpointsIn(const std::string& folder);

/// Where runs are unless a directory is named.
inline constexpr const char* kRunsRoot = "runs";

/// The directory of one training run, held exclusively while the object lives:
///   config.toml, low_level.skein (of high-level policies), task.toml (of task files),
///   aircraft.json (of aircraft that come from a file), log.txt, metrics.csv, timing.csv,
///   events.out.tfevents.*, evaluation.json, summary.json, report.html,
///   checkpoints/checkpoint-<iteration>.skein, checkpoints/policy-best.skein,
///   checkpoints/policy-final.skein
class RunDirectory {
 public:
  /// Makes a new one. Throws Error if `path` exists and is not an empty directory, cannot be made,
  /// or is held by another process.
  static RunDirectory Create(const std::string& path);
  /// Makes a new one in `root`: <root>/<task>-<date>-<time>, or with -2, -3 ... behind it.
  static RunDirectory CreateIn(const std::string& root, const std::string& task);
  /// Opens one that holds a run. Throws Error if it does not, or another process holds it.
  static RunDirectory Open(const std::string& path);
  /// The same without holding it, for processes that train with the one that does.
  static RunDirectory Visit(const std::string& path);

  /// Removes what a process that was killed while it made a run in `path` has left there. A run,
  /// and what is none of its files, stay: of these Create says that they are in the way.
  static void RemoveStub(const std::string& path);

  const std::string& path() const { return path_; }
  std::string config() const { return path_ + "/config.toml"; }
  /// Where the low-level policy is: runs of version 0.1 have it as controller.skein.
  std::string low_level() const;
  /// Of runs of a task file its copy.
  std::string task_file() const { return path_ + "/" + kTaskFileOfRun; }
  std::string aircraft() const { return path_ + "/aircraft.json"; }
  std::string log() const { return path_ + "/log.txt"; }
  std::string metrics() const { return path_ + "/metrics.csv"; }
  std::string timing() const { return path_ + "/timing.csv"; }
  std::string evaluation() const { return path_ + "/evaluation.json"; }
  std::string checkpoints() const { return path_ + "/checkpoints"; }
  std::string best_policy() const { return checkpoints() + "/policy-best.skein"; }
  std::string final_policy() const { return checkpoints() + "/policy-final.skein"; }
  std::string checkpoint(std::uint64_t iteration) const;

  /// All checkpoints, oldest first.
  std::vector<Checkpoint> Checkpoints() const { return CheckpointsIn(checkpoints()); }
  /// Removes the oldest checkpoints so that `keep` stay. Throws Error if one cannot be removed.
  void Prune(int keep) const;
  /// Removes temporary files that a killed process left behind.
  void RemoveTemporaries() const;

 private:
  /// Makes the folders that are missing, and takes the lock.
  explicit RunDirectory(const std::string& path);
  RunDirectory(const std::string& path, FileDescriptor lock);

  std::string path_;
  FileDescriptor lock_;
};

/// Takes the lock of a directory that training works in, for as long as the descriptor lives; warns
/// on the standard error where the file system has no locks. Throws Error if another process holds
/// it.
FileDescriptor LockDirectory(const std::string& directory);

/// Whether a process holds that lock now.
bool IsHeld(const std::string& directory);

/// Makes `path` and what is missing above it, durably; returns it.
const std::string& MakeDirectories(const std::string& path);

/// Whether `path` is the directory of a run.
bool IsRunDirectory(const std::string& path);

/// The files in the directories of runs that commands read: record, checkpoints and policies. Not
/// all of them need to be there. Throws Error if a folder of checkpoints cannot be read.
std::vector<std::string> FilesOfRuns(const std::vector<std::string>& paths);

/// The run under `root` that was written to last, of `task` unless that is empty. Throws Error if
/// there is none but one whose configuration cannot be read.
std::optional<std::string> LatestRun(const std::string& root, const std::string& task);

}  // namespace skein
