// SPDX-License-Identifier: MIT
#include "jetlag/integrators/one_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace jetlag {

OneStep::OneStep(const System<double>& system, int order)
    : accelerations_(system), order_(order), moving_(moving_particles(system)) {}

double OneStep::fixed_length(const State<double>& from, double step, double limit, Report& report) {
  const double h = cropped(step, limit);
  if (advances(from.time, h)) return h;
  report = accelerations_.underflow(from, h);
  return 0.0;
}

double OneStep::chosen_length(const State<double>& from, double proposal, double limit, Report& report) {
  const double h = cropped(proposal, limit);
  const double least = h == limit ? 0.0 : 10 * std::numeric_limits<double>::epsilon() * std::abs(from.time);
  if (h > least && advances(from.time, h)) return h;
  if (report.outcome == Outcome::success) report = accelerations_.underflow(from, h);
  return 0.0;
}

double OneStep::step(State<double>& state, double limit, Report& report) {
  next_.drop_rests();
  const double h = advance(state, limit, next_, report);
  if (h == 0.0 || !all_finite(next_.position, next_.velocity, state.time, report)) return 0.0;
  next_.time = state.time;
  std::swap(before_, state);  // storage goes round: nothing is allocated
  std::swap(after_, next_);
  state = after_;
  length_ = h;

  ++work_.steps;
  work_.updates += moving_;
  work_.coefficients = coefficients() * moving_;
  work_.element_coefficients = accelerations_.element_coefficients() + other_element_coefficients_;
  work_.degrees += static_cast<std::uint64_t>(order_) * moving_;
  return h;
}

double largest(const Coordinates<double>& rows) {
  return rows.size() == 0 ? 0.0 : rows.cwiseAbs().maxCoeff();
}

double first_length(const State<double>& from, const Coordinates<double>& acceleration) {
  const auto time = [](double y, double rate) {
    return y > 0 && rate > 0 ? y / rate : std::numeric_limits<double>::infinity();
  };
  const double x = largest(from.position), v = largest(from.velocity), a = largest(acceleration);
  return 0.01 * std::min({time(x, v), time(v, a), std::sqrt(time(x, a))});
}

/// With m conditions on the left, p = sum_{k<m} L_k s^k + s^m q, and q is found from its Taylor coefficients at h, those
/// of (f - sum_{k<m} L_k s^k) / s^m.  In units of h: s = h theta.
Piece hermite_piece(double begin, double h, std::span<const Coordinates<double>> left,
                    std::span<const Coordinates<double>> right) {
  const int m = static_cast<int>(left.size()), n = static_cast<int>(right.size());
  const auto scaled = [h](std::span<const Coordinates<double>> derivatives) {
    std::vector<Coordinates<double>> c;
    double factor = 1;
    for (std::size_t k = 0; k < derivatives.size(); ++k) {
      c.push_back(factor * derivatives[k]);
      factor *= h / static_cast<double>(k + 1);
    }
    return c;
  };
  std::vector<Coordinates<double>> p = scaled(left), r = scaled(right);
  for (int k = 0; k < m; ++k) {  // minus the Taylor coefficients at 1 of L_k theta^k
    double binomial = 1;
    for (int j = 0; j < n && j <= k; ++j) {
      r[j] -= binomial * p[k];
      binomial *= static_cast<double>(k - j) / (j + 1);
    }
  }
  for (int divisions = 0; divisions < m; ++divisions)  // by theta = 1 + u
    for (int j = 1; j < n; ++j) r[j] -= r[j - 1];
  for (int k = n - 1; k >= 0; --k)  // about 0: Horner in theta - 1
    for (int j = k; j < n - 1; ++j) r[j] -= r[j + 1];
  p.insert(p.end(), r.begin(), r.end());

  Piece piece{begin, begin + h, {}, {}};
  double power = 1;
  for (std::size_t k = 0; k < p.size(); ++k) {
    piece.position.push_back(static_cast<int>(k) < m ? left[k] : Coordinates<double>(p[k] / power));
    power *= h;
  }
  double factorial = 1;
  for (int k = 2; k < m; ++k) {
    factorial *= k;
    piece.position[k] /= factorial;
  }
  for (std::size_t k = 1; k < p.size(); ++k)
    piece.velocity.push_back(static_cast<double>(k) * piece.position[k]);
  return piece;
}

}  // namespace jetlag
