// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "jetlag/control/last_two.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "problems/chains.hpp"
#include "studies/studies.hpp"

namespace jetlag {

namespace mass_ratio {  // batches compile studies together
namespace {

struct Arguments {
  double periods = 1000, tolerance = 1e-10;
  std::vector<int> degrees = {4, 8, 12, 16, 20};
};

/// x of the light mass m at time t: a sum of two modes of frequencies w, x_1 = a, x_2 = a / (1 - m w^2), a = v_1 / w ...,
/// with k = 1 for both springs. In 80 bits.         Source: det (K - w^2 M) = m w^4 - (1 + 2 m) w^2 + 1 = 0.
double light_at(double t) {
  using Real = long double;
  const Real m = 1e-6L, p = (1 + 2 * m) / (2 * m), root = std::sqrt(p * p - 1 / m);
  const Real fast = p + root, slow = 1 / (m * fast);                    // w^2: their product is 1 / m
  const Real r_slow = 1 / (1 - m * slow), r_fast = 1 / (1 - m * fast);  // x_2 / x_1
  const Real v_slow = r_fast / (r_fast - r_slow), v_fast = 1 - v_slow;  // v_1 = 1, v_2 = 0 at the start
  const auto sine = [&](Real square, Real v) {
    return v / std::sqrt(square) * std::sin(std::sqrt(square) * t);
  };
  return static_cast<double>(r_slow * sine(slow, v_slow) + r_fast * sine(fast, v_fast));
}

void run_row(const Arguments& arguments, int degree, const char* name, Schedule& schedule) {
  const double until = arguments.periods * 2 * std::numbers::pi / problems::fast_frequency;
  problems::Problem scene = problems::light_mass();
  EnergyMeter meter(scene.system);
  const double begin = meter(scene.start).total();
  constexpr int frames = 1000;
  double early = 0, all = 0;
  int frame = 0;
  std::uint64_t updates[3] = {};
  RunOptions options;
  for (int i = 1; i <= frames; ++i) options.observer.frame_times.push_back(until * i / frames);
  options.observer.at_frame = [&](const State<double>& state) {
    all = std::max(all, std::abs(meter(state).total() / begin - 1));
    if (++frame == frames / 10) early = all;
  };
  options.observer.on_update = [&](const Update& update) { ++updates[update.particle]; };
  State<double> state = scene.start;
  const Report report = schedule.run(state, until, options);
  if (report.outcome != Outcome::success) {
    std::printf("%6d %-16s %s\n", degree, name, report.message.c_str());
    return;
  }
  std::printf("%6d %-16s %10llu %10llu %8.2f %11.4g %11.2g %9.2g %14.2g\n", degree, name,
              static_cast<unsigned long long>(updates[1]), static_cast<unsigned long long>(updates[2]),
              static_cast<double>(updates[2]) / static_cast<double>(updates[1]),
              static_cast<double>(schedule.work().element_coefficients), early, all,
              std::abs(state.position(2, 0) - light_at(until)));
  std::fflush(stdout);
}

int run_it(const Arguments& arguments) {
  const problems::Problem scene = problems::light_mass();
  std::printf("wall - 1 N/m - 1 kg - 1 N/m - 1e-6 kg, %g periods of the light mass (%g s), tolerance %g m\n",
              arguments.periods, arguments.periods * 2 * std::numbers::pi / problems::fast_frequency,
              arguments.tolerance);
  std::printf("%6s %-16s %31s %11s %21s %14s\n", "", "", "updates", "element", "relative energy error",
              "error of");
  std::printf("%6s %-16s %10s %10s %8s %11s %11s %9s %14s\n", "degree", "", "heavy", "light", "ratio",
              "coeffs", "a tenth", "all", "the light mass");
  for (const int degree : arguments.degrees) {
    for (const int grading : {0, 1}) {
      BlockSteps::Options options;
      options.tolerance = arguments.tolerance;
      options.grading = grading;
      BlockSteps block(scene.system, degree, options);
      run_row(arguments, degree, grading == 0 ? "block, grading 0" : "block, grading 1", block);
    }
    Asynchronous::Options options;
    options.tolerance = arguments.tolerance;
    Asynchronous free_clocks(scene.system, degree, options);
    run_row(arguments, degree, "free clocks", free_clocks);
    Lockstep lockstep(taylor(scene.system, degree, std::make_unique<LastTwo>(arguments.tolerance)));
    run_row(arguments, degree, "lockstep", lockstep);
  }
  return 0;
}

}  // namespace
}  // namespace mass_ratio

Command mass_ratio_study() {
  using namespace mass_ratio;
  return command<Arguments>("mass_ratio",
                            "a heavy mass shaken by a light one: updates of each, energy over many periods",
                            run_it, [](Arguments& a) -> std::vector<Option> {
                              return {{"--periods", &a.periods, "of the light mass", Between{1, 1e9}},
                                      {"--tolerance", &a.tolerance, "of a step [m]", Positive{}},
                                      {"--degrees", &a.degrees, "of the series", Between{4, 32}}};
                            });
}

}  // namespace jetlag
