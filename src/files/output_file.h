// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace skein {

/// Replaces the file at `path` by `text`, durably and whole or not at all (ReplaceFile); through a
/// symbolic link, the file it leads to. A device, a pipe or the program's own standard output is
/// written to directly. Throws Error (path, reason of the system).
void WriteFile(const std::string& path, const std::string& text);

/// The same of a document, indented. Text in it that is not UTF-8, which names of files may hold,
/// is replaced by U+FFFD.
void WriteJson(const std::string& path, const nlohmann::ordered_json& document);

/// Throws Error (path, reason) if WriteFile is sure to fail there: before the work whose result it
/// is to hold. An empty path stands for no file.
void CheckWritable(const std::string& path);

/// The same of every path. Throws ChoiceError if two of them would replace the same file, or one of
/// them a file of `read`, by whatever name: what is read is not to be lost. Empty paths, and files
/// that are not there, stand for none.
void CheckWritable(const std::vector<std::string>& paths,
                   const std::vector<std::string>& read = {});

/// Throws ChoiceError if the name `path` ends as files of another format that Skein knows do, and
/// not in `ending`, as ".csv": most likely another option was meant. `content` is what is written
/// there: "flights are written as CSV". Other endings, none, and an empty path pass.
void RequireEnding(const std::string& path, const std::string& ending, const std::string& content);

/// What the line about a file that is about to be written calls it: `path`, and where nobody asked
/// for a file of that name (`is_default`) and one is there, " (replaced)" behind it.
std::string OutputName(const std::string& path, bool is_default);

/// `name` with what file names had better not hold replaced by '-'.
std::string FileNamePart(const std::string& name);

/// What a file that somebody wrote, or a program for them, has at most, bytes.
constexpr std::uint64_t kLargestText = std::uint64_t{64} << 20;
/// What a file that grows with a run has at most, bytes.
constexpr std::uint64_t kLargestRecord = std::uint64_t{4} << 30;

/// The whole file, which may be a pipe: then it waits for what is written there. Throws Error if it
/// cannot be read or has more than `largest` bytes.
std::string ReadFile(const std::string& path, std::uint64_t largest = kLargestText);

}  // namespace skein
