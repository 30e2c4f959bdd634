// SPDX-License-Identifier: MIT
#include "jetlag/integrators/taylor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "jetlag/series/error_free.hpp"

namespace jetlag {

namespace {

/// The unit of time for a series that is known up to order n: its own, or where coefficients have over- or
/// underflowed a power of two in which they should not.
///
/// The last coefficient m that is neither tells how fast they grow, as (c_m / c)^(1/m), c the largest of c_0, c_1. A
/// series that ends, as that of free fall, looks like one that has underflowed, but its coefficients do not shrink that
/// fast before the end.
double better_unit(const Expansion<double>& series, int n) {
  const auto size = [&](int k) { return series.position_norm(k); };
  const double least = std::numeric_limits<double>::min();
  if (std::isnormal(std::max(size(n), size(n - 1)))) return series.time_unit();
  int m = 1;
  double last = 0;
  bool overflow = false;
  for (int k = 2; k <= n && !overflow; ++k) {
    const double c = size(k);
    overflow = !std::isfinite(c);
    if (!overflow && c >= least) {
      m = k;
      last = c;
    }
  }
  const double first = std::max(size(0), size(1));
  if (m < 2 || !(first >= least)) return series.time_unit();
  const double growth = (std::log2(last) - std::log2(first)) / m;
  if (overflow ? growth < 1 : growth > -16) return series.time_unit();
  const double unit = std::ldexp(series.time_unit(), -static_cast<int>(std::lround(growth)));
  return std::clamp(unit, 0x1p-900, 0x1p900);
}

/// y + rest += s slope, where the product and the sum keep what does not fit a double.
void add_product(double s, const Coordinates<double>& slope, Coordinates<double>& y,
                 Coordinates<double>& rest) {
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const auto product = two_product(s, slope.data()[i]);
    const auto sum = two_sum(y.data()[i], product.high);
    const auto whole = two_sum(sum.high, sum.low + (product.low + rest.data()[i]));
    y.data()[i] = whole.high;
    rest.data()[i] = whole.low;
  }
}

}  // namespace

RandomTaylor::RandomTaylor(const System<double>& system, TruncationLaw law, std::unique_ptr<Control> control,
                           Options options)
    : law_(std::move(law)),
      series_(system, law_.max_degree() + 1, kernels<double>(), Workers(options.threads)),
      control_(std::move(control)),
      options_(options),
      fixed_(system.fixed()),
      moving_(moving_particles(system)) {
  if (options_.compensated && options_.velocity == VelocitySeries::derivative && law_.min_degree() == 0)
    throw std::invalid_argument(
        "RandomTaylor: compensated sums of velocities from the derivative need a min_degree of at least 1");
  if (law_.is_fixed()) options_.shared_draw = true;
  degree_.resize(options_.shared_draw ? 1 : system.particles());
  for (int n = 0; n <= law_.max_degree(); ++n) weights_.push_back(law_.weight(n));
  weights_.push_back(0.0);  // so that a series of velocities may begin at weight 1
}

void RandomTaylor::draw() {
  for (std::size_t i = 0; i < degree_.size(); ++i) {
    const auto particle = options_.shared_draw ? shared_by_all : static_cast<std::uint32_t>(i);
    degree_[i] = law_.is_fixed()                      ? law_.max_degree()
                 : !options_.shared_draw && fixed_[i] ? law_.min_degree()
                                                      : law_.draw(uniform(options_.seed, particle, update_));
  }
}

/// sum_{first<=n<=K} w_n c_n s^(n-first) by Horner's rule, c the series of the positions or that of the velocities.
void RandomTaylor::weighted_sum(bool of_velocity, double s, int first, Coordinates<double>& sum) const {
  const bool derivative = of_velocity && options_.velocity == VelocitySeries::derivative;
  // With `derivative`, coefficient n of the velocity carries the weight of coefficient n + 1 of the position.
  const double* weight = weights_.data() + (derivative ? 1 : 0);
  const auto last = [&](int degree) { return derivative ? degree - 1 : degree; };

  const int top = last(*std::ranges::max_element(degree_));
  if (options_.shared_draw) {
    if (of_velocity)
      series_.velocity_sum(first, top, weight, s, sum);
    else
      series_.position_sum(first, top, weight, s, sum);
    return;
  }
  sum.setZero(series_.particles(), series_.dimension());
  for (int n = top; n >= first; --n) {
    const auto c = of_velocity ? series_.velocity(n) : series_.position(n);
    for (int i = 0; i < series_.particles(); ++i)
      if (n <= last(degree_[i])) sum.row(i) = sum.row(i) * s + weight[n] * c.row(i);
  }
}

