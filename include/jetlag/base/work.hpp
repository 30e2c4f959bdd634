// SPDX-License-Identifier: MIT
#pragma once
// What integrating costs, in units that do not depend on the machine.

#include <cstdint>

#include "jetlag/base/outcome.hpp"

namespace jetlag {

/// What a run has cost so far.
struct Work {
  std::uint64_t steps = 0;
  std::uint64_t updates = 0;       // particles x steps, without the fixed ones
  std::uint64_t coefficients = 0;  // coefficients of positions beyond order 1, one for each moving particle
  std::uint64_t element_coefficients =
      0;                      // (element, order) pairs; a force evaluation is one for each element
  std::uint64_t degrees = 0;  // sum over updates of the degree used
  std::uint64_t rejected = 0;
  std::uint64_t wake_ups = 0;  // updates before their time, of clocks

  Work& operator+=(const Work& other) {
    steps += other.steps;
    updates += other.updates;
    coefficients += other.coefficients;
    element_coefficients += other.element_coefficients;
    degrees += other.degrees;
    rejected += other.rejected;
    wake_ups += other.wake_ups;
    return *this;
  }

  double mean_degree() const {
    return updates == 0 ? 0.0 : static_cast<double>(degrees) / static_cast<double>(updates);
  }
};

/// The report of a run, with the steps that it took by the work of its method.
template <class Run>
Report counted(const Work& work, const Run& run) {
  const std::uint64_t before = work.steps;
  Report report = run();
  report.steps = work.steps - before;
  return report;
}

}  // namespace jetlag
