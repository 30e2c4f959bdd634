// SPDX-License-Identifier: MIT
// All growths are computed from what a step departs from the exact flow,
//
//     D_K = e^{-z} R_K(z) - 1 = e^{-z} ( sum_{m<n<=K} (w_n - 1) z^n/n!  -  sum_{n>K} z^n/n! ),
//     E D_K = -e^{-z} sum_{n>N} z^n/n!,
//
// where the low orders, which cancel exactly, never appear: near 0 the sign of a growth of y^8/480, say, is not a matter
// of rounding.
#include "jetlag/truncation/stability.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

using Real = long double;
using Complex = std::complex<Real>;
using Matrix = Eigen::Matrix<Real, 2, 2>;

/// Growth is known for coupled sums.
void require_coupled(const TruncationLaw& law) {
  if (law.weighting() != Weighting::coupled_sum && !law.is_fixed())
    throw std::invalid_argument(law.name() +
                                ": stability is known for coupled sums only, not for single terms");
}

// ---- one eigenvalue ---------------------------------------------------------------------------------------

struct Departures {
  Complex mean;                              // E D_K
  std::vector<std::pair<Real, Complex>> of;  // P(K = k), D_k
};

Departures departures(const TruncationLaw& law, const Complex& z) {
  require_coupled(law);
  const int n = law.max_degree(), m = law.min_degree();
  std::vector<Complex> term(n + 1, Complex(1));
  for (int j = 1; j <= n; ++j) term[j] = term[j - 1] * z / static_cast<Real>(j);
  Complex rest = 0, next = term[n];
  for (int j = n + 1; std::abs(next) > 1e-21L * std::abs(rest); ++j) rest += next *= z / static_cast<Real>(j);
  // e^{-iy}, not e^{0-iy}: both have the same digits, and conjugates stay conjugates.
  const Complex back = std::polar(std::exp(-z.real()), -z.imag());
  Departures d{-back * rest, {}};
  std::vector<Complex> beyond(n + 2, rest);
  for (int k = n; k >= m; --k) beyond[k] = k == n ? rest : beyond[k + 1] + term[k + 1];
  Complex above = 0;
  for (int k = m; k <= n; ++k) {
    above += (1 / static_cast<Real>(law.at_least(k)) - 1) * term[k];
    if (const double p = law.exactly(k); p > 0) d.of.emplace_back(p, back * (above - beyond[k]));
  }
  return d;
}

/// log|1 + d|.
Real log_size(const Complex& d) {
  return std::norm(d) < 0.25L ? std::log1p(2 * d.real() + std::norm(d)) / 2 : std::log(std::abs(Real(1) + d));
}

/// log|1 + d| - Re d, for small d by its series -d^2/2 + d^3/3 - ...
Real log_size_beyond_linear(const Complex& d) {
  if (std::abs(d) > 0.01L) return log_size(d) - d.real();
  Complex sum = 0;
  for (int k = 12; k >= 2; --k) sum = (k % 2 == 0 ? Real(-1) : Real(1)) / k + d * sum;
  return (d * d * sum).real();
}

// ---- the matrix of `derivative` ---------------------------------------------------------------------------

/// One step of q'' = -q - c q' in (q, v), h in its units:  exact flow Q, and R_k - Q with P(K = k).
struct Steps {
  Matrix flow, mean;  // Q, E R_K - Q
  std::vector<std::pair<Real, Matrix>> of;
};

Steps steps(const TruncationLaw& law, Real frequency, Real damping, Real h) {
  require_coupled(law);
  const int n = law.max_degree(), m = law.min_degree();
  Matrix generator;  // of (frequency q, v), where its powers do not cancel
  generator << 0, frequency * h, -frequency * h, -damping * h;
  std::vector<Matrix> term{Matrix::Identity()};
  const Real norm = std::max({frequency * h, damping * h, std::numeric_limits<Real>::min()});
  Real size = 1;  // bounds what is left out
  for (int j = 1; j <= n || (j < 100'000 && size > 1e-30L); ++j) {
    term.push_back(term.back() * generator / static_cast<Real>(j));
    if (j > n) size *= 2 * norm / j;
  }
  std::vector<Matrix> from(term.size() + 1, Matrix::Zero());  // sum_{j>=n} term_j
  for (std::size_t j = term.size(); j-- > 0;) from[j] = from[j + 1] + term[j];
  Steps s{from[0], {}, {}};
  s.mean << -from[n + 1].row(0), -from[n].row(1);
  Matrix above = Matrix::Zero();
  for (int k = 0; k <= n; ++k) {
    const Real excess = 1 / static_cast<Real>(law.at_least(k)) - 1;
    above.row(0) += excess * term[k].row(0);
    if (k > 0) above.row(1) += excess * term[k - 1].row(1);
    if (const double p = law.exactly(k); k >= m && p > 0) {
      Matrix difference = above;
      difference.row(0) -= from[k + 1].row(0);
      difference.row(1) -= from[k].row(1);
      s.of.emplace_back(p, difference);
    }
  }
  return s;
}

Real det(const Matrix& m) { return m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0); }

