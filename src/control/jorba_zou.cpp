// SPDX-License-Identifier: MIT
#include "jetlag/control/jorba_zou.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

template <int low>
double detail::log_jorba_zou_step(const EndsOfSeries<low>& ends, int p) {
  const double log_sigma = log_safety_of_jorba_zou(p) * std::numbers::log2e;
  const double logs[]{std::log2(ends.last[0]), std::log2(ends.last[1])};
  double longest[]{-std::numeric_limits<double>::infinity(), logs[0] - logs[1] + p * log_sigma};
  for (int n = 0; n < low; ++n) {
    const double log_of_term = std::log2(ends.first[n]);
    for (int i = 0; i < 2; ++i) {
      const int q = p - 1 + i;
      longest[i] = std::max(longest[i], (log_of_term - logs[i] + q * log_sigma) / (q - n));
    }
  }
  return std::min(longest[0], longest[1]);
}
template double detail::log_jorba_zou_step(const EndsOfSeries<2>&, int);
template double detail::log_jorba_zou_step(const EndsOfSeries<3>&, int);

double jorba_zou_step(std::span<const double> norms, double max_step) {
  const int p = static_cast<int>(norms.size()) - 1;
  if (p < 1) throw std::invalid_argument("jorba_zou_step: coefficients 0 and 1 are needed at least");
  for (const double norm : norms)
    if (!std::isfinite(norm)) return 0.0;
  const double log_sigma = log_safety_of_jorba_zou(p) * std::numbers::log2e;
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
  const double unit = prospect.series.time_unit();
  return std::min(jorba_zou_step_of(prospect.series, prospect.law.max_degree(), max_step_ / unit) * unit,
                  max_step_);
}

}  // namespace jetlag
