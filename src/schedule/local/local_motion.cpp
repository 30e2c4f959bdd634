// SPDX-License-Identifier: MIT
#include "schedule/local/local_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "jetlag/base/text.hpp"
#include "jetlag/control/courant.hpp"
#include "jetlag/integrators/integrator.hpp"
#include "jetlag/series/calculus/polynomial.hpp"
#include "schedule/local/stopped_sum.hpp"

namespace jetlag {

LocalMotion::LocalMotion(ModelAlong along, const TruncationLaw& law, const ClockOptions& options)
    : options_(options),
      stops_(law, options.draws, options.seed),
      dimension_(along.model().dimension()),
      stride_(padded(dimension_)),
      order_(order_needed(law.max_degree(), options.velocity)),
      size_(static_cast<std::size_t>(order_ + 1) * stride_),
      along_(std::move(along)),
      all_(model(), std::max(order_, 2), kernels<double>(), Workers(options.threads)),
      places_(model().particles(), -1),
      to_kinks_(model()),
      watches_(all_.has_conditions()),
      to_change_(model().particles(), false),
      instants_(model().particles(), 0),
      to_other_elements_(model().particles(), false) {
  const Model<double>& model = this->model();
  require_positive("tolerance", options_.tolerance);
  require_positive("max_step", options_.max_step, true);
  if (!along_.follow_clocks())
    throw std::invalid_argument(
        "schedule: the elements that come and go do not follow particles with clocks of their own; take "
        "Lockstep");
  if (order_ < 2) throw std::invalid_argument("schedule: the degree must be at least 2");
  if (law.weighting() != Weighting::coupled_sum)
    throw std::invalid_argument("schedule: " + law.name() + " is for one clock: pieces are coupled sums");
  if (law.is_fixed()) options_.shared_draw = true;
  for (int i = 0; i < model.particles(); ++i)
    if (!model.fixed()[i]) moving_.push_back(i);
  longest_.assign(model.particles(), options_.max_step);
  if (options_.courant == 0) return;
  stable_.emplace(model, law, options_.velocity, options_.courant);
  frequency_.emplace();
  if (bounds_need_state(model) || damping_needs_state(model)) {
    meter_.emplace(model);
    damping_meter_.emplace(model);
  } else {
    require_bounded(model);
    limit_steps(frequency_bounds(model), damping_bounds(model));
  }
}

void LocalMotion::limit_steps(const std::vector<double>& frequencies, const std::vector<double>& dampings) {
  const std::vector<double> stable = (*stable_)(frequencies, dampings);
  for (std::size_t i = 0; i < stable.size(); ++i) longest_[i] = std::min(options_.max_step, stable[i]);
  frequency_->bound = frequencies.empty() ? 0.0 : *std::ranges::max_element(frequencies);
}

/// A state whose tangents are not finite leaves the limits as they are.
bool LocalMotion::refresh_limits(Count now, Report& report) {
  if (!meter_ || work_.updates < next_limits_) return true;
  next_limits_ = work_.updates + Courant::usual_refresh * moving_.size();
  const State<double> state = at_tick(now);
  const std::vector<double> frequencies = meter_->of_particles(state),
                            dampings = damping_meter_->of_particles(state);
  if (frequencies.empty() || dampings.empty()) return true;
  try {
    limit_steps(frequencies, dampings);
  } catch (const std::invalid_argument& no_step) {
    report = {Outcome::step_underflow, "at t = " + shown(ticks_.time(now)) + ": " + no_step.what(), -1};
    return false;
  }
  ++frequency_->refreshed;
  find_levels();
  return true;
}

void LocalMotion::begin(const State<double>& state, const Ticks& ticks) {
  begin_elements(state);
  all_.start(state);  // throws what is to be thrown
  if (meter_) {
    require_damping(model(), state);
    meter_.emplace(model());
    damping_meter_.emplace(model());
    const std::vector<double> frequencies = meter_->of_particles(state);
    if (frequencies.empty()) require_finite_tangents(model(), state);  // says which is not
    limit_steps(frequencies, damping_meter_->of_particles(state));
    next_limits_ = work_.updates + Courant::usual_refresh * moving_.size();
  }
  to_kinks_.kinks().forget();
  to_change_.assign(to_change_.size(), false);
  std::ranges::fill(instants_, 0);
  sliding_ = -1;
  natural_.assign(state.position.rows(), ticks.seconds(Ticks::step(0)));
  set_ticks(ticks);
  const std::size_t particles = state.position.rows();
  series_.assign(particles * size_, 0.0);
  begin_.assign(particles, 0);
  degree_.assign(particles, degree());
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
  find_levels();
}

void LocalMotion::find_levels() {
  coarsest_.clear();
  for (double longest : longest_) coarsest_.push_back(ticks_.level(longest));
}

void LocalMotion::evaluate(const double* c, int degree, double s, double* x, double* v) const {
  const bool own = options_.velocity == VelocitySeries::own_series;
  if (stride_ == 1) return stopped_sum<1>(c, degree, stops_.weights(), own, s, x, v);
  if (stride_ == 2) return stopped_sum<2>(c, degree, stops_.weights(), own, s, x, v);
  stopped_sum<4>(c, degree, stops_.weights(), own, s, x, v);
}

LastTwoSizes LocalMotion::sizes_of(int particle) const {
  const int degree = this->degree();
  const auto size = [&](int k) { return k < 0 || k > order_ ? 0.0 : norm_of(particle, k); };
  LastTwoSizes sizes{degree, {size(2), size(3)}, {size(degree - 1), size(degree)}};
  if (sizes.last[0] == 0 && sizes.last[1] == 0) stand_in(sizes, size);
  return sizes;
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

Piece LocalMotion::piece_about(double begin, double end, const std::function<double(int)>& since) const {
  const auto particles = static_cast<int>(begin_.size());
  const bool own = options_.velocity == VelocitySeries::own_series;
  Piece piece{begin, end, Coefficients(degree() + 1, particles, dimension_),
              Coefficients(degree() + (own ? 1 : 0), particles, dimension_)};
  std::vector<double> x, v;
  for (int i = 0; i < particles; ++i)
    for (int d = 0; d < dimension_; ++d) {
      x.assign(piece.position.size(), 0.0);
      v.assign(piece.velocity.size(), 0.0);
      const auto c = [&](int n) { return series(i)[n * stride_ + d]; };
      for (int n = 0; n <= degree_[i]; ++n) x[n] = stops_.weights()[n] * c(n);
      for (int n = 0; n < degree_[i] + (own ? 1 : 0); ++n)
        v[n] = stops_.weights()[own ? n : n + 1] * ((n + 1) * c(n + 1));
      const double s = since(i);
      taylor_shift(x, s);
      taylor_shift(v, s);
      for (std::size_t n = 0; n < x.size(); ++n) piece.position[n](i, d) = x[n];
      for (std::size_t n = 0; n < v.size(); ++n) piece.velocity[n](i, d) = v[n];
    }
  return piece;
}

}  // namespace jetlag
