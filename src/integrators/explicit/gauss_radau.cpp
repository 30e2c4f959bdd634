// SPDX-License-Identifier: MIT
#include "jetlag/integrators/explicit/gauss_radau.hpp"

#include <algorithm>
#include <cmath>

#include "jetlag/base/error_free.hpp"
#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

constexpr int degree = GaussRadau::nodes - 1;  // of the acceleration in theta

/// theta (theta - h_1) .. (theta - h_n) = sum_k c[n][k] theta^(k+1)
std::array<std::array<double, degree>, degree> newton_to_powers() {
  std::array<std::array<double, degree>, degree> c{};
  c[0][0] = 1;
  for (int n = 1; n < degree; ++n)
    for (int k = 0; k <= n; ++k)
      c[n][k] = (k > 0 ? c[n - 1][k - 1] : 0.0) - GaussRadau::node()[n] * c[n - 1][k];
  return c;
}

/// By how much rounding of the accelerations, at most 1 each, can change b_6, their divided difference over the nodes:
///     b_6 = g_6 = sum_i a_i / product_{j != i} (h_i - h_j),   so   sum_i 1 / product_{j != i} |h_i - h_j|  (13 616).
double rounding_of_last_coefficient() {
  const auto& h = GaussRadau::node();
  double sum = 0;
  for (const double at : h) {
    double product = 1;
    for (const double other : h)
      if (other != at) product *= std::abs(at - other);
    sum += 1 / product;
  }
  return sum;
}

/// y + rest += change, keeping what does not fit a double.
void add(const Coordinates<double>& change, Coordinates<double>& y, Coordinates<double>& rest) {
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const auto sum = two_sum(y.data()[i], change.data()[i]);
    const auto whole = two_sum(sum.high, sum.low + rest.data()[i]);
    y.data()[i] = whole.high;
    rest.data()[i] = whole.low;
  }
}

}  // namespace

/// The zeros of P_7(x) + P_8(x), x = 2 h - 1. [RS15] table 1.
const std::array<double, GaussRadau::nodes>& GaussRadau::node() {
  static const std::array<double, nodes> h = {0.0,
                                              0.0562625605369221464656521910318,
                                              0.180240691736892364987579942780,
                                              0.352624717113169637373907769648,
                                              0.547153626330555383001448554766,
                                              0.734210177215410531523210605558,
                                              0.885320946839095768090359771030,
                                              0.977520613561287501891174488626};
  return h;
}

GaussRadau::GaussRadau(const System<double>& system, const Options& options)
    : OneStep(system, 15), options_(options), rounding_(system) {
  require_positive("tolerance", options.tolerance);
  require_positive("max_step", options.max_step, true);
  if (options.step) require_positive("step", *options.step);
}

/// The state at theta by the polynomial. [RS15] eq. 9 and 10.
State<double> GaussRadau::at(const State<double>& from, double h, double theta) const {
  State<double> state{from.time + theta * h, b_[degree - 1] / 72.0, b_[degree - 1] / 8.0};
  for (int k = degree - 2; k >= 0; --k) {
    state.position = theta * state.position + b_[k] / ((k + 2.0) * (k + 3.0));
    state.velocity = theta * state.velocity + b_[k] / (k + 2.0);
  }
  const double s = theta * h;
  state.position = from.position + s * (from.velocity + s * (0.5 * a_ + theta * state.position));
  state.velocity = from.velocity + s * (a_ + theta * state.velocity);
  return state;
}

/// The b of the last step about its end, in the new unit h, and what was missed of them last time: [RS15] eq. 13.
void GaussRadau::predict(const State<double>& from, double h) {
  const bool goes_on = last_length_ > 0 && end_.position == from.position && end_.velocity == from.velocity;
  const double q = goes_on ? h / last_length_ : 0.0;
  const bool known = goes_on && q <= 20;
  Coefficients next;
  double power = 1;
  for (int k = 0; k < degree; ++k) {
    power *= q;
    next[k] = Coordinates<double>::Zero(from.position.rows(), from.position.cols());
    if (!known) continue;
    double binomial = 1;  // C(j+1, k+1)
    for (int j = k; j < degree; ++j) {
      next[k] += power * binomial * b_[j];
      binomial *= (j + 2.0) / (j + 1.0 - k);
    }
  }
  for (int k = 0; k < degree; ++k) {
    const bool missed_known = known && guess_[k].size() > 0;
    b_[k] = missed_known ? Coordinates<double>(next[k] + (b_[k] - guess_[k])) : next[k];
    guess_[k] = known ? next[k] : Coordinates<double>();
  }
  // g from b, by the triangle of c.
  static const auto c = newton_to_powers();
  for (int n = degree - 1; n >= 0; --n) {
    g_[n] = b_[n];
    for (int m = n + 1; m < degree; ++m) g_[n] -= c[m][n] * g_[m];
  }
}

/// What of b_6 may be rounding in a step of length h: the iteration stands still there, and no shorter step has less.
double GaussRadau::rounding(const State<double>& from, double h) {
  static const double factor = rounding_of_last_coefficient();
  if (!last_rounding_) {
    const auto before = rounding_.element_coefficients();
    last_rounding_ = factor * largest(rounding_(from, h, 2, std::span(&a_, 1)).front());
    other_element_coefficients_ += rounding_.element_coefficients() - before;
  }
  return *last_rounding_;
}

