// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "src/bench/machine.h"
#include "src/commands/commands.h"
#include "src/files/output_file.h"

namespace skein {
namespace {

void PrintInfo(const std::string& json_path) {
  CheckWritable(json_path);
  RequireEnding(json_path, ".json", "--json writes JSON");
  const nlohmann::ordered_json info = DescribeMachine();
  if (!json_path.empty()) WriteJson(json_path, info);
  const std::string libtorch = info["libtorch"].is_null()
                                   ? "not available: networks by the fused kernels alone"
                                   : info["libtorch"].get<std::string>();
  const std::string blas = info["libtorch_openblas"].is_null()
                               ? ""
                               : fmt::format(" (OpenBLAS for {}; force one with OPENBLAS_CORETYPE)",
                                             info["libtorch_openblas"].get<std::string>());
  const auto text = [&info](const char* key) { return info[key].get<std::string>(); };
  // Hypervisors cut names short: "AMD EPYC".
  const std::string generation =
      info["cpu_family"].is_null() || info["cpu_model"].is_null()
          ? ""
          : fmt::format(" (family {}, model {})", info["cpu_family"].get<int>(),
                        info["cpu_model"].get<int>());
  const auto yes_or_no = [&info](const char* key) { return info[key].get<bool>() ? "yes" : "no"; };
  fmt::print(
      "skein     {} (commit {}, {}, {})\n"
      "cpu       {}{}\n"
      "threads   {}\n"
      "simd      {} (supported: {}; force one with SKEIN_SIMD)\n"
      "learner   precision {} (native bf16: {}, amx: {}; choose one with learner.precision)\n"
      "libtorch  {}{}\n",
      text("version"), text("commit"), text("compiler"), text("build_type"), text("cpu"),
      generation, info["threads"].get<int>(), text("simd"),
      fmt::join(info["simd_supported"].get<std::vector<std::string>>(), ", "), text("precision"),
      yes_or_no("native_bf16"), yes_or_no("native_amx"), libtorch, blas);
}

}  // namespace

void AddInfoCommand(CLI::App* app) {
  auto json = std::make_shared<std::string>();
  CLI::App* command =
      app->add_subcommand("info", "Show version, processor, SIMD target, threads and LibTorch");
  command->add_option("--json", *json, "also write it here")->type_name("FILE");
  command->footer(
      "The environment variable SKEIN_SIMD (avx512, avx2, sse4, neon, scalar) forces a "
      "target.");
  command->callback([json] { PrintInfo(*json); });
}

}  // namespace skein
