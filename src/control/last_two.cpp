// SPDX-License-Identifier: MIT
#include "jetlag/control/last_two.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "jetlag/motion/expansion.hpp"

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

LastTwoAllows::LastTwoAllows(int degree, double tolerance, double h)
    : degree_(degree), tolerance_(tolerance), h_(h), s_(h / 0.7) {
  in_range_ = true;
  for (int i = 0; i < 2; ++i) {
    power_[i] = std::pow(s_, degree - 1 + i);
    in_range_ = in_range_ && std::isnormal(power_[i]);
  }
}

bool LastTwoAllows::operator()(const LastTwoSizes& c) const {
  if (!in_range_ || c.degree != degree_) return last_two_step(c, tolerance_) >= h_;
  const bool drifts = c.first[0] * h_ * h_ <= 1e-6 * tolerance_;
  const double force = s_ * s_ * std::max(2 * c.first[0], 6 * c.first[1] * s_);
  for (int i = 0; i < 2; ++i) {
    const int k = degree_ - 1 + i;
    const double term = c.last[i] * power_[i];
    if (k >= 1 && !(term <= tolerance_)) return false;
    if (k > 3 && !drifts && !(k * (k - 1) * term <= force)) return false;
  }
  return true;
}

double LastTwo::propose(const Prospect& prospect) {
  const Expansion<double>& series = prospect.series;
  const double unit = series.time_unit();
  const int degree = prospect.law.max_degree();
  const auto rows = [&](int k) { return series.position(std::clamp(k, 0, series.order())); };
  const CoefficientView<double> c[4] = {rows(2), rows(3), rows(degree - 1), rows(degree)};
  const auto size = [&](int j, int i) {
    double most = 0;
    for (int d = 0; d < series.dimension(); ++d) {
      const double x = std::abs(c[j](i, d));
      if (x != x) return x;
      most = std::max(most, x);
    }
    return most;
  };
  double h = max_step_ / unit;
  LastTwoAllows allowed(degree, tolerance_, h);
  for (int i = 0; i < series.particles(); ++i) {
    LastTwoSizes sizes{degree, {size(0, i), series.order() < 3 ? 0.0 : size(1, i)}, {size(2, i), size(3, i)}};
    if (sizes.last[0] == 0 && sizes.last[1] == 0)
      stand_in(sizes, [&](int k) { return series.position(k).row(i).cwiseAbs().maxCoeff(); });
    if (std::isfinite(h) && allowed(sizes)) continue;
    const double own = last_two_step(sizes, tolerance_);
    if (!(own < h)) continue;
    h = own;
    allowed = LastTwoAllows(degree, tolerance_, h);
  }
  return std::min(h * unit, max_step_);
}

}  // namespace jetlag
