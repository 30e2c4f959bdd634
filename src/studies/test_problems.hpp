// SPDX-License-Identifier: MIT
#pragma once
// Problems on which methods are compared: a system, where it starts, and where it ends to many digits.

#include <memory>
#include <string>
#include <vector>

#include "jetlag/model/system.hpp"
#include "jetlag/scenes/scene.hpp"

namespace jetlag {

struct TestProblem {
  std::string name, description;
  std::shared_ptr<const System<double>> system;
  State<double> initial;
  double until;                   // [s]
  double largest_step;            // [s]: where a study of fixed steps begins
  State<double> end;              // at `until`
  double end_error;               // of `end`, an estimate: root mean square over particles [m]
  bool has_energy_error = false;  // whether energy is conserved
};

/// Names and descriptions of the problems that `test_problem` knows.
struct TestProblemEntry {
  const char *name, *description;
  TestProblem (*make)();
};
const std::vector<TestProblemEntry>& test_problems();

/// The motion of a scene, its method aside.
TestProblem problem_of(const Scene& scene);

/// sqrt(mean_i |x_i - y_i|^2) over the particles that are not fixed [m].
double distance(const System<double>& system, const Coordinates<double>& x, const Coordinates<double>& y);

}  // namespace jetlag
