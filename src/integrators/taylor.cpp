// SPDX-License-Identifier: MIT
#include "jetlag/integrators/taylor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "jetlag/base/error_free.hpp"
#include "jetlag/control/last_two.hpp"

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

std::optional<SequentialLaw> sequential_part(const Truncation& law) {
  const auto* sequential = std::get_if<SequentialLaw>(&law);
  return sequential != nullptr ? std::optional(*sequential) : std::nullopt;
}

/// A fixed degree is one for all, and nothing is drawn.
RandomTaylor::Options with_one_draw_if_fixed(RandomTaylor::Options options, const TruncationLaw& law) {
  if (law.is_fixed()) {
    options.shared_draw = true;
    options.draws = Draw::independent;
  }
  return options;
}

}  // namespace

RandomTaylor::RandomTaylor(const System<double>& system, Truncation law, std::unique_ptr<Control> control,
                           Options options)
    : law_(known_beforehand(law)),
      sequential_(sequential_part(law)),
      series_(system, law_.max_degree() + 1, kernels<double>(), Workers(options.threads)),
      control_(std::move(control)),
      options_(with_one_draw_if_fixed(options, law_)),
      draws_(options_.draws, sequential_ ? nullptr : &law_, options_.seed,
             options_.shared_draw ? 1 : static_cast<std::uint32_t>(system.particles())),
      stride_(law_.max_degree() + 2),
      weights_differ_(sequential_ || law_.weighting() == Weighting::single_term),
      fixed_(system.fixed()),
      moving_(moving_particles(system)),
      kinks_(std::isfinite(control_->past_kinks(1.0)) ? Kinks(system) : Kinks()) {
  if (options_.compensated && options_.velocity == VelocitySeries::derivative && law_.min_degree() == 0)
    throw std::invalid_argument(
        "RandomTaylor: compensated sums of velocities from the derivative need a min_degree of at least 1");
  control_->orders_read(law_, options_.velocity);  // refuses a law that it cannot forecast
  degree_.resize(options_.shared_draw ? 1 : system.particles());
  // The 0 after the last: with `derivative` a series of velocities begins at weight 1.
  weights_.assign(stride_ * (weights_differ_ ? degree_.size() : 1), 0.0);
  if (!weights_differ_)
    for (int n = 0; n <= law_.max_degree(); ++n) weights_[n] = law_.weight(n);
}

/// Degrees and weights of this step, for a law that is known beforehand.
void RandomTaylor::draw() {
  for (std::size_t i = 0; i < degree_.size(); ++i) {
    degree_[i] = law_.is_fixed() ? law_.max_degree()
                 : !draws_for(i) ? law_.min_degree()
                                 : draws_.degree(law_, key(i), update_);
    if (weights_differ_)
      for (int n = 0; n <= degree_[i]; ++n) weights(i)[n] = law_.weight(n, degree_[i]);
  }
}

/// Degrees and weights of this step of length h for a sequential law, order by order: the series grows no further than
/// the draws go. Each goes on to order n while u <= P(K >= n) = p_{m+1} .. p_n.
void RandomTaylor::roulette(double h, const State<double>& state) {
  const int m = sequential_->min_degree();
  grow_to(order_needed(m), state);
  const auto size = [&](std::size_t i, int n) {
    const double c = options_.shared_draw
                         ? series_.position_norm(n)
                         : series_.position(n).row(static_cast<Eigen::Index>(i)).cwiseAbs().maxCoeff();
    return c * std::pow(h / series_.time_unit(), n);
  };
  std::vector<std::size_t> going;
  std::vector<double> u(degree_.size()), tail(degree_.size(), 1.0);
  std::vector<std::vector<double>> sizes(degree_.size());
  for (std::size_t i = 0; i < degree_.size(); ++i) {
    degree_[i] = m;
    std::fill_n(weights(i), m + 1, 1.0);
    if (!draws_for(i)) continue;
    going.push_back(i);
    u[i] = draws_.number(key(i), update_);
    for (int n = 0; n < m; ++n) sizes[i].push_back(size(i, n));
  }
  for (int n = m + 1; n <= sequential_->max_degree() && !going.empty(); ++n) {
    std::erase_if(going, [&](std::size_t i) {
      sizes[i].push_back(size(i, n - 1));
      tail[i] *= sequential_->go_on(n, sizes[i], 1.0 / tail[i]);
      if (u[i] > tail[i]) return true;
      degree_[i] = n;
      weights(i)[n] = 1.0 / tail[i];
      return false;
    });
    if (!going.empty()) grow_to(order_needed(n), state);
  }
}

