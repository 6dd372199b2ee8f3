// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/worker_pool.h"

namespace skein {

/// "Intel(R) Xeon(R) ..." as the system names the processor, or "unknown".
std::string CpuName();

/// "SIMD target avx512, 2 threads": what the pool's workers compute with.
std::string DescribeWorkers(const WorkerPool& pool);

/// "version 0.2.0 of commit ... by GNU 12.2.0, SIMD target avx512": what bits depend on beside the
/// configuration.
std::string DescribeProgram();

/// What a figure depends on: version, commit, compiler, processor, SIMD target in use and supported
/// ones, threads that commands use unless told otherwise, LibTorch (null without its module). The
/// document of `skein info
/// --json`, and part of every benchmark's.
nlohmann::ordered_json DescribeMachine();

}  // namespace skein
