#include <benchmark/benchmark.h>

#include <iostream>

#include "bench/report.h"
#include "base/error.h"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    skein::bench::DescribeRoofs();
    benchmark::RunSpecifiedBenchmarks();
  } catch (const skein::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  benchmark::Shutdown();
  return 0;
}
