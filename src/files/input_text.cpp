// SPDX-License-Identifier: Apache-2.0
#include "src/files/input_text.h"

#include <filesystem>
#include <map>
#include <mutex>
#include <system_error>

#include "src/files/output_file.h"

namespace skein {

std::string ReadInputText(const std::string& path) {
  std::error_code failure;
  if (!std::filesystem::is_fifo(path, failure)) return ReadFile(path);
  static std::mutex mutex;
  static std::map<std::string, std::string> said;
  const std::lock_guard lock(mutex);
  const auto found = said.find(path);
  return found != said.end() ? found->second : said.emplace(path, ReadFile(path)).first->second;
}

}  // namespace skein
