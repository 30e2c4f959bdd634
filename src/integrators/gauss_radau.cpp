// SPDX-License-Identifier: MIT
#include "jetlag/integrators/gauss_radau.hpp"

#include <algorithm>
#include <cmath>

#include "jetlag/series/error_free.hpp"

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
    : OneStep(system, 15), options_(options) {
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

bool GaussRadau::solve(const State<double>& from, double h, Report& report) {
  static const auto c = newton_to_powers();
  const auto& node = GaussRadau::node();
  constexpr double enough =
      1e-6;  // b_6 is divided differences: its rounding is far above that of a, and above 1e-6 a
             // the iteration does not contract
  double last_change = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 12; ++iteration) {
    double change = 0;
    for (int n = 1; n < nodes; ++n) {
      const State<double> stage = at(from, h, node[n]);
      if (!all_finite(stage.position, stage.velocity, from.time, report)) return false;
      Coordinates<double> a;
      if (!accelerations_(stage, a, report)) return false;
      largest_a_ = largest(a);
      Coordinates<double> g = (a - a_) / node[n];
      for (int j = 1; j < n; ++j) g = (g - g_[j - 1]) / (node[n] - node[j]);
      const Coordinates<double> difference = g - g_[n - 1];
      g_[n - 1] = g;
      for (int k = 0; k < n; ++k) b_[k] += c[n - 1][k] * difference;
      change = largest(difference);  // at the last node that of b_6
    }
    change = largest_a_ > 0 ? change / largest_a_ : 0.0;
    if (change < 1e-16 || (iteration > 1 && change >= last_change && last_change < enough)) return true;
    last_change = change;
  }
  if (last_change < enough) return true;
  report = {Outcome::not_converged,
            "gauss_radau: the predictor and corrector of the step of " + std::to_string(h) +
                " s from t = " + std::to_string(from.time) + " do not come together; take a shorter step",
            -1};
  return false;
}

/// The length at which b_6 would be as large as the tolerance allows.
double GaussRadau::wanted(double h) const {
  const double ratio = largest_a_ > 0 ? largest(b_[degree - 1]) / largest_a_ : 0.0;
  return h * std::pow(options_.tolerance / ratio, 1.0 / 7);  // infinite where b_6 = 0
}

double GaussRadau::advance(const State<double>& from, double limit, State<double>& to, Report& report) {
  if (!accelerations_(from, a_, report)) return 0.0;
  if (step_ == 0) step_ = options_.step ? *options_.step : first_length(from, a_);
  double proposal = std::min(step_, options_.max_step), h;
  while (true) {
    h = cropped(proposal, limit);
    if (!advances(from.time, h)) {
      if (report.outcome == Outcome::success) report = accelerations_.underflow(from, h);
      return 0.0;
    }
    predict(from, h);
    const bool solved = solve(from, h, report);
    if (!solved) last_length_ = 0;  // these b predict nothing
    if (options_.step) {
      if (!solved) return 0.0;
      break;
    }
    const double next = solved ? wanted(h) : 0.0;
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
  Piece piece{before().time,
              before().time + length(),
              {before().position, before().velocity, 0.5 * a_},
              {before().velocity, a_}};
  double power = 1;
  for (int k = 0; k < degree; ++k) {
    power *= length();
    piece.position.push_back(b_[k] / (power * (k + 2.0) * (k + 3.0)));
    piece.velocity.push_back(b_[k] / (power * (k + 2.0)));
  }
  return piece;
}

}  // namespace jetlag
