// SPDX-License-Identifier: Apache-2.0
#include "src/run/record_file.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "src/files/output_file.h"

namespace skein {
namespace {

std::string MarkOf(std::uint64_t bytes, const FnvHash& hash) {
  return fmt::format("{} {}", bytes, hash.Hex());
}

}  // namespace

RecordFile::RecordFile(const std::string& path, const std::string& header)
    : file_(path, OpenMode::kAppend) {
  if (file_.size() == 0) {
    Append(header);
  } else {
    Add(ReadFile(path, kLargestRecord));
  }
  SyncDirectory(std::filesystem::absolute(path).parent_path().string());
}

void RecordFile::Append(const std::string& row) {
  file_.Write(row);
  Add(row);
}

void RecordFile::Add(const std::string& text) {
  bytes_ += text.size();
  hash_.Add(text.data(), text.size());
}

std::string RecordFile::Mark() const { return MarkOf(bytes_, hash_); }

bool BeginsAs(const std::string& path, const std::string& mark) {
  std::uint64_t bytes = 0;
  std::from_chars(mark.data(), mark.data() + mark.size(), bytes);
  const std::string text = std::filesystem::exists(path) ? ReadFile(path, kLargestRecord) : "";
  if (text.size() < bytes) return false;
  FnvHash hash;
  hash.Add(text.data(), bytes);
  return mark == MarkOf(bytes, hash);
}

}  // namespace skein
