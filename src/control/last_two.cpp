// SPDX-License-Identifier: MIT
#include "jetlag/control/last_two.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jetlag {

namespace {

constexpr double log2_safety = -0.5145731728297583, log2_negligible = -19.931568569324174;  // of 0.7 and 1e-6
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

// In logarithms to the base 2, of which each size takes one.
double last_two_step(const LastTwoSizes& sizes, double tolerance) {
  for (const auto& pair : {sizes.first, sizes.last})
    for (double c : pair)
      if (!std::isfinite(c)) return 0.0;
  const double log_tolerance = std::log2(tolerance);
  const double first[2] = {std::log2(2 * sizes.first[0]), std::log2(6 * sizes.first[1])};  // -infinity for 0
  const double drift = (log2_negligible + log_tolerance - (first[0] - 1)) / 2;
  double log_h = infinity;
  for (int i = 0; i < 2; ++i) {
    const int k = sizes.degree - 1 + i;
    if (k < 1 || sizes.last[i] == 0) continue;
    const double last = std::log2(sizes.last[i]);
    log_h = std::min(log_h, (log_tolerance - last) / k + log2_safety);
    if (k <= 3) continue;
    const double force = last + std::log2(static_cast<double>(k * (k - 1)));
    const double reach = std::max((first[0] - force) / (k - 2), (first[1] - force) / (k - 3));
    log_h = std::min(log_h, std::max(drift, reach + log2_safety));
  }
  return std::exp2(log_h);
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
