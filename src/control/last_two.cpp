// SPDX-License-Identifier: MIT
#include "jetlag/control/last_two.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jetlag {

namespace {

constexpr double safety = 0.7, negligible = 1e-6;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// (a / b)^{1/n}; infinity for b = 0.
double root(double a, double b, int n) {
  return b == 0 ? infinity : std::exp2((std::log2(a) - std::log2(b)) / n);
}

}  // namespace

double last_two_step(const LastTwoSizes& sizes, double tolerance) {
  for (const auto& pair : {sizes.first, sizes.last})
    for (double c : pair)
      if (!std::isfinite(c)) return 0.0;
  const double drift = root(negligible * tolerance, sizes.first[0], 2);
  double h = infinity;
  for (int i = 0; i < 2; ++i) {
    const int k = sizes.degree - 1 + i;
    if (k < 1) continue;
    h = std::min(h, safety * root(tolerance, sizes.last[i], k));
    double reach = 0;
    for (int q = 2; q < 4; ++q)
      reach = std::max(reach, root(q * (q - 1) * sizes.first[q - 2], k * (k - 1) * sizes.last[i], k - q));
    if (k > 3) h = std::min(h, std::max(drift, safety * reach));
  }
  return h;
}

LastTwo::LastTwo(double tolerance, double max_step) : tolerance_(tolerance), max_step_(max_step) {
  require_positive("tolerance", tolerance);
  require_positive("max_step", max_step, true);
}

double LastTwo::propose(const Prospect& prospect) {
  const Expansion<double>& series = prospect.series;
  const double unit = series.time_unit();
  const int degree = prospect.law.max_degree();
  const int orders[4] = {2, 3, degree - 1, degree};
  double h = max_step_ / unit;
  for (int i = 0; i < series.particles(); ++i) {
    double size[4];
    for (int j = 0; j < 4; ++j)
      size[j] = orders[j] < 0 || orders[j] > series.order()
                    ? 0.0
                    : series.position(orders[j]).row(i).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    h = std::min(h, last_two_step({degree, {size[0], size[1]}, {size[2], size[3]}}, tolerance_));
  }
  return std::min(h * unit, max_step_);
}

}  // namespace jetlag
