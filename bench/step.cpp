// SPDX-License-Identifier: MIT
// What does one step cost, with a fixed degree and with a random one?
//
// A random degree of mean K should cost what the fixed degree K costs, not what its largest degree does.

#include <limits>
#include <memory>

#include "benchmarks.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/taylor.hpp"

namespace jetlag::bench {

namespace {

constexpr double step_length = 1e-5;  // [s]: a thousandth of the shortest period, so that no method blows up

void step(benchmark::State& run, const Problem& problem, Integrator& integrator) {
  State<double> state = problem.start;
  Report report;
  for (auto _ : run) {
    const double h = integrator.step(state, std::numeric_limits<double>::infinity(), report);
    if (h == 0.0) {
      run.SkipWithError(report.message.c_str());
      return;
    }
    state.time += h;
  }
  const Work& work = integrator.work();
  run.counters["elements"] = static_cast<double>(element_count(problem.system));
  run.counters["element_coefficients"] =
      static_cast<double>(work.element_coefficients) / static_cast<double>(work.steps);
  run.counters["mean_degree"] = work.mean_degree();
}

void step_taylor(benchmark::State& run, const std::string& name, const TruncationLaw& law) {
  const Problem problem = bench::problem(name);
  RandomTaylor integrator(problem.system, law, std::make_unique<FixedStep>(step_length));
  step(run, problem, integrator);
}

void step_leapfrog(benchmark::State& run, const std::string& name) {
  const Problem problem = bench::problem(name);
  Leapfrog integrator(problem.system, step_length);
  step(run, problem, integrator);
}

void register_taylor(const std::string& name, const std::string& method, const TruncationLaw& law) {
  benchmark::RegisterBenchmark(("BM_Step/" + method + "/" + name).c_str(), step_taylor, name, law);
}

}  // namespace

void register_step() {
  const std::string name = "cloth10";
  for (const int degree : {2, 3, 4, 6, 8, 12, 16})
    register_taylor(name, "fixed:" + std::to_string(degree), fixed_degree(degree));
  register_taylor(name, "geometric:2,8,0.5", geometric(2, 8, 0.5));
  register_taylor(name, "geometric:3,6,0.5", geometric(3, 6, 0.5));
  register_taylor(name, "geometric:3,16,0.5", geometric(3, 16, 0.5));
  register_taylor(name, "geometric:4,16,0.25", geometric(4, 16, 0.25));
  benchmark::RegisterBenchmark(("BM_Step/leapfrog/" + name).c_str(), step_leapfrog, name);
}

}  // namespace jetlag::bench
