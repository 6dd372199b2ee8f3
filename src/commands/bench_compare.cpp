// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "src/bench/bench_comparison.h"
#include "src/commands/benchmarks.h"
#include "src/files/output_file.h"

namespace skein {

void CompareBenchmarkFiles(const BenchOptions& options) {
  const auto files = [](const std::string& list) { return CLI::detail::split(list, ','); };
  const BenchComparison comparison =
      CompareBenchmarks(files(options.before), files(options.after), options.other_machine);
  fmt::print("{}\n", ToText(comparison));
  if (!options.json.empty()) WriteJson(options.json, ToJson(comparison));
}

}  // namespace skein
