// SPDX-License-Identifier: MIT
#include "jetlag/control/jorba_zou.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "jetlag/base/text.hpp"
#include "jetlag/motion/expansion.hpp"

namespace jetlag {

int jorba_zou_degree(double tolerance) {
  if (!(tolerance > 0.0 && tolerance < 1.0))
    throw std::invalid_argument("tolerance must be in (0, 1), got " + shown(tolerance));
  return std::max(2, static_cast<int>(std::ceil(1.0 - 0.5 * std::log(tolerance))));
}

namespace {

/// The smaller of h and  max_{n<q} (sigma^q c_n / c_q)^{1/(q-n)}.
double shortened(double h, std::span<const double> norms, int q, double log_sigma) {
  if (norms[q] == 0.0) return h;
  const double log_last = std::log2(norms[q]);
  double log_step = -std::numeric_limits<double>::infinity();
  for (int n = 0; n < q; ++n)
    if (norms[n] != 0.0)
      log_step = std::max(log_step, (std::log2(norms[n]) - log_last + q * log_sigma) / (q - n));
  return std::isfinite(log_step) ? std::min(h, std::exp2(log_step)) : h;
}

}  // namespace

double jorba_zou_step(std::span<const double> norms, double max_step) {
  const int p = static_cast<int>(norms.size()) - 1;
  if (p < 1) throw std::invalid_argument("jorba_zou_step: coefficients 0 and 1 are needed at least");
  for (const double norm : norms)
    if (!std::isfinite(norm)) return 0.0;
  const double log_sigma = (-2.0 - 0.5 / std::max(1, p - 1)) * std::numbers::log2e;
  // A series ends early or not at all: where the last two vanish, as cancellation may have it, others stand in for them.
  int last = p;
  if (norms[p] == 0.0 && norms[p - 1] == 0.0)
    for (int q = p - 2; q > p / 2 && last == p; --q)
      if (norms[q] != 0.0) last = q;
  double h = max_step;
  for (int q = last; q >= std::max(1, last - 1); --q) h = shortened(h, norms, q, log_sigma);
  return h;
}

double JorbaZou::propose(const Prospect& prospect) {
  const Expansion<double>& series = prospect.series;
  const int p = std::min(prospect.law.max_degree(), series.order() - 1);
  norms_.resize(p + 1);
  const std::span<double> norms(norms_);
  // The state and the forces in it: orders 0 to 2 of x, 0 and 1 of v. Those between them and the last two are read only
  // where these vanish.
  const auto shortened = [&](double h, int low, const auto& coefficient) {
    for (int k = 0; k <= p; ++k) norms[k] = k <= low || k >= p - 1 ? coefficient(k) : 0.0;
    const auto vanish = [&](int first, int last) {
      return std::all_of(norms.begin() + first, norms.begin() + last + 1, [](double c) { return c == 0.0; });
    };
    if (vanish(0, std::min(low, p - 1)) || vanish(std::max(0, p - 1), p))
      for (int k = low + 1; k < p - 1; ++k) norms[k] = coefficient(k);
    return jorba_zou_step(norms, h);
  };
  const double unit = series.time_unit();
  double h = max_step_ / unit;
  h = shortened(h, 2, [&](int k) { return series.position_norm(k); });
  h = shortened(h, 1, [&](int k) { return series.velocity_norm(k); });
  return std::min(h * unit, max_step_);
}

}  // namespace jetlag
