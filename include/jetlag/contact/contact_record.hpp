// SPDX-License-Identifier: MIT
#pragma once
// What the contacts of a run amount to.

#include <cstdint>
#include <limits>
#include <vector>

namespace jetlag {

/// A stencil is a pair of features of a surface: two vertices, a vertex and an edge or a triangle, two edges. One whose gap is
/// below the thickness is active.
struct ContactRecord {
  std::uint64_t stencils_tested = 0;   // looked at in a step, all steps together
  std::uint64_t crossings_tested = 0;  // of them, those whose motion was searched for a first approach
  std::uint64_t looks = 0;             // at the whole surface, for the stencils that may come near
  std::uint64_t active_largest = 0;    // active at one time
  std::uint64_t begun = 0, ended = 0;  // times that a stencil became active, and that it was no longer

  struct Gap {
    double value = std::numeric_limits<double>::infinity();  // [m]
    double time = 0;                                         // [s]
    std::vector<int> particles{};                            // of the stencil
  };
  Gap smallest_gap;  // of active stencils, within the steps too: 1e-3 of it may be missed; infinite without any

  /// Of several contacts: sums, and the smallest gap; the largest numbers of active stencils may be of different times.
  ContactRecord& operator+=(const ContactRecord& other) {
    stencils_tested += other.stencils_tested;
    crossings_tested += other.crossings_tested;
    looks += other.looks;
    active_largest += other.active_largest;
    begun += other.begun;
    ended += other.ended;
    if (other.smallest_gap.value < smallest_gap.value) smallest_gap = other.smallest_gap;
    return *this;
  }
};

}  // namespace jetlag
