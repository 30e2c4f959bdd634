// SPDX-License-Identifier: MIT
#include "studies/comparison/test_problems.hpp"

#include <numbers>
#include <stdexcept>

#include "jetlag/control/courant.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "problems/chains.hpp"
#include "problems/particles.hpp"
#include "problems/planets.hpp"
#include "studies/paper/struck_body.hpp"

namespace jetlag {

using problems::Problem;

namespace {

/// The end of a motion by Taylor's method, steps by Jorba and Zou, compensated sums.
State<double> accurate_end(const Problem& problem, int degree) {
  RandomTaylor::Options options;
  options.compensated = true;
  Lockstep run(std::make_unique<RandomTaylor>(problem.system, fixed_degree(degree),
                                              std::make_unique<JorbaZou>(), options));
  State<double> state = problem.start;
  const Report report = run.run(state, problem.until, {});
  if (report.outcome != Outcome::success)
    throw std::runtime_error(problem.name + ": no reference: " + report.message);
  return state;
}

/// Two degrees, each with steps of its own: they differ by the error of the worse.
void find_end(Problem& problem) {
  problem.end = accurate_end(problem, 24).position;
  problem.end_error = problems::distance(problem.system, *problem.end, accurate_end(problem, 18).position);
}

/// With so many periods: after whole ones it is where it began.
Problem kepler() {
  Problem problem = problems::planet(0.3);
  problem.until = 1000 * 2 * std::numbers::pi;
  problem.end = problem.start.position;
  return problem;
}

Problem henon_heiles() {
  Problem problem = problems::henon_heiles({0, 0}, {0.4, 0.3});
  problem.until = 1000;
  problem.largest_step = 1.24;
  find_end(problem);
  return problem;
}

Problem fput() {
  Problem problem = problems::fput();
  find_end(problem);
  return problem;
}

Problem of_built_in(const char* scene, const std::vector<std::string>& settings) {
  return problem_of(load_scene(scene, settings));
}

Problem body_of_friction(const char* friction) {
  return of_built_in("body",
                     {"particles=" + struck_body({}).dump(),
                      std::string(R"(forces=[{"type": "spring", "pairs": "edges", "stiffness": 5000.0},
                                            {"type": "drag", "coefficient": )") +
                          friction + "}]",
                      "until=0.5"});
}

}  // namespace

Problem problem_of(const Scene& scene) {
  Problem problem{*scene.system, scene.initial, scene.until};
  problem.name = problem.description = scene.name;
  const double omega = frequency_bound(problem.system);
  problem.largest_step = scene.fixed_step ? 4 * *scene.fixed_step : omega > 0 ? 2 / omega : scene.until / 64;
  find_end(problem);
  return problem;
}

const std::vector<TestProblemEntry>& test_problems() {
  static const std::vector<TestProblemEntry> all = {
      {"kepler", "a planet, e = 0.3, 1000 periods", kepler},
      {"henon_heiles", "Henon and Heiles, a regular orbit, t = 1000", henon_heiles},
      {"fput", "a chain of 32 masses, springs d + d^3, t = 496", fput},
      {"body", "a struck body of 4184 springs, no friction, t = 0.5 s",
       [] { return body_of_friction("0.0"); }},
      {"body_friction", "the same with friction 1", [] { return body_of_friction("1.0"); }},
      {"stiff_spot", "fourteen masses, one stiff spring", [] { return of_built_in("stiff_spot", {}); }},
      {"cloth", "a 20 x 20 cloth, held at two corners, t = 1 s",
       [] { return of_built_in("cloth", {"until=1.0"}); }},
  };
  return all;
}

}  // namespace jetlag