/// sum_{first<=n<=K} w_n c_n s^(n-first) by Horner's rule, c the series of the positions or that of the velocities.
void RandomTaylor::weighted_sum(bool of_velocity, double s, int first, Coordinates<double>& sum) const {
  const bool derivative = of_velocity && options_.velocity == VelocitySeries::derivative;
  // With `derivative`, coefficient n of the velocity carries the weight of coefficient n + 1 of the position.
  const int offset = derivative ? 1 : 0;
  const auto last = [&](int degree) { return derivative ? degree - 1 : degree; };

  const int top = last(*std::ranges::max_element(degree_));
  if (options_.shared_draw) {
    const double* weight = weights(0) + offset;
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
      if (n <= last(degree_[i])) sum.row(i) = sum.row(i) * s + weights(i)[n + offset] * c.row(i);
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

namespace {

/// Plain sums of the series of a motion as far as it is known, or to `last`.
class SeriesPaths final : public Paths {
 public:
  SeriesPaths(const Expansion<double>& series, int last) : series_(series), last_(last) {}
  double now() const override { return series_.time(); }
  void velocity(int particle, double* v) const override {
    const auto velocity = series_.velocity(0);
    for (int c = 0; c < series_.dimension(); ++c) v[c] = velocity(particle, c);
  }
  void at(int particle, double s, double* x) const override {
    if (s == 0) {
      const auto place = series_.position(0);
      for (int c = 0; c < series_.dimension(); ++c) x[c] = place(particle, c);
      return;
    }
    const double u = s / series_.time_unit();
    for (int c = 0; c < series_.dimension(); ++c) x[c] = 0;
    for (int n = last_; n >= 0; --n) {
      const auto coefficient = series_.position(n);
      for (int c = 0; c < series_.dimension(); ++c) x[c] = x[c] * u + coefficient(particle, c);
    }
  }

 private:
  const Expansion<double>& series_;
  int last_;
};

}  // namespace

/// The step h, or a shorter one that ends at a kink of a force.
double RandomTaylor::up_to_kinks(double h, const State<double>& state) {
  if (left_at_.rows() != state.position.rows() || left_at_ != state.position) kinks_.forget();
  const int last = std::min(series_.order(), law_.max_degree());
  series_.curve(last, h / series_.time_unit(), curve_);
  late_.clear();
  for (int i = 0; i < series_.particles(); ++i) {
    if (fixed_[i]) continue;
    const Kinks::Step step{i, h, curve_[i]};
    if (!kinks_.take(step, state.time, state.position.row(i).data(), state.velocity.row(i).data()))
      late_.push_back(step);
  }
  if (late_.empty()) return h;
  // Some places of the time at least, or it would not go on: beyond a kink the next step may be no longer than the way.
  const double least = 8 * std::numeric_limits<double>::epsilon() * std::abs(state.time);
  const double size = series_.position_norm(0);
  const double depth =
      std::max({control_->past_kinks(size), depth_of_rounding(size), least * series_.velocity_norm(0)});
  kinks_.shorten(late_, depth, SeriesPaths(series_, last));
  double shortest = h;
  for (const Kinks::Step& step : late_) {
    shortest = std::min(shortest, step.h);
    if (!step.near_point) continue;
    const double radius = step_within_radius(
        last, [&](int k) { return series_.position(k).row(step.particle).cwiseAbs().maxCoeff(); });
    shortest = std::min(shortest, series_.time_unit() * radius);
  }
  return std::min(h, std::max(shortest, least));
}

double RandomTaylor::step(State<double>& state, double limit, Report& report) {
  series_.start(state, time_unit_);
  if (!sequential_) draw();
  if (const int orders = control_->orders_read(law_, options_.velocity); orders > 0) grow_to(orders, state);
  double h = cropped(control_->propose({series_, law_}), limit);
  if (!kinks_.none() && std::isfinite(h) && std::isfinite(control_->past_kinks(1.0)))
    h = up_to_kinks(h, state);
  if (!advances(state.time, h)) {
    if (all_finite(series_, report)) report = step_underflow(series_, h);
    return 0.0;
  }
  if (sequential_)
    roulette(h, state);
  else if (const int orders = order_needed(*std::ranges::max_element(degree_)); orders > series_.order())
    grow_to(orders, state);

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
  if (!kinks_.none()) left_at_ = next.position;
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
  draws_.reseed(options_.seed);
  std::swap(update_, member.update);
  std::swap(control_, member.control);
  kinks_.exchange(member.tracks);
  std::swap(left_at_, member.left_at);
  time_unit_ = 1;
}

Piece RandomTaylor::piece() const {
  Piece piece{series_.time(), series_.time() + last_step_, {}, {}, series_.time_unit()};
  const bool derivative = options_.velocity == VelocitySeries::derivative;
  const int top = *std::ranges::max_element(degree_);
  // Term n of each particle with the weight of its draw, none beyond its degree.
  const auto weighted = [&](int n, Coordinates<double> c) {
    if (options_.shared_draw) return Coordinates<double>(weights(0)[n] * c);
    for (int i = 0; i < series_.particles(); ++i) c.row(i) *= n > degree_[i] ? 0.0 : weights(i)[n];
    return c;
  };
  for (int n = 0; n <= top; ++n) {
    Coordinates<double> x = weighted(n, series_.position(n));
    if (!derivative)
      piece.velocity.push_back(weighted(n, series_.velocity(n)));
    else if (n > 0)
      piece.velocity.push_back(n / series_.time_unit() * x);
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
