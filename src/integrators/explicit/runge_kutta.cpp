// SPDX-License-Identifier: MIT
#include "jetlag/integrators/explicit/runge_kutta.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
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
      rounding_(system),
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

/// The error over what is allowed of it. The estimates h sum_i e_i v_i and h sum_i e_i a_i contain the roundings dv and
/// da of the stages, independent of one another: h w dv and h w da, w^2 = sum_i e_i^2. These do not fall with the
/// tolerance, and da falls with nothing. Where the motion is small against positions (rest, a far origin) the tolerance
/// times the velocity is below that, and no step would be short enough. So they are allowed:
///     |e_x| <= (tolerance + eps) X + |h w dv|,   |e_v| <= (tolerance + eps) V + |h w da|,   dv = n eps V + h da,
/// n = sqrt(s): a stage is a sum of at most s terms, each rounded to eps X at most, with a deviation of
/// eps X / sqrt(12), and n / 2 to n of eps X are two to three deviations of the sum. Where two estimates make the
/// error, the allowance is made in the same way of h w da and the second one, so that the first may be h w da alone.
/// da costs an evaluation. It is measured only where the step would shrink and it can matter: steps are stable within
/// |h lambda| < s (dopri5: 3.4 < 7, dop853: 6.8 < 12), so h^2 |da/dx| < s^2 and da <= s^2 n eps (X/h^2 + V/h) with
/// forces that depend on velocities; |t| A / h is added for the time.
double RungeKutta::error_ratio(const State<double>& from, double h, const State<double>& to) {
  struct Estimate {
    double first, second;
    // Of two estimates e5 and e3 of different orders:  e5 e5 / sqrt(e5^2 + e3^2 / 100).
    double operator()(double e) const { return e == 0 ? 0.0 : e * (e / std::hypot(e, 0.1 * second)); }
    double operator()() const { return (*this)(first); }
  };
  const auto estimate = [&](const std::vector<Coordinates<double>>& k) {
    return Estimate{h * largest(weighted(table_.error, k)),
                    table_.second_error.empty() ? 0.0 : h * largest(weighted(table_.second_error, k))};
  };
  const auto ratio = [](double e, double allowed) { return e == 0 ? 0.0 : e / allowed; };
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const double x = std::max({largest(from.position), largest(to.position), h * largest(from.velocity)}),
               v = std::max({largest(from.velocity), largest(to.velocity), h * largest(a_[0])});
  const double tolerance = control_->tolerance + eps, s = table_.stages(), n = std::sqrt(s);
  const double w =
      std::sqrt(std::inner_product(table_.error.begin(), table_.error.end(), table_.error.begin(), 0.0));
  const Estimate e_x = estimate(v_), e_v = estimate(a_);
  const auto with = [&](double da) {
    return std::max(ratio(e_x(), tolerance * x + e_x(h * w * (n * eps * v + h * da))),
                    ratio(e_v(), tolerance * v + e_v(h * w * da)));
  };
  const double plain = with(0.0);
  const double most = s * s * n * eps * (x / h + v + std::abs(from.time) * largest(a_[0])) / h;
  const bool shrinks = plain > std::pow(0.9, table_.error_order);
  if (!shrinks || e_v() > e_v(h * w * most)) return plain;
  const auto counted = rounding_.element_coefficients();
  double da = largest(rounding_(from, h, n, std::span(&a_[0], 1)).front());
  // At the end as well: a force may be none at the beginning, as above a floor.
  const State<double> end{from.time + h, to.position, to.velocity};
  Coordinates<double> a;
  Report report;
  if (accelerations_(end, a, report))
    da = std::max(da, largest(rounding_(end, h, n, std::span(&a, 1)).front()));
  other_element_coefficients_ += rounding_.element_coefficients() - counted;
  return with(da);
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
    const double h = chosen_length(from, proposal, limit, report);
    if (h == 0.0) return 0.0;
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
