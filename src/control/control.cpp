// SPDX-License-Identifier: MIT
#include "jetlag/control/control.hpp"

#include <cmath>

#include "jetlag/base/text.hpp"
#include "jetlag/motion/expansion.hpp"

namespace jetlag {

namespace {

/// How the sizes of the coefficients go on beyond order r, in the unit of time of the series.
struct Continuation {
  double size, ratio;  // |c_{r+i}| ~ size ratio^i

  Continuation(const Expansion<double>& series, int r) {
    const auto c = [&](int k) { return k >= 0 ? series.position_norm(k) : 0.0; };
    const auto rate = [&](int k) {  // per order, up to k
      if (c(k) == 0.0) return 0.0;
      for (int back = 2; back <= k; ++back)
        if (c(k - back) > 0.0) return std::pow(c(k) / c(k - back), 1.0 / back);
      return 0.0;
    };
    const double before = rate(r - 1);
    ratio = c(r) > 0.5 * before * c(r - 1) ? rate(r) : before;
    size = std::max(c(r), ratio * c(r - 1));
  }
  /// |c_k| s^k for k = r + i: where s^k alone overflows, as for motions of 1e-16 radians a second, this does not.
  double term(int r, int k, double s) const { return size * std::pow(s, r) * std::pow(ratio * s, k - r); }
};

}  // namespace

int orders_for_errors(const TruncationLaw& law) {
  if (law.weighting() != Weighting::coupled_sum && !law.is_fixed())
    throw std::invalid_argument(law.name() +
                                ": the variance of single terms is not forecast; take another control");
  const int m = law.min_degree(), n = law.max_degree();
  return m == n ? n : std::min(n, std::max(m + 1, 4));
}

double largest_position_variance(const Prospect& prospect, double h) {
  const TruncationLaw& law = prospect.law;
  if (law.is_fixed()) return 0.0;
  const Expansion<double>& series = prospect.series;
  const int r = orders_for_errors(law);
  const double s = h / series.time_unit();
  double unread = 0.0, variance_of_unread = 0.0;
  if (r < law.max_degree()) {
    const Continuation beyond(series, r);
    for (int n = law.max_degree(); n > r; --n) {
      unread += beyond.term(r, n, s);
      variance_of_unread += (law.weight(n) - law.weight(n - 1)) * unread * unread;
    }
  }
  Coordinates<double> tail = Coordinates<double>::Zero(series.particles(), series.dimension());
  Coordinates<double> sum = tail;
  for (int n = r; n > law.min_degree(); --n) {
    tail += std::pow(s, n) * series.position(n);
    sum.array() += (law.weight(n) - law.weight(n - 1)) * (tail.array().abs() + unread).square();
  }
  return sum.size() == 0 ? 0.0 : sum.maxCoeff() + variance_of_unread;
}

double largest_position_bias(const Prospect& prospect, double h) {
  const Expansion<double>& series = prospect.series;
  const int n = prospect.law.max_degree(), r = orders_for_errors(prospect.law);
  const double s = h / series.time_unit();
  const auto term = [&](int k) {
    return k <= r ? series.position_norm(k) * std::pow(s, k) : Continuation(series, r).term(r, k, s);
  };
  return std::max(term(n), term(n - 1));
}

void require_positive(const char* what, double x, bool may_be_infinite) {
  if (!(x > 0.0) || (std::isinf(x) && !may_be_infinite))
    throw std::invalid_argument(std::string(what) + " must be > 0, got " + shown(x));
}

}  // namespace jetlag