/// log of the spectral radius of Q + E R - Q.   |lambda|^2 = det = 1 + tr(Q^T E) + det E where det Q = 1.
Real log_mean(const Steps& s, bool rotation) {
  const Matrix mean = s.flow + s.mean;
  const Real half_trace = mean.trace() / 2, determinant = det(mean);
  const Real discriminant = half_trace * half_trace - determinant;
  if (discriminant >= 0) return std::log(std::abs(half_trace) + std::sqrt(discriminant));
  return (rotation ? std::log1p((s.flow.transpose() * s.mean).trace() + det(s.mean))
                   : std::log(determinant)) /
         2;
}

/// What P -> E[R P R^T] adds to Q P Q^T.
Matrix added(const Steps& s, const Matrix& p) {
  const Matrix cross = s.mean * p * s.flow.transpose();
  Matrix sum = cross + cross.transpose();
  for (const auto& [probability, e] : s.of) sum += probability * (e * p * e.transpose());
  return sum;
}

/// The largest eigenvalue of a matrix whose spectral radius is one of its eigenvalues. Newton's method for det (x - A) from
/// above: to the right of all eigenvalues this and its derivatives are positive (Gauss, Lucas), so that x comes down
/// and stops, at the last, for rounding only.
Real spectral_radius(const Eigen::Matrix<Real, 3, 3>& a) {
  Real x = a.cwiseAbs().rowwise().sum().maxCoeff();
  for (int iteration = 0; iteration < 1000; ++iteration) {
    const Eigen::Matrix<Real, 3, 3> b = x * Eigen::Matrix<Real, 3, 3>::Identity() - a;
    const Real minor_0 = b(1, 1) * b(2, 2) - b(1, 2) * b(2, 1),
               minor_1 = b(0, 0) * b(2, 2) - b(0, 2) * b(2, 0),
               minor_2 = b(0, 0) * b(1, 1) - b(0, 1) * b(1, 0);
    const Real value = b(0, 0) * minor_0 - b(0, 1) * (b(1, 0) * b(2, 2) - b(1, 2) * b(2, 0)) +
                       b(0, 2) * (b(1, 0) * b(2, 1) - b(1, 1) * b(2, 0));
    const Real next = x - value / (minor_0 + minor_1 + minor_2);
    if (!(next < x)) break;
    x = next;
  }
  return x;
}

/// log of the largest eigenvalue of P -> E[R P R^T] = Q P Q^T + added(P), a real one (Perron, Frobenius: the map keeps
/// P >= 0). Where Q is a rotation by y, P = 1 + p with tr p = 0 and the eigenvalue 1 + mu follow from
///     mu = tr added(P) / 2,      (1 + mu) p - Q p Q^T = added(P) - mu:      Q p Q^T turns (p_11, p_12) by -2 y.
Real log_mean_square(const Steps& s, bool rotation) {
  if (rotation) {
    const Complex turn = std::pow(Complex(s.flow(0, 0), -s.flow(0, 1)), 2);
    Complex p = 0;
    Real mu = 0;
    for (int iteration = 0; iteration < 60; ++iteration) {
      Matrix whole;
      whole << 1 + p.real(), p.imag(), p.imag(), 1 - p.real();
      const Matrix a = added(s, whole);
      mu = a.trace() / 2;
      const Complex better = Complex((a(0, 0) - a(1, 1)) / 2, a(0, 1)) / (1 + mu - turn);
      const Real change = std::abs(better - p);
      p = better;
      if (!(std::abs(p) < 0.5L)) break;
      if (change < 1e-18L * std::abs(p)) return std::log1p(mu);
    }
  }
  Eigen::Matrix<Real, 3, 3> map;  // on (p_11, p_12, p_22)
  for (int column = 0; column < 3; ++column) {
    Matrix p = Matrix::Zero();
    p(column / 2, (column + 1) / 2) = p((column + 1) / 2, column / 2) = 1;
    const Matrix image = s.flow * p * s.flow.transpose() + added(s, p);
    map.col(column) << image(0, 0), image(0, 1), image(1, 1);
  }
  return std::log(spectral_radius(map));
}

// ---- limits -----------------------------------------------------------------------------------------------

