// SPDX-License-Identifier: MIT
// Does the expansion of a problem's motion cost O(N^2), and what is the price of an element?

#include "jetlag/motion/expansion.hpp"

#include "benchmarks.hpp"

namespace jetlag::bench {

namespace {

void expand(benchmark::State& run, const std::string& name, int degree) {
  const Problem problem = bench::problem(name);
  Expansion<double> series(problem.system, degree);
  for (auto _ : run) {
    series.start(problem.start);
    series.grow_to(degree);
    benchmark::DoNotOptimize(series.position(degree).data());
    benchmark::ClobberMemory();
  }
  count_elements(run, problem);
}

}  // namespace

void register_expansion() {
  for (const std::string name : {"cloth10", "cloth50", "kepler"})
    for (const int degree : {2, 4, 8, 16, 32, 64})
      benchmark::RegisterBenchmark(("BM_Expansion/" + name + "/" + std::to_string(degree)).c_str(), expand,
                                   name, degree);
}

}  // namespace jetlag::bench
