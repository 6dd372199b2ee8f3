// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <iostream>

#include "base/error.h"
#include "bench/report.h"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    skein::bench::DescribeContext();
    benchmark::RunSpecifiedBenchmarks();
  } catch (const skein::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  benchmark::Shutdown();
  return 0;
}
