// SPDX-License-Identifier: MIT
#include "studies/reference/reference_problems.hpp"

#include <memory>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "problems/chains.hpp"
#include "problems/equations.hpp"
#include "problems/particles.hpp"
#include "problems/planets.hpp"

namespace jetlag {

ReferenceProblem of_system(std::string name, const System<>& system, const std::vector<double>& start,
                           double until) {
  const int size = system.particles(), dimension = system.dimension();
  const auto each = [=, fixed = system.fixed()](auto&& rows, auto visit) {
    for (int i = 0; i < size; ++i)
      for (int c = 0; c < dimension; ++c)
        if (!fixed[i]) visit(rows(i, c));
  };
  const auto solve = [=](int degree, const Kick& kick) {
    State<> state{0.0, Coordinates<>::Zero(size, dimension), Coordinates<>::Zero(size, dimension)};
    auto next = start.begin();
    each(state.position, [&](double& x) { x = *next++; });
    each(state.velocity, [&](double& v) { v = *next++; });
    Lockstep run(taylor(system, degree, std::make_unique<JorbaZou>()));
    if (kick.size != 0) {
      RunOptions first;
      first.max_steps = kick.after_steps;
      run.run(state, until, first);
      kick.act_on(state.position.reshaped());
      kick.act_on(state.velocity.reshaped());
    }
    ReferenceSolution solution{run.run(state, until, {}), {}, {}, run.work().steps};
    Expansion<> series(system);
    series.start(state);
    series.grow();
    each(state.position, [&](double x) { solution.end.push_back(x); });
    each(state.velocity, [&](double v) { solution.end.push_back(v); });
    each(state.velocity, [&](double v) { solution.rate.push_back(v); });
    each(series.position(2), [&](double half) { solution.rate.push_back(2 * half); });
    return solution;
  };
  return {std::move(name), start, until, solve};
}

ReferenceProblem of_problem(std::string name, const problems::Problem& problem, double until) {
  std::vector<double> start;
  for (const auto* rows : {&problem.start.position, &problem.start.velocity})
    for (int i = 0; i < rows->rows(); ++i)
      for (int c = 0; c < rows->cols(); ++c)
        if (!problem.system.fixed()[i]) start.push_back((*rows)(i, c));
  return of_system(std::move(name), problem.system, start, until);
}

std::vector<ReferenceProblem> reference_problems() {
  using namespace problems;
  std::vector<ReferenceProblem> all;
  const double mu = 0.012277471;
  all.push_back(of_equations("arenstorf-A", arenstorf, {0.994, 0, 0, -2.00158510637908252240537862224},
                             17.0652165601579625588917206249, {mu}));
  all.push_back(of_equations("arenstorf-B", arenstorf, {0.994, 0, 0, -2.0317326295573368357302057924},
                             11.124340337266085134999734047, {mu}));
  for (const auto& [e, digits] :
       {std::pair(0.1, "0.1"), {0.3, "0.3"}, {0.5, "0.5"}, {0.7, "0.7"}, {0.9, "0.9"}})
    all.push_back(of_problem(std::string("kepler DETEST-D e=") + digits + " t=20", planet(e), 20));
  all.push_back(of_equations("lotka-volterra DETEST-B1 t=20", lotka_volterra, {1, 3}, 20));
  all.push_back(of_equations("euler rigid DETEST-B5 t=20", euler_rigid, {0, 1, 1}, 20, {1, -1, -0.51}));
  // Moments of inertia 1/2, 2, 3: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.10, no forces.
  all.push_back(of_equations("euler rigid HNW t=20", euler_rigid, {1, 0, 0.9}, 20, {-2, 1.25, -0.5}));
  all.push_back(of_equations("van der Pol DETEST-E2 t=20", van_der_pol, {2, 0}, 20));
  for (const auto& [until, digits] : {std::pair(10.0, "10"), {100.0, "100"}})
    all.push_back(of_problem(std::string("henon-heiles q=(0,.1) p=(.5,0) t=") + digits,
                             henon_heiles({0, 0.1}, {0.5, 0}), until));
  all.push_back(of_problem("pleiades t=3", pleiades(), 3));
  all.push_back(of_problem("figure-eight t=6.32591398", figure_eight(), 6.32591398));
  all.push_back(of_problem("pythagorean m=(3,4,5) t=10", three_bodies(), 10));
  all.push_back(
      of_equations("lorenz63 (10,28,8/3) u0=(0,1,1.05) t=5", lorenz, {0, 1, 1.05}, 5, {10, 28, 8.0 / 3.0}));
  all.push_back(of_equations("double pendulum m=l=1 g=9.81 th=(2,1) rest t=5", double_pendulum, {2, 1, 0, 0},
                             5, {9.81}));
  all.push_back(of_problem("FPUT-alpha N=32 a=0.25 q_j=sin(pi j/33) t=100", fput_alpha(), 100));
  all.push_back(of_problem("outer solar system GNI t=20000 d", outer_solar_system(), 20000));
  return all;
}

}  // namespace jetlag
