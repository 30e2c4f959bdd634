// SPDX-License-Identifier: MIT
#pragma once
// The same motion by ADOL-C, a peer to compare with: y' = f(y) for y = (x, v), recorded once and expanded by
// its driver forode.

#if defined(JETLAG_HAVE_ADOLC)

#include <span>
#include <string>
#include <vector>

#include "problems.hpp"

namespace jetlag::bench {

class AdolC {
 public:
  /// Records the problem on an ADOL-C tape of that number, in memory.
  AdolC(const Problem& problem, short tape);

  /// Coefficients 0 .. degree of all positions: forode finds (x, v) up to degree - 1, then x_N = v_{N-1} / N.
  void expand(const State<double>& state, int degree);

  /// Coefficients of component c of the position of particle i.
  std::span<const double> series(int i, int c) const { return series_of(3 * i + c); }

 private:
  std::span<double> series_of(int row) { return {&coefficients_[row * (degree_ + 1)], degree_ + 1u}; }
  std::span<const double> series_of(int row) const {
    return {&coefficients_[row * (degree_ + 1)], degree_ + 1u};
  }

  short tape_;
  int unknowns_;  // of x and of v each
  int degree_ = 0;
  std::vector<double> coefficients_;  // [x, then v][order]
  std::vector<double*> rows_;
};

/// The recording of a problem by name, made once. All scenes are recorded at the first call, small ones first:
/// ADOL-C gives every tape room for as many variables as have ever been alive, and a small problem would pay for
/// a large one recorded before it.
AdolC& adolc(const std::string& problem);

}  // namespace jetlag::bench

#endif