bool GaussRadau::solve(const State<double>& from, double h, Report& report) {
  static const auto c = newton_to_powers();
  const auto& node = GaussRadau::node();
  // b_6 is divided differences: its rounding is far above that of a, and above 1e-6 a the iteration does not contract,
  // unless a itself is little more than rounding.
  const auto small = [&](double change) { return change < 1e-6 * largest_a_ || change <= rounding(from, h); };
  const double at_start = largest(a_);
  double last_change = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 12; ++iteration) {
    double change = 0;
    largest_a_ = at_start;
    for (int n = 1; n < nodes; ++n) {
      const State<double> stage = at(from, h, node[n]);
      if (!all_finite(stage.position, stage.velocity, from.time, report)) return false;
      Coordinates<double> a;
      if (!accelerations_(stage, a, report)) return false;
      largest_a_ = std::max(largest_a_, largest(a));
      Coordinates<double> g = (a - a_) / node[n];
      for (int j = 1; j < n; ++j) g = (g - g_[j - 1]) / (node[n] - node[j]);
      const Coordinates<double> difference = g - g_[n - 1];
      g_[n - 1] = g;
      for (int k = 0; k < n; ++k) b_[k] += c[n - 1][k] * difference;
      change = largest(difference);  // at the last node that of b_6
    }
    if (change <= 1e-16 * largest_a_) return true;
    if (iteration > 1 && change >= last_change && small(last_change)) return true;
    last_change = change;
  }
  if (small(last_change)) return true;
  report = {Outcome::not_converged,
            "gauss_radau: the predictor and corrector of the step of " + shown(h) +
                " s from t = " + shown(from.time) + " do not come together; take a shorter step",
            -1};
  return false;
}

/// The length at which b_6 would be as large as the tolerance allows, or as its own rounding. Without the latter a step
/// whose b_6 is rounding, the same for all lengths, would ask for a shorter one for ever. It costs no accuracy. In a
/// motion of frequency w, b_6 is some (w h)^7 / 7! of a, and the quadrature leaves out of the velocity
///     8 7!^4 / (2 15!^3) (w h)^15 = 1.2e-21 (w h)^15 = 3e-14 w h (b_6 / a)^2   of h a,
/// where b_6 = L da is allowed, L = 13 616:  5e-6 w h (da / a) of da, less than the rounding da of a itself.
double GaussRadau::wanted(const State<double>& from, double h) {
  const double last = largest(b_[degree - 1]);
  double allowed = options_.tolerance * largest_a_;
  if (last > allowed) allowed = std::max(allowed, rounding(from, h));
  return last > 0 ? h * std::pow(allowed / last, 1.0 / 7) : std::numeric_limits<double>::infinity();
}

double GaussRadau::advance(const State<double>& from, double limit, State<double>& to, Report& report) {
  if (!accelerations_(from, a_, report)) return 0.0;
  if (step_ == 0) step_ = options_.step ? *options_.step : first_length(from, a_);
  double proposal = std::min(step_, options_.max_step), h;
  while (true) {
    h = chosen_length(from, proposal, limit, report);
    if (h == 0.0) return 0.0;
    last_rounding_.reset();
    predict(from, h);
    const bool solved = solve(from, h, report);
    if (!solved) last_length_ = 0;  // these b predict nothing
    if (options_.step) {
      if (!solved) return 0.0;
      break;
    }
    const double next = solved ? wanted(from, h) : 0.0;
    if (next >= 0.25 * h) {
      step_ = std::max(std::min(next, 4 * h), h < proposal ? step_ : 0.0);
      report = {};
      break;
    }
    ++work_.rejected;
    last_length_ = 0;
    proposal = std::max(next, 0.1 * h);
  }

  const Coordinates<double> zero = Coordinates<double>::Zero(from.position.rows(), from.position.cols());
  const State<double> change = at({0.0, zero, zero}, h, 1.0);  // without h v_0
  to = from;
  for (auto* rest : {&to.position_rest, &to.velocity_rest})
    if (rest->size() == 0) rest->setZero(from.position.rows(), from.position.cols());
  to.position_rest += h * to.velocity_rest;
  add(h * from.velocity + change.position, to.position, to.position_rest);
  add(change.velocity, to.velocity, to.velocity_rest);
  last_length_ = h;
  end_ = to;
  return h;
}

Piece GaussRadau::piece() const {
  Piece piece{before().time, before().time + length()};
  piece.position.push_back(before().position);
  piece.position.push_back(before().velocity);
  piece.position.push_back(0.5 * a_);
  piece.velocity.push_back(before().velocity);
  piece.velocity.push_back(a_);
  double power = 1;
  for (int k = 0; k < degree; ++k) {
    power *= length();
    piece.position.push_back(b_[k] / (power * (k + 2.0) * (k + 3.0)));
    piece.velocity.push_back(b_[k] / (power * (k + 2.0)));
  }
  return piece;
}

}  // namespace jetlag
