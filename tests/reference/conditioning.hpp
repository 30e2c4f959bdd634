// SPDX-License-Identifier: MIT
#pragma once
// What rounding leaves of the digits of an initial value problem.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "problems/equations.hpp"
#include "problems/particles.hpp"
#include "problems/planets.hpp"
#include "problems/reference_values.hpp"
#include "studies/reference/reference_problems.hpp"

namespace jetlag::testing {

using namespace problems;

constexpr double eps = std::numeric_limits<double>::epsilon();

inline double largest(const std::vector<double>& numbers) {
  double most = 0;
  for (double x : numbers) most = std::max(most, std::abs(x));
  return most;
}

/// The largest difference from the first components, as far as they are known. Known in 80 bits: they have more digits.
inline double error(const std::vector<double>& end, const std::vector<long double>& known) {
  double most = end.size() < known.size() ? NAN : 0;
  for (std::size_t i = 0; i < std::min(end.size(), known.size()); ++i)
    most = std::max(most, static_cast<double>(std::abs(end[i] - known[i])));
  return most;
}

/// How much larger a relative disturbance arrives than it was, over 16 times at which it is made.
inline double growth(const ReferenceProblem& problem, const ReferenceSolution& solution, double size = 1e-9) {
  double most = 0;
  for (std::uint64_t part = 0; part < 16; ++part) {
    std::vector<double> end = problem.solve(20, {solution.steps * part / 16, size}).end;
    for (std::size_t i = 0; i < end.size(); ++i) end[i] -= solution.end[i];
    most = std::max(most, largest(end) / size);
  }
  return most;
}

/// Each step rounds every component by about eps/2, which arrives enlarged by `growth`: n steps walk at random, three
/// sigma of them are allowed; what is left out of the series at degree 20 is exp(-40) of a step, 50 times less. The end
/// of the interval is rounded too: eps T |y'|.
inline double rounding_tolerance(const ReferenceProblem& problem, const ReferenceSolution& solution,
                                 double size = 1e-9) {
  return eps * (3 * std::sqrt(static_cast<double>(solution.steps)) * growth(problem, solution, size) +
                problem.until * largest(solution.rate));
}

}  // namespace jetlag::testing