/// The state at the end of the step in compensated sums, s = h / time unit:   x + (s sum_{n>=1} w_n x_n s^(n-1)).
/// The rest of the velocity moves the position too.
void RandomTaylor::add_increments(State<double>& state, double s) const {
  for (auto* rest : {&state.position_rest, &state.velocity_rest})
    if (rest->size() == 0) rest->setZero(series_.particles(), series_.dimension());
  state.position_rest += s * series_.time_unit() * state.velocity_rest;
  Coordinates<double> slope;
  weighted_sum(false, s, 1, slope);
  add_product(s, slope, state.position, state.position_rest);
  weighted_sum(true, s, 1, slope);
  add_product(s, slope, state.velocity, state.velocity_rest);
}

/// The series of this step up to an order, in a unit of time in which its coefficients are representable.
void RandomTaylor::grow_to(int order, const State<double>& state) {
  for (int attempt = 0; attempt < 4; ++attempt) {
    series_.grow_to(order);
    const double unit = better_unit(series_, series_.order());
    if (unit == time_unit_) return;
    time_unit_ = unit;
    series_.start(state, unit);
  }
  series_.grow_to(order);
}

double RandomTaylor::step(State<double>& state, double limit, Report& report) {
  series_.start(state, time_unit_);
  draw();
  if (control_->reads_series()) grow_to(order_needed(law_.max_degree()), state);
  const double h = cropped(control_->propose({series_, law_}), limit);
  if (!advances(state.time, h)) {
    if (all_finite(series_, report)) report = step_underflow(series_, h);
    return 0.0;
  }
  if (!control_->reads_series()) grow_to(order_needed(*std::ranges::max_element(degree_)), state);

  const double s = h / series_.time_unit();
  State<double>& next = next_;
  if (options_.compensated) {
    next = state;
    add_increments(next, s);
  } else {
    next.time = state.time;
    next.drop_rests();
    weighted_sum(false, s, 0, next.position);
    weighted_sum(true, s, 0, next.velocity);
  }
  if (!next.position.allFinite() || !next.velocity.allFinite()) {
    if (all_finite(series_, report)) all_finite(next.position, next.velocity, state.time, report);
    return 0.0;
  }
  std::swap(state, next);
  last_step_ = h;
  ++update_;

  ++work_.steps;
  work_.updates += moving_;
  work_.coefficients += static_cast<std::uint64_t>(series_.order() - 1) * moving_;
  work_.element_coefficients = series_.element_coefficients();
  if (options_.shared_draw) {
    work_.degrees += static_cast<std::uint64_t>(degree_[0]) * moving_;
  } else {
    for (std::size_t i = 0; i < degree_.size(); ++i) work_.degrees += fixed_[i] ? 0 : degree_[i];
  }
  return h;
}

void RandomTaylor::exchange(Member& member) {
  std::swap(options_.seed, member.seed);
  std::swap(update_, member.update);
  std::swap(control_, member.control);
  time_unit_ = 1;
}

Piece RandomTaylor::piece() const {
  Piece piece{series_.time(), series_.time() + last_step_, {}, {}, series_.time_unit()};
  const bool derivative = options_.velocity == VelocitySeries::derivative;
  const int top = *std::ranges::max_element(degree_);
  for (int n = 0; n <= top; ++n) {
    Coordinates<double> x = law_.weight(n) * series_.position(n);
    if (!options_.shared_draw)
      for (int i = 0; i < series_.particles(); ++i)
        if (n > degree_[i]) x.row(i).setZero();
    if (derivative) {
      if (n > 0) piece.velocity.push_back(n / series_.time_unit() * x);
    } else {
      piece.velocity.push_back(law_.weight(n) * series_.velocity(n));
      if (!options_.shared_draw)
        for (int i = 0; i < series_.particles(); ++i)
          if (n > degree_[i]) piece.velocity.back().row(i).setZero();
    }
    piece.position.push_back(std::move(x));
  }
  if (piece.velocity.empty()) piece.velocity.push_back(0.0 * series_.velocity(0));  // K = 0 and `derivative`
  return piece;
}

std::unique_ptr<Integrator> taylor(const System<double>& system, int degree,
                                   std::unique_ptr<Control> control) {
  return std::make_unique<RandomTaylor>(system, fixed_degree(degree), std::move(control));
}

}  // namespace jetlag
