// SPDX-License-Identifier: MIT
#include "schedule/local_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "jetlag/base/text.hpp"
#include "jetlag/control/courant.hpp"
#include "jetlag/integrators/integrator.hpp"
#include "jetlag/series/calculus/polynomial.hpp"
#include "jetlag/truncation/draws.hpp"

namespace jetlag {

LocalMotion::LocalMotion(const Model<double>& model, TruncationLaw law, const ClockOptions& options)
    : law_(std::move(law)),
      options_(options),
      draws_(law_.is_fixed() ? Draw::independent : options_.draws, &law_, options_.seed, 1),
      dimension_(model.dimension()),
      stride_(padded(dimension_)),
      order_(law_.max_degree() + (options.velocity == VelocitySeries::own_series ? 1 : 0)),
      size_(static_cast<std::size_t>(order_ + 1) * stride_),
      model_(model),
      all_(model, std::max(order_, 2), kernels<double>(), Workers(options.threads)),
      places_(model.particles(), -1),
      kinks_(model) {
  require_positive("tolerance", options_.tolerance);
  require_positive("max_step", options_.max_step, true);
  if (order_ < 2) throw std::invalid_argument("schedule: the degree must be at least 2");
  if (law_.weighting() != Weighting::coupled_sum)
    throw std::invalid_argument("schedule: " + law_.name() + " is for one clock: pieces are coupled sums");
  if (law_.is_fixed()) options_.shared_draw = true;
  for (int i = 0; i < model.particles(); ++i)
    if (!model.fixed()[i]) moving_.push_back(i);
  longest_.assign(model.particles(), options_.max_step);
  if (options_.courant != 0) {
    const auto stable = courant_steps_of_particles(model, law_, options_.velocity, options_.courant);
    for (std::size_t i = 0; i < stable.size(); ++i) longest_[i] = std::min(longest_[i], stable[i]);
  }
  for (int n = 0; n <= law_.max_degree(); ++n) weights_.push_back(law_.weight(n));
  weights_.push_back(law_.is_fixed() ? 1.0 : 0.0);
}

void LocalMotion::begin(const State<double>& state, const Ticks& ticks) {
  all_.start(state);  // throws what is to be thrown
  kinks_.forget();
  natural_.assign(state.position.rows(), ticks.seconds(Ticks::step(0)));
  set_ticks(ticks);
  const std::size_t particles = state.position.rows();
  series_.assign(particles * size_, 0.0);
  begin_.assign(particles, 0);
  degree_.assign(particles, law_.max_degree());
  updates_.resize(particles, 0);
  for (std::size_t i = 0; i < particles; ++i)
    for (int c = 0; c < dimension_; ++c) {
      series(i)[c] = state.position(i, c);
      series(i)[stride_ + c] = state.velocity(i, c);
    }
}

void LocalMotion::set_ticks(const Ticks& ticks) {
  ticks_ = ticks;
  allowed_.clear();
  coarsest_.clear();
  for (double longest : longest_) coarsest_.push_back(ticks_.level(longest));
}

/// x = sum_{n<=K} w_n x_n s^n,   v = sum_{n<=K} w_n (n+1) x_{n+1} s^n, or the derivative of x;   by Horner's rule.
template <int stride>
void LocalMotion::evaluate_padded(const double* c, int degree, double s, double* x, double* v) const {
  const bool own = options_.velocity == VelocitySeries::own_series;
  double sum[stride] = {}, slope[stride] = {};
  for (int n = degree; n >= 0; --n)
    for (int d = 0; d < stride; ++d) sum[d] = sum[d] * s + weights_[n] * c[n * stride + d];
  const int dimension = stride < 4 ? stride : 3;
  for (int d = 0; d < dimension; ++d) x[d] = sum[d];
  if (!v) return;
  for (int n = own ? degree : degree - 1; n >= 0; --n)
    for (int d = 0; d < stride; ++d)
      slope[d] = slope[d] * s + weights_[own ? n : n + 1] * ((n + 1) * c[(n + 1) * stride + d]);
  for (int d = 0; d < dimension; ++d) v[d] = slope[d];
}
void LocalMotion::evaluate(const double* c, int degree, double s, double* x, double* v) const {
  if (stride_ == 1) return evaluate_padded<1>(c, degree, s, x, v);
  if (stride_ == 2) return evaluate_padded<2>(c, degree, s, x, v);
  evaluate_padded<4>(c, degree, s, x, v);
}

/// What others are told of a particle: its series with the weights of its degree.
template <int stride>
void LocalMotion::told(int particle, double* to, std::size_t next_order) const {
  const double* c = series(particle);
  if (law_.is_fixed()) {
    for (int n = 0; n <= order_; ++n)
      for (int d = 0; d < stride; ++d) to[n * next_order + d] = c[n * stride + d];
    return;
  }
  for (int n = 0; n <= order_; ++n)
    for (int d = 0; d < stride; ++d)
      to[n * next_order + d] = n <= degree_[particle] ? weights_[n] * c[n * stride + d] : 0.0;
}

bool LocalMotion::finite_series(const double* c, int particle, Count now, Report& report) const {
  for (std::size_t i = 0; i < size_; ++i) {
    if (std::isfinite(c[i])) continue;
    report = {Outcome::non_finite,
              "coefficient " + std::to_string(i / stride_) + " of the motion of particle " +
                  std::to_string(particle) + " is not finite at t = " + shown(ticks_.time(now)) +
                  ": the force is singular there (particles that coincide?), or the motion has blown up; "
                  "separate the particles, soften the force or take a smaller tolerance",
              particle};
    return false;
  }
  return true;
}

void LocalMotion::publish(int particle, Count now, std::uint64_t group) {
  begin_[particle] = now;
  if (!law_.is_fixed())
    degree_[particle] = options_.shared_draw
                            ? draws_.degree(law_, shared_by_all, group)
                            : draws_.degree(law_, static_cast<std::uint32_t>(particle), updates_[particle]);
  ++updates_[particle];
  work_.degrees += degree_[particle];
}

void LocalMotion::count(std::size_t updated) {
  ++groups_;
  ++work_.steps;
  work_.updates += updated;
  work_.coefficients += static_cast<std::uint64_t>(order_ - 1) * updated;
  work_.element_coefficients = all_.element_coefficients() + partial_coefficients_;
}

bool LocalMotion::update(PartialExpansion& group, Count now, Report& report) {
  const std::uint64_t before = group.element_coefficients();
  const bool done = stride_ == 1   ? update_padded<1>(group, now, report)
                    : stride_ == 2 ? update_padded<2>(group, now, report)
                                   : update_padded<4>(group, now, report);
  partial_coefficients_ += group.element_coefficients() - before;
  if (!done) return false;
  for (int i : group.active()) publish(i, now, groups_);
  count(group.active().size());
  return true;
}

template <int stride>
bool LocalMotion::update_padded(PartialExpansion& group, Count now, Report& report) {
  const auto &active = group.active(), &known = group.known();
  const std::size_t next_order = group.next_order();
  for (std::size_t a = 0; a < active.size(); ++a)
    evaluate_padded<stride>(series(active[a]), degree_[active[a]], ticks_.seconds(now - begin_[active[a]]),
                            group.active_row(0, a), group.active_row(1, a));
  shift_.clear();
  for (std::size_t b = 0; b < known.size(); ++b) {
    told<stride>(known[b], group.known_row(0, b), next_order);
    shift_.push_back(ticks_.seconds(now - begin_[known[b]]));
  }
  if (!known.empty()) group.shift_known(order_, shift_);
  group.grow_to(order_, ticks_.time(now));

  // Nothing is taken over before all of it is known to be finite.
  const double* grown = group.active_row(0, 0);
  double not_finite = 0;  // x - x is 0, or NaN
  for (int n = 0; n <= order_; ++n) {
    double of_order = 0;
    for (std::size_t i = 0; i < active.size() * stride; ++i) {
      const double x = grown[n * next_order + i];
      of_order += x - x;
    }
    not_finite += of_order;
  }
  const auto copy = [&](std::size_t a, double* to) {
    for (int n = 0; n <= order_; ++n)
      for (int d = 0; d < stride; ++d) to[n * stride + d] = grown[n * next_order + a * stride + d];
  };
  if (!(not_finite == 0)) {
    rows_.resize(size_);
    for (std::size_t a = 0; a < active.size(); ++a) {
      copy(a, rows_.data());
      if (!finite_series(rows_.data(), active[a], now, report)) return false;
    }
  }
  for (std::size_t a = 0; a < active.size(); ++a) copy(a, series(active[a]));
  return true;
}

bool LocalMotion::update_all(Count now, Report& report) {
  all_.start(at_tick(now));
  all_.grow_to(order_);
  if (!all_finite(all_, report)) return false;
  for (int n = 0; n <= order_; ++n) {
    const auto x = all_.position(n);
    for (int i : moving_)
      for (int d = 0; d < dimension_; ++d) series(i)[n * stride_ + d] = x(i, d);
  }
  for (int i : moving_) publish(i, now, groups_);
  count(moving_.size());
  return true;
}

LastTwoSizes LocalMotion::sizes_of(int particle) const {
  const int degree = law_.max_degree();
  const auto size = [&](int k) {
    if (k < 0 || k > order_) return 0.0;
    const double* c = series(particle) + k * stride_;
    double most = 0;
    for (int d = 0; d < stride_; ++d) most = std::max(most, std::abs(c[d]));
    return most;
  };
  LastTwoSizes sizes{degree, {size(2), size(3)}, {size(degree - 1), size(degree)}};
  if (sizes.last[0] == 0 && sizes.last[1] == 0) stand_in(sizes, size);
  return sizes;
}

/// A bound of how far a particle goes in h from a straight line:  sum_{n>=2} w_n |x_n| h^n.
template <int stride>
double LocalMotion::curve_padded(int particle, double h) const {
  const double* c = series(particle);
  double sum[stride] = {}, squared = 0;
  for (int n = degree_[particle]; n >= 2; --n)
    for (int d = 0; d < stride; ++d) sum[d] = (sum[d] + weights_[n] * std::abs(c[n * stride + d])) * h;
  for (double component : sum) squared += component * component;
  return std::sqrt(squared) * h;
}
double LocalMotion::curve(int particle, double h) const {
  if (stride_ == 1) return curve_padded<1>(particle, h);
  if (stride_ == 2) return curve_padded<2>(particle, h);
  return curve_padded<4>(particle, h);
}

void LocalMotion::shorten_late(Count now, std::vector<Kinks::Step>& shortened) {
  class Now final : public Paths {
   public:
    Now(const LocalMotion& motion, Count now) : motion_(motion), now_(now) {}
    double now() const override { return motion_.ticks_.time(now_); }
    void velocity(int particle, double* v) const override {
      double x[3];
      motion_.evaluate(particle, motion_.ticks_.seconds(now_ - motion_.begin_[particle]), x, v);
    }
    void at(int particle, double s, double* x) const override {
      if (s == 0 && motion_.begin_[particle] == now_) {
        std::copy_n(motion_.series(particle), motion_.dimension_, x);
        return;
      }
      motion_.evaluate(particle, motion_.ticks_.seconds(now_ - motion_.begin_[particle]) + s, x, nullptr);
    }

   private:
    const LocalMotion& motion_;
    Count now_;
  };
  // Some places of the time at least, or it would not go on.
  const double least = 8 * std::numeric_limits<double>::epsilon() * std::abs(ticks_.time(now));
  std::vector<double> before;
  for (const Kinks::Step& step : late_) {
    before.push_back(step.h);
    natural_[step.particle] = step_of(step.particle);
  }
  const auto size = [&](int particle, int order) {
    const double* c = series(particle) + order * stride_;
    double most = 0;
    for (int d = 0; d < stride_; ++d) most = std::max(most, std::abs(c[d]));
    return most;
  };
  double largest = 0;
  for (const Kinks::Step& step : late_) largest = std::max(largest, size(step.particle, 0));
  const double depth = std::max(options_.tolerance, depth_of_rounding(largest));
  shortened = kinks_.shorten(late_, depth, Now(*this, now));
  for (std::size_t k = 0; k < late_.size(); ++k) {
    Kinks::Step& step = late_[k];
    if (step.near_point)
      step.h = std::min(step.h, step_within_radius(law_.max_degree(),
                                                   [&](int order) { return size(step.particle, order); }));
    if (step.h < before[k]) shortened.push_back(step);
  }
  for (Kinks::Step& step : shortened) step.h = std::max(step.h, least);
}

void LocalMotion::remember(std::span<const int> particles) {
  former_.clear();
  former_begin_.clear();
  former_degree_.clear();
  former_natural_.clear();
  former_series_.clear();
  if (kinks_.none()) return;
  for (int i : particles) {
    if (!kinks_.in_doubt(i)) continue;
    former_.push_back(i);
    former_begin_.push_back(begin_[i]);
    former_degree_.push_back(degree_[i]);
    former_natural_.push_back(natural_[i]);
    former_series_.insert(former_series_.end(), series(i), series(i) + size_);
  }
}

bool LocalMotion::keeps_its_word(std::size_t k, Count tick) const {
  double before[3], after[3], most = 0;
  evaluate(former_series_.data() + k * size_, former_degree_[k], ticks_.seconds(tick - former_begin_[k]),
           before, nullptr);
  evaluate(former_[k], ticks_.seconds(tick - begin_[former_[k]]), after, nullptr);
  for (int c = 0; c < dimension_; ++c) most = std::max(most, std::abs(after[c] - before[c]));
  const double reached = 0.7 * ticks_.seconds(tick - former_begin_[k]) / former_natural_[k];
  return most <= options_.tolerance * std::max(1.0, std::pow(reached, law_.max_degree()));
}

double LocalMotion::step_of(int particle) const {
  return std::min(longest_[particle], last_two_step(sizes_of(particle), options_.tolerance));
}

int LocalMotion::level_of(int particle, int coarsest) {
  const LastTwoSizes sizes = sizes_of(particle);
  int level = std::max(coarsest, coarsest_[particle]);
  for (; level <= Ticks::finest; ++level) {
    while (static_cast<int>(allowed_.size()) <= level)
      allowed_.emplace_back(sizes.degree, options_.tolerance,
                            ticks_.seconds(Ticks::step(static_cast<int>(allowed_.size()))));
    if (allowed_[level](sizes)) break;
  }
  return level;
}

State<double> LocalMotion::at(double t) const {
  return state_at(t, [&](int i) { return ticks_.since(begin_[i], t); });
}
State<double> LocalMotion::at_tick(Count now) const {
  return state_at(ticks_.time(now), [&](int i) { return ticks_.seconds(now - begin_[i]); });
}

Piece LocalMotion::piece(Count begin, double end) const {
  const auto particles = static_cast<Eigen::Index>(begin_.size());
  const bool own = options_.velocity == VelocitySeries::own_series;
  Piece piece{ticks_.time(begin), end, {}, {}, 1};
  piece.position.assign(law_.max_degree() + 1, Coordinates<double>::Zero(particles, dimension_));
  piece.velocity.assign(law_.max_degree() + (own ? 1 : 0), Coordinates<double>::Zero(particles, dimension_));
  std::vector<double> x, v;
  for (int i = 0; i < particles; ++i)
    for (int d = 0; d < dimension_; ++d) {
      x.assign(piece.position.size(), 0.0);
      v.assign(piece.velocity.size(), 0.0);
      const auto c = [&](int n) { return series(i)[n * stride_ + d]; };
      for (int n = 0; n <= degree_[i]; ++n) x[n] = weights_[n] * c(n);
      for (int n = 0; n < degree_[i] + (own ? 1 : 0); ++n)
        v[n] = weights_[own ? n : n + 1] * ((n + 1) * c(n + 1));
      const double s = ticks_.seconds(begin - begin_[i]);
      taylor_shift(x, s);
      taylor_shift(v, s);
      for (std::size_t n = 0; n < x.size(); ++n) piece.position[n](i, d) = x[n];
      for (std::size_t n = 0; n < v.size(); ++n) piece.velocity[n](i, d) = v[n];
    }
  return piece;
}

}  // namespace jetlag
