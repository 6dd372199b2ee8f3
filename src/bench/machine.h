// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/worker_pool.h"

namespace skein {

/// What the system says of a processor. Hypervisors cut names short ("AMD EPYC"): family and model,
/// as CPUID counts them, still tell generations apart.
struct CpuFacts {
  std::string name = "unknown";                ///< "Intel(R) Xeon(R) ..."
  std::optional<int> family, model, stepping;  ///< none where the system does not say
};

/// Of the first processor in what Linux writes to /proc/cpuinfo.
CpuFacts ReadCpuFacts(std::istream& cpuinfo);

/// "SIMD target avx512, 2 threads": what the pool's workers compute with.
std::string DescribeWorkers(const WorkerPool& pool);

/// "version 0.3.0 of commit ... by GNU 12.2.0, SIMD target avx512": what bits depend on beside the
/// configuration.
std::string DescribeProgram();

/// The same as a document, with keys version, commit, compiler and simd: `program` of files that
/// hold results and no times. They name no machine, so that they are the same whatever number of
/// threads and ranks wrote them.
nlohmann::ordered_json ProgramJson();

/// What a figure depends on: version, commit, compiler, processor, SIMD target in use and supported
/// ones, threads that commands use unless told otherwise, LibTorch (null without its module). The
/// document of `skein info --json`, and part of every benchmark's. Keys cpu_family, cpu_model and
/// cpu_stepping are null where the system does not say.
nlohmann::ordered_json DescribeMachine();

}  // namespace skein
