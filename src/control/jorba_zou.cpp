// SPDX-License-Identifier: MIT
#include "jetlag/control/jorba_zou.hpp"

#include <algorithm>
#include <array>
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

/// The smaller of h and  max_{first<=n<q} (bound c_n / c_q)^{1/(q-n)}.
double shortened(double h, std::span<const double> norms, int first, int q, double log_bound) {
  if (norms[q] == 0.0) return h;
  const double log_last = std::log2(norms[q]);
  double log_step = -std::numeric_limits<double>::infinity();
  for (int n = first; n < q; ++n)
    if (norms[n] != 0.0)
      log_step = std::max(log_step, (std::log2(norms[n]) - log_last + log_bound) / (q - n));
  return std::isfinite(log_step) ? std::min(h, std::exp2(log_step)) : h;
}

/// The same for the last two, q = p-1, p; or where they vanish for the last ones that stand in for them: a series ends early or
/// not at all, but cancellation may take some of it.   log_bound(q)
template <class Bound>
double shortened_by_last_two(double h, std::span<const double> norms, int first, const Bound& log_bound) {
  const int p = static_cast<int>(norms.size()) - 1;
  int last = p;
  if (norms[p] == 0.0 && norms[p - 1] == 0.0)
    for (int q = p - 2; q > p / 2 && last == p; --q)
      if (norms[q] != 0.0) last = q;
  for (int q = last; q >= std::max(1, last - 1); --q) h = shortened(h, norms, first, q, log_bound(q));
  return h;
}

bool all_finite(std::span<const double> norms) {
  return std::ranges::all_of(norms, [](double norm) { return std::isfinite(norm); });
}

double log2_safety(int p) { return log_safety_of_jorba_zou(p) * std::numbers::log2e; }

/// 1 / k for orders k.
double reciprocal(int k) {
  static const auto known = [] {
    std::array<double, 64> all{};
    for (int n = 1; n < 64; ++n) all[n] = 1.0 / n;
    return all;
  }();
  return k < 64 ? known[k] : 1.0 / k;
}

}  // namespace

double jorba_zou_step(std::span<const double> norms, double max_step) {
  const int p = static_cast<int>(norms.size()) - 1;
  if (p < 1) throw std::invalid_argument("jorba_zou_step: coefficients 0 and 1 are needed at least");
  if (!all_finite(norms)) return 0.0;
  const double log_sigma = log2_safety(p);
  return shortened_by_last_two(max_step, norms, 0, [=](int q) { return q * log_sigma; });
}

double log2_share_of_velocities(int p) { return p < 20 ? 0.0 : 4.0; }

double jorba_zou_step_of_sizes(std::span<const double> d, double max_step) {
  const int p = static_cast<int>(d.size()) - 2;
  if (!all_finite(d)) return 0.0;
  const double log_sigma = log2_safety(p);
  const auto log_bound = [=](int q) { return (q - 1) * log_sigma; };
  const double h = shortened_by_last_two(max_step, d, 0, log_bound);
  return shortened_by_last_two(h, d, 1, [&](int q) { return log_bound(q) + log2_share_of_velocities(p); });
}

double jorba_zou_step_of_ends(const EndsOfMotion& ends, int p, double max_step) {
  const double log_sigma = log2_safety(p), log_share = log2_share_of_velocities(p);
  const double position = std::log2(ends.position), velocity = std::log2(ends.velocity),
               acceleration = std::log2(ends.acceleration),
               last[]{std::log2(ends.last[0]), std::log2(ends.last[1])};
  double log_step = std::numeric_limits<double>::infinity();
  for (const int i : {0, 1}) {
    const int q = p + i;
    const double bound = (q - 1) * log_sigma - last[i];
    const auto step_to = [&](double first, int n) { return (first + bound) * reciprocal(q - n); };
    double by_velocities = std::max(step_to(velocity + log_share, 1), step_to(acceleration + log_share, 2)),
           by_all = std::max({step_to(position, 0), step_to(velocity, 1), step_to(acceleration, 2)});
    if (i == 1) {
      by_velocities = std::max(by_velocities, step_to(last[0] + log_share, p));
      by_all = std::max(by_all, step_to(last[0], p));
    }
    log_step = std::min({log_step, by_velocities, by_all});
  }
  return std::min(max_step, std::exp2(log_step));
}

double JorbaZou::propose(const Prospect& prospect) {
  const double unit = prospect.series.time_unit();
  return std::min(jorba_zou_step_of(prospect.series, prospect.law.max_degree(), max_step_ / unit) * unit,
                  max_step_);
}

}  // namespace jetlag
