// SPDX-License-Identifier: MIT
#include "jetlag/control/control.hpp"

#include <cmath>

namespace jetlag {

double largest_position_variance(const Prospect& prospect, double h) {
  const TruncationLaw& law = prospect.law;
  const Expansion<double>& series = prospect.series;
  Coordinates<double> tail = Coordinates<double>::Zero(series.particles(), series.dimension());
  Coordinates<double> sum = tail;
  for (int n = law.max_degree(); n > law.min_degree(); --n) {
    tail += std::pow(h / series.time_unit(), n) * series.position(n);
    sum += (law.weight(n) - law.weight(n - 1)) * tail.cwiseAbs2();
  }
  return sum.size() == 0 ? 0.0 : sum.maxCoeff();
}

double largest_position_bias(const Prospect& prospect, double h) {
  const int n = prospect.law.max_degree();
  const double s = h / prospect.series.time_unit();
  return std::max(largest(prospect.series.position(n)) * std::pow(s, n),
                  largest(prospect.series.position(n - 1)) * std::pow(s, n - 1));
}

void require_positive(const char* what, double x, bool may_be_infinite) {
  if (!(x > 0.0) || (std::isinf(x) && !may_be_infinite))
    throw std::invalid_argument(std::string(what) + " must be > 0, got " + std::to_string(x));
}

}  // namespace jetlag
