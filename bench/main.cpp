// SPDX-License-Identifier: MIT
// The benchmarks, with flags that make their ratios robust on a noisy machine; flags of the command line win.

#include <vector>

#include "benchmarks.hpp"
#include "reporter.hpp"

int main(int argc, char** argv) {
  using namespace jetlag::bench;
  register_expansion();
  register_restart();
  register_adolc();
  register_step();
  register_checks();
  register_asynchrony();
  register_solids();
  register_engine();
  register_peers();

  // Short repetitions in random order, of which the fastest counts: what disturbs one spares the others.
  char repetitions[] = "--benchmark_repetitions=12", time[] = "--benchmark_min_time=0.03",
       order[] = "--benchmark_enable_random_interleaving=true";
  std::vector<char*> arguments{argv[0], repetitions, time, order};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);

  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  return reporter.failed() ? 1 : 0;
}
