// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "studies/clocks/collapsing_body.hpp"
#include "studies/studies.hpp"

namespace jetlag {

namespace collapse {  // batches compile studies together
namespace {

constexpr double lead = 0.37, until = 1.0;  // [s]

struct Arguments {
  std::string mesh;
  std::vector<double> offsets = {1e-1, 1e-3, 1e-6, 0.0};  // lengths of the spring
  int degree = 8, runs = 8;
  double tolerance = 1e-9, bound = 1e-6;  // lengths of the spring
};

/// What a method makes of all runs, by distance from the collapse.
struct Outcomes {
  std::string name;
  double element_coefficients = 0;               // mean
  std::vector<double> updates = {}, error = {};  // mean of a particle; the largest at the end [lengths]
  double mean_good = 0;                          // particles within the bound at the end
  int fewest_good = 1 << 30, lasted = 0;         // runs that came to their end
};

/// One more run of a schedule: the spring of a body collapses, or is cut.
void add(Outcomes& all, const Arguments& arguments, const CollapsingBody& body, const State<double>& truth,
         Schedule& schedule) {
  const std::size_t distances = body.farthest() + 1;
  std::vector<double> particles(distances), updates(distances);
  RunOptions options;
  options.observer.on_update = [&](const Update& update) { ++updates[body.distance[update.particle]]; };
  State<double> state = body.start;
  const bool lasted = schedule.run(state, until, options).outcome == Outcome::success;
  all.updates.resize(distances);
  all.error.resize(distances);
  int good = 0;
  for (std::size_t i = 0; i < body.distance.size(); ++i) {
    const double error = (state.position.row(i) - truth.position.row(i)).norm() / body.length;
    good += lasted && error <= arguments.bound;
    ++particles[body.distance[i]];
    double& worst = all.error[body.distance[i]];
    worst = lasted ? std::max(worst, error) : std::numeric_limits<double>::infinity();
  }
  for (std::size_t d = 0; d < distances; ++d) all.updates[d] += updates[d] / particles[d] / arguments.runs;
  all.element_coefficients +=
      static_cast<double>(schedule.work().element_coefficients) / static_cast<double>(arguments.runs);
  all.mean_good += static_cast<double>(good) / arguments.runs;
  all.fewest_good = std::min(all.fewest_good, good);
  all.lasted += lasted;
}

template <class ScheduleType>
ScheduleType with_clocks(const System<double>& system, const Arguments& arguments, double length) {
  typename ScheduleType::Options options;
  options.tolerance = arguments.tolerance * length;
  return {system, arguments.degree, options};
}

void print(const Arguments& arguments, const CollapsingBody& body, double offset, double step,
           const std::vector<Outcomes>& with, const std::vector<Outcomes>& without) {
  std::printf("\noffset %g, %d runs; fixed steps of 1/%.0f s\n", offset, arguments.runs, 1 / step);
  std::printf("%-12s %14s %8s %22s %22s\n", "", "elem. coef.", "lasted", "within bound: fewest", "mean");
  for (const Outcomes& all : with)
    std::printf("%-12s %14.4g %8d %22d %22.1f\n", all.name.c_str(), all.element_coefficients, all.lasted,
                all.fewest_good, all.mean_good);
  std::printf("%8s %9s  %-51s %s\n", "", "", "updates of a particle, more than without", "largest error");
  std::printf("%8s %9s", "distance", "particles");
  for (const Outcomes& all : with) std::printf(" %8s%5s", all.name.c_str(), "");
  for (const Outcomes& all : with) std::printf(" %8s", all.name.c_str());
  std::printf("\n");
  for (int d = 0; d <= body.farthest(); ++d) {
    std::printf("%8d %9d", d, static_cast<int>(std::ranges::count(body.distance, d)));
    for (std::size_t m = 0; m < with.size(); ++m)
      if (m < without.size())
        std::printf(" %6.1f%+7.2f", with[m].updates[d], with[m].updates[d] - without[m].updates[d]);
      else
        std::printf(" %6.1f%7s", with[m].updates[d], "");
    for (const Outcomes& all : with) std::printf(" %8.1e", all.error[d]);
    std::printf("\n");
  }
  std::fflush(stdout);
}

int run_it(const Arguments& arguments) {
  const Mesh mesh = arguments.mesh.empty() ? truncated_ellipsoid({0.8, 1.2, 0.8}, {8, 8}, 0.9, 0.95)
                                           : read_medit(arguments.mesh);
  const int edge = edge_near(mesh, mesh.position.colwise().mean());
  std::printf("%s: %d particles, %d springs; the one between %d and %d collapses after %g of %g s\n",
              arguments.mesh.empty() ? "generated body" : arguments.mesh.c_str(),
              static_cast<int>(mesh.position.rows()), static_cast<int>(mesh.edges.size()),
              mesh.edges[edge][0], mesh.edges[edge][1], lead, until);
  std::printf("degree %d, tolerance %g, bound %g; errors in lengths of that spring\n", arguments.degree,
              arguments.tolerance, arguments.bound);
  for (const double offset : arguments.offsets) {
    std::vector<Outcomes> with{{"block"}, {"free"}, {"lockstep"}, {"fixed"}}, without{{"block"}, {"free"}};
    double step = 0;
    for (int run = 0; run < arguments.runs; ++run) {
      // Fixed steps are as many as cost what block steps do in the first run, rounded up; over the runs the collapse
      // comes at equally spaced places within such a step.
      const CollapsingBody body = collapsing_body(mesh, edge, offset, lead + run * step / arguments.runs);
      const State<double> truth = moved(body.system, body.nearest, until);
      const auto clocks = [&](Outcomes& all, auto schedule) { add(all, arguments, body, truth, schedule); };
      clocks(with[0], with_clocks<BlockSteps>(body.system, arguments, body.length));
      clocks(with[1], with_clocks<Asynchronous>(body.system, arguments, body.length));
      clocks(without[0], with_clocks<BlockSteps>(body.cut, arguments, body.length));
      clocks(without[1], with_clocks<Asynchronous>(body.cut, arguments, body.length));
      Lockstep same_rule(taylor(body.system, arguments.degree,
                                std::make_unique<LastTwo>(arguments.tolerance * body.length)));
      add(with[2], arguments, body, truth, same_rule);
      if (run == 0) {
        const double of_a_step = arguments.degree * static_cast<double>(mesh.edges.size());
        step = 1 / std::ceil(with[0].element_coefficients * arguments.runs / of_a_step);
      }
      Lockstep fixed(taylor(body.system, arguments.degree, std::make_unique<FixedStep>(step)));
      add(with[3], arguments, body, truth, fixed);
      if (run + 1 == arguments.runs) print(arguments, body, offset, step, with, without);
    }
  }
  return 0;
}

}  // namespace
}  // namespace collapse

Command collapse_study() {
  using namespace collapse;
  return command<Arguments>(
      "collapse",
      "a spring that collapses in a body: updates and errors by distance, clocks beside one clock", run_it,
      [](Arguments& a) -> std::vector<Option> {
        return {
            {"--mesh", &a.mesh, "a Medit mesh in place of the generated body"},
            {"--offsets", &a.offsets, "how far apart its ends pass each other [its lengths]", Between{0, 1}},
            {"--degree", &a.degree, "of the series", Between{4, 32}},
            {"--tolerance", &a.tolerance, "of a step [lengths of the spring]", Positive{}},
            {"--bound", &a.bound, "of a good particle's error [lengths of the spring]", Positive{}},
            {"--runs", &a.runs, "collapses, each elsewhere within a fixed step", Between{1, 1000}}};
      });
}

}  // namespace jetlag
