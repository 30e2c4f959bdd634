// SPDX-License-Identifier: MIT
#include "jetlag/control/jorba_zou.hpp"

#include <cmath>

namespace jetlag {

int jorba_zou_degree(double tolerance) {
  if (!(tolerance > 0.0 && tolerance < 1.0))
    throw std::invalid_argument("tolerance must be in (0, 1), got " + std::to_string(tolerance));
  return std::max(2, static_cast<int>(std::ceil(1.0 - 0.5 * std::log(tolerance))));
}

double JorbaZou::propose(const Prospect& prospect) {
  const Expansion<double>& series = prospect.series;
  const int p = std::min(prospect.law.max_degree(), series.order() - 1);
  const auto radius = [p](const auto& coefficient) {
    const double scale = std::max(1.0, largest(coefficient(0)));
    double rho = std::numeric_limits<double>::infinity();
    for (int k = std::max(1, p - 1); k <= p; ++k) {
      const double size = largest(coefficient(k));
      if (size > 0.0) rho = std::min(rho, std::pow(scale / size, 1.0 / k));
    }
    return rho;
  };
  const double rho = std::min(radius([&](int k) { return series.position(k); }),
                              radius([&](int k) { return series.velocity(k); }));
  return std::min(max_step_, rho * std::exp(-2.0 - 0.7 / std::max(1, p - 1)));
}

}  // namespace jetlag
