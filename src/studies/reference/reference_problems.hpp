// SPDX-License-Identifier: MIT
#pragma once
// Initial value problems whose end values are known to 20 digits, as a user of the library would write them: bodies and
// springs as systems, the others as first-order systems.

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "jetlag/integrators/first_order_taylor.hpp"
#include "problems/problem.hpp"

namespace jetlag {

/// Where a problem has ended.
struct ReferenceSolution {
  Report report;
  std::vector<double> end;   // in the order of the values
  std::vector<double> rate;  // its derivative
  std::uint64_t steps = 0;
};

/// A disturbance on the way, to see how much of it arrives: y_i grows by the fraction +-size of itself after some steps.
struct Kick {
  std::uint64_t after_steps = 0;
  double size = 0;

  template <class Numbers>
  void act_on(Numbers&& y) const {
    bool up = true;  // + + - - + + ...: neither a change of scale nor a symmetry of the problems below
    int i = 0;
    for (double& component : y) {
      component *= 1 + (up ? size : -size);
      if (++i % 2 == 0) up = !up;
    }
  }
};

struct ReferenceProblem {
  std::string name;           // of its values
  std::vector<double> start;  // in the order of the values
  double until;               // it starts at 0
  std::function<ReferenceSolution(int degree, const Kick& kick)> solve;
};

/// A first-order system, moved by Taylor's method with the steps of Jorba and Zou.
template <class F>
ReferenceProblem of_equations(std::string name, const F& f, std::vector<double> start, double until,
                              std::vector<double> parameters = {}) {
  const auto solve = [=](int degree, const Kick& kick) {
    const int size = static_cast<int>(start.size());
    FirstOrderTaylor<> method(f, size, {.parameters = parameters, .degree = degree});
    FirstOrderState<> state{0.0, start};
    if (kick.size != 0) {
      method.run(state, until, {.max_steps = kick.after_steps});
      kick.act_on(state.y);
    }
    ReferenceSolution solution{method.run(state, until), state.y, {}, method.work().steps};
    FirstOrderExpansion<> series(f, size, parameters);
    series.start(state.time, state.y);
    series.grow();
    for (int i = 0; i < size; ++i) solution.rate.push_back(series[i][1]);
    return solution;
  };
  return {std::move(name), start, until, solve};
}

/// Particles, likewise; start: of those that are not fixed, all positions, then all velocities. The fixed ones are at 0.
ReferenceProblem of_system(std::string name, const System<>& system, const std::vector<double>& start,
                           double until);

ReferenceProblem of_problem(std::string name, const problems::Problem& problem, double until);

/// All problems of the file of values.
std::vector<ReferenceProblem> reference_problems();

}  // namespace jetlag
