// SPDX-License-Identifier: Apache-2.0
#include "src/commands/threads_option.h"

#include "src/config/whole_number.h"

namespace skein {

CLI::Option* AddThreadsOption(CLI::App* command, int* threads) {
  return command
      ->add_option(
          "--threads", *threads,
          "worker threads; results do not depend on it (default: one for each CPU it may use)")
      ->transform(WholeNumber(1, 1024));
}

}  // namespace skein
