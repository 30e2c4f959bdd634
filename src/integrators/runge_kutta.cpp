// SPDX-License-Identifier: MIT
#include "jetlag/integrators/runge_kutta.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace jetlag {

namespace {

/// sum_i w_i k_i
Coordinates<double> weighted(const std::vector<double>& w, const std::vector<Coordinates<double>>& k) {
  Coordinates<double> sum = Coordinates<double>::Zero(k[0].rows(), k[0].cols());
  for (std::size_t i = 0; i < w.size(); ++i)
    if (w[i] != 0) sum += w[i] * k[i];
  return sum;
}

}  // namespace

std::vector<double> RungeKuttaTable::c() const {
  std::vector<double> c;
  for (const auto& row : a) c.push_back(std::accumulate(row.begin(), row.end(), 0.0));
  return c;
}

RungeKutta::RungeKutta(const System<double>& system, const RungeKuttaTable& table, double step)
    : OneStep(system, table.order),
      table_(table),
      c_(table.c()),
      step_(step),
      v_(table.stages()),
      a_(table.stages()),
      of_piece_(system) {
  require_positive("step", step);
}

RungeKutta::RungeKutta(const System<double>& system, const RungeKuttaTable& table,
                       const EmbeddedControl& control)
    : RungeKutta(system, table, 1.0) {
  require_positive("tolerance", control.tolerance);
  require_positive("max_step", control.max_step, true);
  if (table.error.empty())
    throw std::invalid_argument(std::string(table.name) +
                                ": no estimate of the error belongs to it; give a fixed step");
  control_ = control;
  step_ = 0;
}

/// One step of length h; the stages stay in v_ and a_, and those before `first` are known.
bool RungeKutta::attempt(const State<double>& from, double h, int first, State<double>& to, Report& report) {
  State<double> stage;
  for (int i = first; i < table_.stages(); ++i) {
    stage.time = from.time + c_[i] * h;
    stage.position = from.position;
    stage.velocity = from.velocity;
    for (int j = 0; j < i; ++j)
      if (const double w = h * table_.a[i][j]; w != 0) {
        stage.position += w * v_[j];
        stage.velocity += w * a_[j];
      }
    if (!all_finite(stage.position, stage.velocity, from.time, report)) return false;
    if (!accelerations_(stage, a_[i], report)) return false;
    v_[i] = stage.velocity;
  }
  if (table_.a.back() == std::vector<double>(table_.b.begin(), table_.b.end() - 1) && table_.b.back() == 0) {
    to.position = std::move(stage.position);  // first same as last: the next step begins with this stage
    to.velocity = std::move(stage.velocity);
  } else {
    to.position = from.position + h * weighted(table_.b, v_);
    to.velocity = from.velocity + h * weighted(table_.b, a_);
  }
  return all_finite(to.position, to.velocity, from.time, report);
}

double RungeKutta::error_ratio(const State<double>& from, double h, const State<double>& to) const {
  // Of two estimates e5 and e3 of different orders:  e5 e5 / sqrt(e5^2 + e3^2 / 100).
  const auto error = [&](const std::vector<Coordinates<double>>& k) {
    const double e = largest(weighted(table_.error, k));
    if (table_.second_error.empty() || e == 0) return h * e;
    return h * e * (e / std::hypot(e, 0.1 * largest(weighted(table_.second_error, k))));
  };
  const auto ratio = [](double e, double scale) { return e == 0 ? 0.0 : e / scale; };
  const double x = std::max({largest(from.position), largest(to.position), h * largest(from.velocity)}),
               v = std::max({largest(from.velocity), largest(to.velocity), h * largest(a_[0])});
  return std::max(ratio(error(v_), x), ratio(error(a_), v)) / control_->tolerance;
}

double RungeKutta::advance(const State<double>& from, double limit, State<double>& to, Report& report) {
  if (!control_) {
    const double h = fixed_length(from, step_, limit, report);
    return h != 0.0 && attempt(from, h, 0, to, report) ? h : 0.0;
  }
  if (!accelerations_(from, a_[0], report)) return 0.0;
  v_[0] = from.velocity;
  if (step_ == 0) step_ = first_length(from, a_[0]);
  double proposal = std::min(step_, control_->max_step);
  for (bool rejected = false;; rejected = true) {
    const double h = cropped(proposal, limit);
    if (!advances(from.time, h)) {
      if (report.outcome == Outcome::success) report = accelerations_.underflow(from, h);
      return 0.0;
    }
    double ratio = std::numeric_limits<double>::infinity();
    if (attempt(from, h, 1, to, report)) {
      report = {};
      ratio = error_ratio(from, h, to);
    }
    const double factor = std::clamp(0.9 * std::pow(ratio, -1.0 / table_.error_order), 0.2, 6.0);
    if (ratio <= 1) {
      // A last step that was cropped says little of the next; after a rejection no step grows.
      step_ = std::max(h * (rejected ? std::min(factor, 1.0) : factor), h < proposal ? step_ : 0.0);
      return h;
    }
    ++work_.rejected;
    proposal = h * std::min(std::isnan(factor) ? 0.2 : factor, 0.9);
  }
}

Piece RungeKutta::piece() const {
  const auto ends = [&](State<double> state, double time) {
    state.time = time;
    std::vector<Coordinates<double>> d(table_.order < 6 ? 1 : 2);
    Report report;
    if (!of_piece_(state, d, report)) d.clear();
    d.insert(d.begin(), {state.position, state.velocity});
    return d;
  };
  const double begin = before().time;
  const auto right = ends(after(), begin + length()), left = ends(before(), begin);
  return hermite_piece(begin, length(), left, right);
}

}  // namespace jetlag
