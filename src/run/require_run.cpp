// SPDX-License-Identifier: Apache-2.0
#include "src/run/require_run.h"

#include <fmt/format.h>

#include "base/choice_error.h"
#include "src/run/run_directory.h"

namespace skein {

void RequireRun(const std::string& path) {
  if (IsRunDirectory(path)) return;
  throw ChoiceError(
      fmt::format("{}: not the directory of a run (there is no config.toml in it)", path));
}

}  // namespace skein