/// The largest stable r before the first unstable one; 0 if the first stride is unstable already.
template <class Stable>
double first_exit(double stride, Stable stable) {
  if (!stable(stride)) return 0.0;
  double in = stride;
  while (stable(in + stride)) in += stride;  // ends: growths become those of |z|^N
  double out = in + stride;
  for (double middle = 0.5 * (in + out); in < middle && middle < out; middle = 0.5 * (in + out))
    (stable(middle) ? in : out) = middle;
  return in;
}

void require_motion(const Oscillator& oscillator) {
  const auto [frequency, damping] = oscillator;
  if (!(frequency >= 0 && damping >= 0 && std::isfinite(frequency) && std::isfinite(damping)) ||
      (frequency == 0 && damping == 0))
    throw std::invalid_argument("an oscillator's frequency and damping must be >= 0 and not both 0, got " +
                                shown(frequency) + " and " + shown(damping));
}

}  // namespace

double growth(const TruncationLaw& law, Growth of, std::complex<double> z) {
  const Real x = z.real();
  const Departures d = departures(law, Complex(x, z.imag()));
  if (of == Growth::of_mean) return static_cast<double>(x + log_size(d.mean));
  if (of == Growth::mean_square) {
    Real square = 0;
    for (const auto& [p, departure] : d.of) square += p * std::norm(departure);
    return static_cast<double>(x + std::log1p(2 * d.mean.real() + square) / 2);
  }
  // E log|1 + D| = Re E D + E(log|1 + D| - Re D), where the linear terms cancel among themselves exactly.
  Real linear = d.mean.real(), sum = 0;
  const bool small = std::ranges::all_of(d.of, [](const auto& a) { return std::abs(a.second) < 0.5L; });
  for (const auto& [p, departure] : d.of)
    sum += p * (small ? log_size_beyond_linear(departure) : log_size(departure));
  return static_cast<double>(x + (small ? linear : 0) + sum);
}

double growth(const TruncationLaw& law, Growth of, VelocitySeries velocity, const Oscillator& oscillator,
              double h) {
  require_motion(oscillator);
  const auto [frequency, damping] = oscillator;
  if (velocity == VelocitySeries::derivative) {
    if (of == Growth::almost_sure && !law.is_fixed())
      throw std::invalid_argument(
          "almost sure growth is known for velocities of their own series only: with `derivative` the steps "
          "of "
          "different degrees do not commute");
    const Steps s = steps(law, frequency, damping, h);
    return static_cast<double>(of == Growth::mean_square ? log_mean_square(s, damping == 0) / 2
                                                         : log_mean(s, damping == 0));
  }
  // lambda^2 + damping lambda + frequency^2 = 0.
  const double half = damping / 2;
  if (half < frequency)
    return growth(law, of,
                  h * std::complex<double>(-half, std::sqrt((frequency - half) * (frequency + half))));
  const double fast = half + std::sqrt((half - frequency) * (half + frequency));
  return std::max(growth(law, of, -h * fast), growth(law, of, -h * frequency * (frequency / fast)));
}

double stability_limit(const TruncationLaw& law, Growth of, std::complex<double> direction, double stride) {
  const double size = std::abs(direction);
  if (!(size > 0) || !std::isfinite(size) || direction.real() > 0)
    throw std::invalid_argument(
        "stability_limit: the direction must not be 0 nor to the right of the imaginary axis");
  direction = {direction.real() / size, direction.imag() / size};
  return first_exit(stride, [&](double r) { return growth(law, of, r * direction) <= 0; });
}

double stability_limit(const TruncationLaw& law, Growth of, VelocitySeries velocity,
                       const Oscillator& oscillator) {
  require_motion(oscillator);
  return first_exit(0x1p-8 / std::max(oscillator.frequency, oscillator.damping),
                    [&](double h) { return growth(law, of, velocity, oscillator, h) <= 0; });
}

double band_stability_limit(const TruncationLaw& law, VelocitySeries velocity, const Oscillator& fastest) {
  if (fastest.damping == 0)  // every frequency alike
    return stability_limit(law, Growth::mean_square, velocity, fastest);
  require_motion(fastest);
  constexpr int frequencies = 128;
  const double stride =
      std::max(1.0, law.max_degree() / 8.0) / 32 / std::max(fastest.frequency, fastest.damping);
  return first_exit(stride, [&](double h) {
    for (int i = frequencies; i > 0; --i)
      if (!(growth(law, Growth::mean_square, velocity, {fastest.frequency * i / frequencies, fastest.damping},
                   h) <= 0))
        return false;
    return true;
  });
}

}  // namespace jetlag
