// SPDX-License-Identifier: Apache-2.0
#include "src/files/output_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "base/choice_error.h"
#include "base/error.h"
#include "base/file_error.h"
#include "train/files/file_descriptor.h"

namespace skein {
namespace {

/// The standard stream that `file` is, by whatever name (/dev/stdout, a redirection's file), or -1.
/// Replacing such a file would take it from under the stream.
int StandardStream(const struct stat& file) {
  for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat stream {};
    if (fstat(descriptor, &stream) == 0 && stream.st_dev == file.st_dev &&
        stream.st_ino == file.st_ino) {
      return descriptor;
    }
  }
  return -1;
}

bool IsSameFile(const std::string& path, const struct stat& file) {
  struct stat other {};
  return stat(path.c_str(), &other) == 0 && other.st_dev == file.st_dev &&
         other.st_ino == file.st_ino;
}

/// The file that is written in place of `path`: what a symbolic link leads to, else itself.
std::string ReplacedFile(const std::string& path) {
  std::error_code failure;
  const bool is_link = std::filesystem::is_symlink(path, failure);
  return is_link ? std::filesystem::weakly_canonical(path).string() : path;
}

/// Of all formats that a command reads or writes, and of pictures; but for .c, as whoever exports C
/// may call it that.
constexpr const char* kEndings[] = {".acmi",        ".csv",   ".h",   ".html", ".json",
                                    ".onnx",        ".pdf",   ".png", ".pt",   ".py",
                                    ".safetensors", ".skein", ".svg", ".toml"};

}  // namespace

std::string FileNamePart(const std::string& name) {
  std::string part = name;
  const auto is_odd = [](unsigned char c) {
    return std::isalnum(c) == 0 && c != '.' && c != '_' && c != '-';
  };
  std::replace_if(part.begin(), part.end(), is_odd, '-');
  return part;
}

std::string OutputName(const std::string& path, bool is_default) {
  std::error_code failure;
  const bool replaces = is_default && std::filesystem::is_regular_file(path, failure);
  return replaces ? path + " (replaced)" : path;
}

void CheckWritable(const std::string& path) {
  if (path.empty()) return;
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) {
      throw ChoiceError(path + ": cannot be written: it is a directory");
    }
    if (access(path.c_str(), W_OK) != 0) {
      throw Error(path + ": cannot be written: " + SystemReason());
    }
    if (!S_ISREG(status.st_mode) || StandardStream(status) >= 0) return;
  }
  try {
    TryReplacing(ReplacedFile(path));
  } catch (const FileError&) {
    const std::string message = path + ": cannot be written: " + SystemReason();
    const auto folder = std::filesystem::absolute(path).parent_path();
    std::error_code failure;
    if (!std::filesystem::is_directory(folder, failure)) throw ChoiceError(message);
    throw Error(message);
  }
}

void CheckWritable(const std::vector<std::string>& paths, const std::vector<std::string>& read) {
  std::set<std::string> files;
  for (const std::string& path : paths) {
    CheckWritable(path);
    struct stat status {};
    const bool exists = stat(path.c_str(), &status) == 0;
    if (path.empty() || (exists && (!S_ISREG(status.st_mode) || StandardStream(status) >= 0))) {
      continue;
    }
    if (!files.insert(std::filesystem::weakly_canonical(path).string()).second) {
      throw ChoiceError(path + ": two results would go there");
    }
    const auto replaces = [&](const std::string& input) { return IsSameFile(input, status); };
    if (exists && std::any_of(read.begin(), read.end(), replaces)) {
      throw ChoiceError(path + ": is read, too; choose another output");
    }
  }
}

void RequireEnding(const std::string& path, const std::string& ending, const std::string& content) {
  std::string own = std::filesystem::path(path).extension().string();
  std::transform(own.begin(), own.end(), own.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool is_known =
      std::find(std::begin(kEndings), std::end(kEndings), own) != std::end(kEndings);
  if (!is_known || own == ending) return;
  throw ChoiceError(fmt::format("{}: {}: let the name end in {}", path, content, ending));
}

void WriteFile(const std::string& path, const std::string& text) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) {
    if (const int stream = StandardStream(status); stream >= 0) {
      std::FILE* const out = stream == STDOUT_FILENO ? stdout : stderr;
      if (std::fwrite(text.data(), 1, text.size(), out) != text.size() || std::fflush(out) != 0) {
        throw Error(path + ": cannot be written: " + SystemReason());
      }
      return;
    }
    if (!S_ISREG(status.st_mode)) {
      FileDescriptor(path, OpenMode::kWrite).Write(text);
      return;
    }
  }
  ReplaceFile(ReplacedFile(path), [&](FileDescriptor& file) { file.Write(text); });
}

void WriteJson(const std::string& path, const nlohmann::ordered_json& document) {
  using Handler = nlohmann::ordered_json::error_handler_t;
  WriteFile(path, document.dump(1, ' ', false, Handler::replace) + "\n");
}

std::string ReadFile(const std::string& path, std::uint64_t largest) {
  return FileDescriptor(path, OpenMode::kRead).ReadToEnd(largest);
}

}  // namespace skein
