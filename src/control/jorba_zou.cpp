// SPDX-License-Identifier: MIT
#include "jetlag/control/jorba_zou.hpp"

#include <cmath>
#include <vector>

namespace jetlag {

int jorba_zou_degree(double tolerance) {
  if (!(tolerance > 0.0 && tolerance < 1.0))
    throw std::invalid_argument("tolerance must be in (0, 1), got " + std::to_string(tolerance));
  return std::max(2, static_cast<int>(std::ceil(1.0 - 0.5 * std::log(tolerance))));
}

namespace {

using Wide = long double;  // its range holds h^n; where it is that of a double, steps of 1e+-16 are the limit

/// The terms c_n h^n, n < q, against the last one: which is the largest, and whether  c_q (h / sigma)^q  is below it.
struct Terms {
  int largest = 0;
  bool met = true;
};
Terms terms_at(double h, std::span<const double> norms, int q, double sigma) {
  Wide power = 1, last = norms[q], most = 0;
  Terms terms;
  for (int n = 0; n < q; ++n) {
    if (const Wide term = norms[n] * power; term > most) {
      most = term;
      terms.largest = n;
    }
    power *= h;
    last *= Wide(h) / sigma;
  }
  terms.met = last <= most;
  return terms;
}

/// The smaller of h and  max_{n<q} (sigma^q c_n / c_q)^{1/(q-n)}.
double shortened(double h, std::span<const double> norms, int q, double sigma) {
  int n = 0;
  while (n < q && norms[n] == 0.0) ++n;
  if (n == q || norms[q] == 0.0 || (std::isfinite(h) && terms_at(h, norms, q, sigma).met)) return h;
  // The step of any n is at most that of the largest term at this step: n rises until it is the largest itself.
  for (;;) {
    const double log_step = (std::log2(norms[n]) - std::log2(norms[q]) + q * std::log2(sigma)) / (q - n);
    const double step = std::exp2(log_step);
    if (step >= h) return h;
    const int next = terms_at(step, norms, q, sigma).largest;
    if (next <= n) return step;
    n = next;
  }
}

}  // namespace

double jorba_zou_step(std::span<const double> norms, double max_step) {
  const int p = static_cast<int>(norms.size()) - 1;
  if (p < 1) throw std::invalid_argument("jorba_zou_step: coefficients 0 and 1 are needed at least");
  for (const double norm : norms)
    if (!std::isfinite(norm)) return 0.0;
  const double sigma = std::exp(-2.0 - 0.5 / std::max(1, p - 1));
  double h = max_step;
  for (int q = p; q >= std::max(1, p - 1); --q) h = shortened(h, norms, q, sigma);
  return h;
}

double JorbaZou::propose(const Prospect& prospect) {
  const Expansion<double>& series = prospect.series;
  const int p = std::min(prospect.law.max_degree(), series.order() - 1);
  std::vector<double> norms(p + 1);
  // The state and the forces in it: orders 0 to 2 of x, 0 and 1 of v. Those between them and the last two are read only
  // where these vanish.
  const auto shortened = [&](double h, int low, const auto& coefficient) {
    for (int k = 0; k <= p; ++k) norms[k] = k <= low || k >= p - 1 ? largest(coefficient(k)) : 0.0;
    if (std::all_of(norms.begin(), norms.begin() + std::min(low, p - 1) + 1,
                    [](double c) { return c == 0.0; }))
      for (int k = low + 1; k < p - 1; ++k) norms[k] = largest(coefficient(k));
    return jorba_zou_step(norms, h);
  };
  const double unit = series.time_unit();
  double h = max_step_ / unit;
  h = shortened(h, 2, [&](int k) { return series.position(k); });
  h = shortened(h, 1, [&](int k) { return series.velocity(k); });
  return h * unit;
}

}  // namespace jetlag
