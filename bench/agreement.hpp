// SPDX-License-Identifier: MIT
#pragma once
// Do all engines compute the same coefficients? Asked before anything is timed.

#include <string>
#include <vector>

namespace jetlag::bench {

struct Agreement {
  static constexpr double allowed = 1e-9;

  std::string engine, problem;
  int degree;
  double difference;  // max over orders k of  max_i |x_k - y_k| / max_i |x_k|,  x the series of the tape

  bool holds() const { return difference <= allowed; }  // not when it is NaN
};

/// Every engine against the tape, on small scenes.
std::vector<Agreement> agreements();

}  // namespace jetlag::bench
