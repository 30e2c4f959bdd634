// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/avi.hpp"
#include "problems/chains.hpp"
#include "studies/studies.hpp"

namespace jetlag {

namespace avi_drift {  // batches compile studies together
namespace {

struct Arguments {
  double until = 1e5;
  std::vector<double> fractions = {0.1, 0.05};
};

/// Largest relative energy errors, of all the run and of its first and last tenth, at the times at which all clocks ring
/// together; or rather 1e-9 s later, for these times are rounded, and just before an impulse half of it is missing.
int run_row(double fraction, double until) {
  const problems::Problem chain = problems::ten_masses();
  EnergyMeter energy(chain.system);
  const double begin = energy(chain.start).total(), period = problems::common_period_of_ten_masses(fraction),
               later = 1e-9;
  const auto count = static_cast<std::int64_t>(until / period);
  double first = 0, last = 0, largest = 0, momentum_error = 0;
  std::int64_t seen = 0;
  RunOptions options;
  options.observer.frame_times.reserve(count);
  for (std::int64_t i = 1; i <= count; ++i) options.observer.frame_times.push_back(i * period + later);
  options.observer.at_frame = [&](const State<double>& state) {
    const double error = std::abs(energy(state).total() / begin - 1);
    largest = std::max(largest, error);
    if (seen < count / 10) first = std::max(first, error);
    if (seen >= count - count / 10) last = std::max(last, error);
    momentum_error = std::max(momentum_error, std::abs(momentum(chain.system, state)(0) - 0.5));
    ++seen;
  };
  Avi avi(chain.system, courant_steps(chain.system, fraction));
  State<double> state = chain.start;
  const Report report = avi.run(state, count * period + later, options);
  if (report.outcome != Outcome::success) {
    std::printf("%10g %s\n", fraction, report.message.c_str());
    return 1;
  }
  std::printf("%10g %10llu %10.5f %12.5f %12.5f %10.4f %14.2g %16llu\n", fraction,
              static_cast<unsigned long long>(count), largest, first, last, last / first, momentum_error,
              static_cast<unsigned long long>(avi.work().element_coefficients));
  std::fflush(stdout);
  return 0;
}

int run_it(const Arguments& arguments) {
  std::printf("ten masses, hardening springs of 1 and 100 in turn, %g s; steps are fractions of 2/omega\n",
              arguments.until);
  std::printf("%10s %10s %36s %10s %14s %16s\n", "", "", "largest relative error of the energy", "last /",
              "error of", "");
  std::printf("%10s %10s %10s %12s %12s %10s %14s %16s\n", "fraction", "times", "all", "first tenth",
              "last tenth", "first", "the momentum", "impulses");
  int code = 0;
  for (const double fraction : arguments.fractions) code = std::max(code, run_row(fraction, arguments.until));
  return code;
}

}  // namespace
}  // namespace avi_drift

Command avi_drift_study() {
  using namespace avi_drift;
  return command<Arguments>("avi_drift", "energy and momentum of a chain over a long run of avi", run_it,
                            [](Arguments& a) -> std::vector<Option> {
                              return {{"--until", &a.until, "length of the runs [s]", Between{10, 1e7}},
                                      {"--fractions", &a.fractions,
                                       "steps as fractions of each spring's 2/omega", Between{1e-3, 1}}};
                            });
}

}  // namespace jetlag
