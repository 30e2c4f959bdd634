// SPDX-License-Identifier: MIT
#pragma once
// The family of integrators: what each declares of itself, for the laws that all of them obey.

#include <cstdint>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "jetlag/integrators/integrator.hpp"

namespace jetlag::testing {

/// A method as it declares itself.
struct Method {
  std::string name;
  double order;                 // global; in mean square where it is random
  int exact_degree;             // solves motions of this degree in time exactly; -1: none, it is perturbed
  bool random = false;          // draws: laws about errors take the root mean square over seeds
  bool symmetric = false;       // a step, and a step with reversed velocities, return
  bool energy_bounded = false;  // over many periods
  bool random_length = false;   // the step is a mean
  double coarse_step =
      1.0 / 16;            // of the two that measure the order, the other is a quarter; 0: a test of its own
  double next_term = 0.1;  // what the next term of the error adds to the order at that step, at most
  std::function<std::unique_ptr<Integrator>(const System<double>& system, double step, std::uint64_t seed)>
      make;
};
inline void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

/// To add a member, add its line in methods.cpp: it inherits the laws of laws_test.cpp.
std::vector<Method> all_methods();

}  // namespace jetlag::testing
