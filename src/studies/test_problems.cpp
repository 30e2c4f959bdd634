// SPDX-License-Identifier: MIT
#include "studies/test_problems.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "jetlag/control/courant.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/forces/drag.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "studies/reference_problems.hpp"
#include "studies/struck_body.hpp"

namespace jetlag {

namespace {

/// f = d + d^3, d = q_1 - q_0, q: displacements.         Source: the beta chain of Fermi, Pasta, Ulam, Tsingou 1955.
struct CubicSpring {
  static constexpr const char* name = "cubic_spring";
  static constexpr int participants = 2;
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return T(1.0 + d.squaredNorm()) * d;
  }

  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T s = d.squaredNorm();
    return T(0.5) * s + T(0.25) * (s * s);
  }
};

State<double> at_rest(const System<double>& system) {
  return {0.0, Coordinates<double>::Zero(system.particles(), system.dimension()),
          Coordinates<double>::Zero(system.particles(), system.dimension())};
}

/// The end of a motion by Taylor's method, steps by Jorba and Zou, compensated sums.
State<double> accurate_end(const TestProblem& problem, int degree) {
  RandomTaylor::Options options;
  options.compensated = true;
  Lockstep run(std::make_unique<RandomTaylor>(*problem.system, fixed_degree(degree),
                                              std::make_unique<JorbaZou>(), options));
  State<double> state = problem.initial;
  const Report report = run.run(state, problem.until, {});
  if (report.outcome != Outcome::success)
    throw std::runtime_error(problem.name + ": no reference: " + report.message);
  return state;
}

/// Two degrees, each with steps of its own: they differ by the error of the worse.
void find_end(TestProblem& problem) {
  problem.end = accurate_end(problem, 24);
  problem.end_error = distance(*problem.system, problem.end.position, accurate_end(problem, 18).position);
}

bool conserves_energy(const System<double>& system) {
  return std::ranges::all_of(system.elements(), [](const auto& elements) {
    return elements.count() == 0 || elements.law.energy.has_value();
  });
}

TestProblem kepler() {
  TestProblem problem;
  System<double> system(2, {1.0, 1.0});
  system.fix(0);
  system.add<Gravity>({{0, 1}}, {{1.0}});
  const double e = 0.3, period = 2 * std::numbers::pi;
  problem.initial = at_rest(system);
  problem.initial.position(1, 0) = 1 - e;
  problem.initial.velocity(1, 1) = std::sqrt((1 + e) / (1 - e));
  problem.until = 1000 * period;
  problem.largest_step = period / 14.7964875;  // 118.3719 / 8: no small multiple is a period
  problem.end = problem.initial;               // after whole periods
  problem.end_error = 0;
  problem.has_energy_error = true;
  problem.system = std::make_shared<const System<double>>(std::move(system));
  return problem;
}

TestProblem henon_heiles() {
  TestProblem problem;
  System<double> system(2, {1.0});
  system.add<HenonHeiles>({{0}}, {{}});
  problem.initial = at_rest(system);
  problem.initial.velocity << 0.4, 0.3;
  problem.until = 1000;
  problem.largest_step = 1.24;
  problem.has_energy_error = true;
  problem.system = std::make_shared<const System<double>>(std::move(system));
  find_end(problem);
  return problem;
}

TestProblem fput() {
  TestProblem problem;
  System<double> system(1, std::vector<double>(34, 1.0));
  system.fix(0);
  system.fix(33);
  std::vector<std::array<int, 2>> pairs;
  for (int j = 0; j < 33; ++j) pairs.push_back({j, j + 1});
  system.add<CubicSpring>(pairs, {{}});
  problem.initial = at_rest(system);
  for (int i = 1; i <= 32; ++i)
    problem.initial.position(i, 0) =
        0.1 * std::sin(2 * std::numbers::pi * i / 33) + 0.02 * std::sin(9 * std::numbers::pi * i / 33);
  problem.until = 496;
  problem.largest_step = 1.24;
  problem.has_energy_error = true;
  problem.system = std::make_shared<const System<double>>(std::move(system));
  find_end(problem);
  return problem;
}

TestProblem of_built_in(const char* scene, const std::vector<std::string>& settings) {
  return problem_of(load_scene(scene, settings));
}

TestProblem body_of_friction(const char* friction) {
  return of_built_in("body",
                     {"particles=" + struck_body({}).dump(),
                      std::string(R"(forces=[{"type": "spring", "pairs": "edges", "stiffness": 5000.0},
                                            {"type": "drag", "coefficient": )") +
                          friction + "}]",
                      "until=0.5"});
}

}  // namespace

double distance(const System<double>& system, const Coordinates<double>& x, const Coordinates<double>& y) {
  double sum = 0;
  int moving = 0;
  for (int i = 0; i < system.particles(); ++i)
    if (!system.fixed()[i]) {
      sum += (x.row(i) - y.row(i)).squaredNorm();
      ++moving;
    }
  return std::sqrt(sum / std::max(1, moving));
}

TestProblem problem_of(const Scene& scene) {
  TestProblem problem;
  problem.name = scene.name;
  problem.description = scene.name;
  problem.system = scene.system;
  problem.initial = scene.initial;
  problem.until = scene.until;
  const double omega = frequency_bound(*scene.system);
  problem.largest_step = scene.fixed_step ? 4 * *scene.fixed_step : omega > 0 ? 2 / omega : scene.until / 64;
  problem.has_energy_error = conserves_energy(*scene.system);
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
