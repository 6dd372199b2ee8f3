// SPDX-License-Identifier: Apache-2.0
#include "src/export/scratch_folder.h"

#include <stdlib.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "base/error.h"
#include "src/files/output_file.h"
#include "src/files/shell_text.h"
#include "train/files/file_descriptor.h"

namespace skein {

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
  const std::string complaint = ReadFile(errors);
  throw Error(what + ": " + complaint.substr(0, complaint.find('\n')));
}

}  // namespace skein
