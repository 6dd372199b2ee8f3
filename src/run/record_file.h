// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "base/fnv_hash.h"
#include "train/files/file_descriptor.h"

namespace skein {

/// A CSV file of a run, which grows by a row in every iteration, and the hash of all that it holds.
class RecordFile {
 public:
  /// Goes on with the file at `path`, or begins it with `header`; its name is durable. Throws Error
  /// if it cannot be read or written.
  RecordFile(const std::string& path, const std::string& header);

  /// Throws Error if it cannot be written.
  void Append(const std::string& row);
  void Sync() { file_.Sync(); }
  /// What the file holds now, for BeginsAs: "BYTES HASH".
  std::string Mark() const;

 private:
  void Add(const std::string& text);

  FileDescriptor file_;
  std::uint64_t bytes_ = 0;
  FnvHash hash_;
};

/// Whether the file at `path` begins with what a file held whose Mark was `mark`. Throws Error if
/// it cannot be read.
bool BeginsAs(const std::string& path, const std::string& mark);

}  // namespace skein
