// SPDX-License-Identifier: MIT
#include "jetlag/control/courant.hpp"

#include <cmath>
#include <complex>

namespace jetlag {

namespace {

/// E|R_K(iy)|^2 - 1, without the 1: with R = e^{iy} - T_N = sum_{j>N} (iy)^j / j!,
///     |T_N|^2 - 1 = |R|^2 - 2 Re(e^{-iy} R).
double mean_square_growth(const TruncationLaw& law, double y) {
  using Complex = std::complex<long double>;
  const int n = law.max_degree();
  std::vector<Complex> term(n + 1, Complex(1));
  for (int j = 1; j <= n; ++j) term[j] = term[j - 1] * Complex(0, y) / static_cast<long double>(j);
  Complex tail = 0;
  long double random = 0;
  for (int j = n; j > law.min_degree(); --j) {
    tail += term[j];
    random += static_cast<long double>(law.weight(j) - law.weight(j - 1)) * std::norm(tail);
  }
  Complex rest = 0, next = term[n];
  for (int j = n + 1; std::abs(next) > 1e-20L * std::abs(rest); ++j)
    rest += next *= Complex(0, y) / static_cast<long double>(j);
  const long double fixed =
      std::norm(rest) - 2 * (std::polar(1.0L, -static_cast<long double>(y)) * rest).real();
  return static_cast<double>(fixed + random);
}

}  // namespace

double imaginary_stability_limit(const TruncationLaw& law) {
  const double stride = 1e-3;
  const auto unstable = [&](double y) { return mean_square_growth(law, y) > 0; };
  if (unstable(stride)) return 0.0;
  double stable = stride;
  while (!unstable(stable + stride)) stable += stride;  // ends: |T_N(iy)| grows as y^N
  double limit = stable + stride;
  while (limit - stable > 1e-13 * limit) {
    const double middle = 0.5 * (stable + limit);
    (unstable(middle) ? limit : stable) = middle;
  }
  return stable;
}

double frequency_bound(const System<double>& system) {
  std::vector<double> load(system.particles(), 0.0);  // sum of stiffness / mass at a particle
  const auto inverse_mass = [&](int i) { return system.fixed()[i] ? 0.0 : 1.0 / system.mass()[i]; };
  const auto for_each_stiff = [&](auto use) {
    for (const auto& elements : system.elements()) {
      const auto& law = elements.law;
      if (law.stiffness_parameter < 0) continue;
      for (std::size_t e = 0; e < elements.count(); ++e)
        use(&elements.particles[e * law.participants], law.participants,
            elements.parameters[e * law.parameters.size() + law.stiffness_parameter]);
    }
  };
  for_each_stiff([&](const int* p, int participants, double k) {
    for (int i = 0; i < participants; ++i) load[p[i]] += k * inverse_mass(p[i]);
  });
  double bound = 0;
  for_each_stiff([&](const int* p, int participants, double) {
    double sum = 0;
    for (int i = 0; i < participants; ++i) sum += load[p[i]];
    bound = std::max(bound, sum);
  });
  return std::sqrt(bound);
}

Courant::Courant(std::unique_ptr<Control> inner, double safety, double limit, double omega)
    : inner_(std::move(inner)),
      largest_step_(omega > 0 ? safety * limit / omega : std::numeric_limits<double>::infinity()) {
  if (!(safety > 0.0 && safety <= 1.0))
    throw std::invalid_argument("courant must be in (0, 1], got " + std::to_string(safety));
  if (!(limit > 0.0))
    throw std::invalid_argument(
        "courant: this truncation is unstable for undamped oscillations at every step; take degree 3, 4, 7, "
        "8, 11, "
        "12, ... or, for a random degree, a min_degree of at least half of such a max_degree");
}

}  // namespace jetlag
