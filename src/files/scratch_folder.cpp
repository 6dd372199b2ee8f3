// SPDX-License-Identifier: Apache-2.0
#include "src/files/scratch_folder.h"

#include <stdlib.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "base/error.h"
#include "src/files/output_file.h"
#include "src/files/shell_text.h"
#include "train/files/file_descriptor.h"

namespace skein {
namespace {

/// Of what a program complained of the line that says most: a first error that calls itself one,
/// else the line below a rule, which is where mpirun begins, else the last line, which is where
/// Python names its exception; empty if it said nothing.
std::string Essence(const std::string& complaint) {
  std::istringstream lines(complaint);
  std::string last, below_rule;
  for (std::string line; std::getline(lines, line);) {
    // As compilers write it, and as mpirun does.
    for (const char* mark : {"error:", ": Error:"}) {
      if (line.find(mark) != std::string::npos) return line;
    }
    if (below_rule.empty() && last.rfind("-----", 0) == 0) below_rule = line;
    if (!line.empty()) last = line;
  }
  return below_rule.empty() ? last : below_rule;
}

}  // namespace

ScratchFolder::ScratchFolder()
    : path_((std::filesystem::temp_directory_path() / "skein-XXXXXX").string()) {
  if (mkdtemp(path_.data()) == nullptr) throw Error(path_ + ": " + SystemReason());
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void RunShell(const std::string& line, const ScratchFolder& folder, const std::string& what) {
  const std::string errors = folder / "errors";
  const int code = std::system(("{ " + line + "; } 2>" + SingleQuoted(errors)).c_str());
  if (code == 0) return;
  const std::string complaint = Essence(ReadFile(errors));
  throw Error(what + ": " + (complaint.empty() ? "it failed without a word" : complaint));
}

}  // namespace skein
