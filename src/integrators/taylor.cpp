// SPDX-License-Identifier: MIT
#include "jetlag/integrators/taylor.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "jetlag/base/error_free.hpp"
#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

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

Stops stops_of(const Model<double>& model, const Truncation& law, const RandomTaylor::Options& options) {
  if (options.shared_draw) return Stops(law, options.draws, options.seed);
  return Stops(law, options.draws, options.seed, model.fixed());
}

StoppedSeries<Expansion<double>> series_of(const Model<double>& model, const Truncation& law,
                                           const RandomTaylor::Options& options) {
  Stops stops = stops_of(model, law, options);
  Expansion<double> series(model, stops.law().max_degree() + 1, kernels<double>(), Workers(options.threads));
  return {std::move(series), std::move(stops), order_needed(0, options.velocity)};
}

Report contradiction(double time, int particle) {
  return {Outcome::step_underflow,
          "the force on particle " + std::to_string(particle) +
              " at the end of a step contradicts the series from its beginning at t = " + shown(time) +
              ", however short the step: the force is singular or jumps there; end before, or write it with "
              "select, abs, min or max, which are watched",
          particle};
}

}  // namespace

RandomTaylor::RandomTaylor(const System<double>& system, Truncation law, std::unique_ptr<Control> control,
                           Options options)
    : RandomTaylor(ModelAlong(system), std::move(law), std::move(control), options) {}

RandomTaylor::RandomTaylor(ModelAlong along, Truncation law, std::unique_ptr<Control> control,
                           Options options)
    : options_(options),
      along_(std::move(along)),
      series_(series_of(along_.model(), law, options)),
      control_(along_.model(), std::move(control)),
      fixed_(along_.model().fixed()),
      moving_(static_cast<int>(std::ranges::count(fixed_, false))) {
  if (!along_.none() && !stops().shared())
    throw std::invalid_argument(
        "RandomTaylor: elements that come and go need one draw for all particles (shared_draw)");
  if (options_.compensated && options_.velocity == VelocitySeries::derivative &&
      stops().law().min_degree() == 0)
    throw std::invalid_argument(
        "RandomTaylor: compensated sums of velocities from the derivative need a min_degree of at least 1");
  const int read =
      control_.orders_read(stops().law(), options_.velocity);  // refuses a law that it cannot forecast
  ahead_ = std::min(3, std::max(read, order_needed(stops().law().min_degree(), options_.velocity)));
}

double RandomTaylor::step(State<double>& state, double limit, Report& report) {
  const StepsToChanges<double> changes = changes_;
  begin(state);
  const double proposal = control_.propose({expansion(), stops().law(), limit});
  Report change;
  double h = up_to_other_elements(up_to_change(proposal), change);
  if (change.outcome != Outcome::success) {
    report = change;
    return 0.0;
  }
  if (is_stuck(state.time, report)) return 0.0;
  if (!advances(state.time, h)) {
    if (!all_finite(expansion(), report)) return short_step(state, limit, changes, report);
    report = step_underflow(expansion(), h);
    return 0.0;
  }
  proposed_ = h;
  if (!end(state, h, report)) return short_step(state, limit, changes, report);
  for (bool safe = true; !(safe = is_safe(h, change)) || !agrees_with_forces(state, h);) {
    if (change.outcome != Outcome::success) {
      report = change;
      return 0.0;
    }
    ++work_.rejected;
    changes_.take_none();
    const int particle = safe ? most_departed(h) : -1;
    h *= 0.5;
    if (!advances(state.time, h)) {
      report = safe ? contradiction(state.time, particle) : step_underflow(expansion(), h);
      return 0.0;
    }
    begin(state);
    if (!end(state, h, report)) return 0.0;
  }
  return accept(state, h);
}

bool RandomTaylor::is_stuck(double time, Report& report) {
  if (!changes_.is_stuck()) return false;
  report = {Outcome::step_underflow, changes_.cause("a force", shown(time)), -1};
  changes_ = {};
  return true;
}

/// Takes the state at the end of the step h.
double RandomTaylor::accept(State<double>& state, double h) {
  control_.left_at(next_.position);
  along_.take(h, next_.position);
  next_.time = state.time;
  swap(state, next_);
  last_step_ = h;
  ++update_;
  count();
  return h;
}

void RandomTaylor::begin(const State<double>& state) {
  known_.clear();
  foreseen_.at.reset();
  if (!along_.none() && along_.begin(state)) series_.series().move_to(along_.model());
  series_.start(state);
  series_.draw(update_);
  series_.grow_to(control_.orders_read(stops().law(), options_.velocity));
}

/// The state at the end of the step h. Returns whether it is finite.
bool RandomTaylor::end(const State<double>& from, double h, Report& report) {
  series_.stop(h, update_);
  if (sum(from, h, next_)) return true;
  if (all_finite(expansion(), report)) all_finite(next_.position, next_.velocity, from.time, report);
  return false;
}

// ---- the step and its sums ---------------------------------------------------------------------------------

/// The step h, or up to the first change of a choice in a force, as far as the control reads the series: that does not depend on
/// the degree that is drawn.
double RandomTaylor::up_to_change(double h) {
  if (!expansion().has_conditions() || !(h > 0) || !std::isfinite(h)) {
    changes_.take_none();
    return h;
  }
  series_.grow_to(stops().law().max_degree() + 1);
  const double unit = expansion().time_unit();
  double reach = h / unit;
  const double most = reach;
  std::optional<double> change = series_.series().first_change(reach, !known_.empty());
  if (change) *change *= unit;
  return changes_.step(h, reach < most ? reach * unit : h, expansion().time(), change);
}

/// The part of a step that is chosen in which the elements that come and go are those of its beginning. It does not depend on
/// the degree that is drawn.
double RandomTaylor::up_to_other_elements(double h, Report& report) {
  if (along_.none() || control_.is_given() || !(h > 0) || !std::isfinite(h)) return h;
  const int last = stops().law().max_degree();
  series_.grow_to(last);
  const double shorter = along_.up_to_change(series_of_positions(last, nullptr), h, report);
  if (shorter < h) changes_.shorten();
  return shorter;
}

/// Whether nothing passes through anything in the step h as it is drawn. Of a fixed degree `up_to_other_elements` has seen that.
bool RandomTaylor::is_safe(double h, Report& report) {
  if (along_.none() || (stops().law().is_fixed() && !control_.is_given())) return true;
  return along_.is_safe(series_of_positions(stops().degree(), series_.weights(0)), h, control_.is_given(),
                        report);
}

PositionSeries RandomTaylor::series_of_positions(int last, const double* weights) const {
  const CoefficientsView x = expansion().position_series(last);
  return {expansion().time(),
          expansion().time_unit(),
          x.data(0),
          last,
          x.numbers_of_each(),
          static_cast<std::size_t>(padded(x.dimension())),
          weights};
}

/// The state at the end of the step h. Returns whether it is finite.
bool RandomTaylor::sum(const State<double>& from, double h, State<double>& to) {
  const double s = h / expansion().time_unit();
  foreseen_.at.reset();
  if (options_.compensated) {
    to = from;
    add_increments(to, s);
    return to.position.allFinite() && to.velocity.allFinite();
  }
  to.time = from.time;
  to.drop_rests();
  if (known_.empty() && stops().shared() && options_.velocity == VelocitySeries::own_series) {
    foreseen_.at = s;
    return expansion().motion_sum(stops().degree(), series_.weights(0), s, to.position, to.velocity,
                                  foreseen_.accelerations);
  }
  weighted_sum(false, s, 0, to.position);
  weighted_sum(true, s, 0, to.velocity);
  return to.position.allFinite() && to.velocity.allFinite();
}

/// The state at the end of the step in compensated sums, s = h / time unit:   x + (s sum_{n>=1} w_n x_n s^(n-1)).
/// The rest of the velocity moves the position too.
void RandomTaylor::add_increments(State<double>& state, double s) const {
  for (auto* rest : {&state.position_rest, &state.velocity_rest})
    if (rest->size() == 0) rest->setZero(expansion().particles(), expansion().dimension());
  state.position_rest += s * expansion().time_unit() * state.velocity_rest;
  Coordinates<double> slope;
  weighted_sum(false, s, 1, slope);
  add_product(s, slope, state.position, state.position_rest);
  weighted_sum(true, s, 1, slope);
  add_product(s, slope, state.velocity, state.velocity_rest);
}

/// sum_{first<=n<=K} w_n c_n s^(n-first) by Horner's rule, c the series of the positions or that of the velocities.
void RandomTaylor::weighted_sum(bool of_velocity, double s, int first, Coordinates<double>& sum) const {
  if (!known_.empty()) return sum_of_known(of_velocity, s, first, sum);
  const bool derivative = of_velocity && options_.velocity == VelocitySeries::derivative;
  // With `derivative`, coefficient n of the velocity carries the weight of coefficient n + 1 of the position.
  const int offset = derivative ? 1 : 0;
  const auto last = [&](int degree) { return derivative ? degree - 1 : degree; };

  const int top = last(stops().largest_degree());
  if (stops().shared()) {
    const double* weight = series_.weights(0) + offset;
    if (of_velocity)
      expansion().velocity_sum(first, top, weight, s, sum);
    else
      expansion().position_sum(first, top, weight, s, sum);
    return;
  }
  sum.setZero(expansion().particles(), expansion().dimension());
  for (int n = top; n >= first; --n) {
    const auto c = of_velocity ? expansion().velocity(n) : expansion().position(n);
    for (int i = 0; i < expansion().particles(); ++i)
      if (n <= last(stops().degree(i)))
        sum.row(i) = sum.row(i) * s + series_.weights(i)[n + offset] * c.row(i);
  }
}

void RandomTaylor::count() {
  ++work_.steps;
  work_.updates += moving_;
  work_.coefficients += static_cast<std::uint64_t>(expansion().order() - 1) * moving_;
  work_.element_coefficients = expansion().element_coefficients();
  if (stops().shared()) {
    work_.degrees += static_cast<std::uint64_t>(stops().degree()) * moving_;
  } else {
    for (std::size_t i = 0; i < stops().draws(); ++i) work_.degrees += fixed_[i] ? 0 : stops().degree(i);
  }
}

void RandomTaylor::exchange(Member& member) {
  if (!along_.none())
    throw std::invalid_argument(
        "RandomTaylor: elements that come and go belong to one trajectory, not to many");
  series_.series().forget_ahead();
  std::swap(options_.seed, member.seed);
  series_.stops().reseed(options_.seed);
  std::swap(update_, member.update);
  std::swap(changes_, member.changes);
  control_.exchange(member);
  series_.forget_unit();
}

std::unique_ptr<Integrator> taylor(const System<double>& system, int degree, std::unique_ptr<Control> control,
                                   const RandomTaylor::Options& options) {
  return std::make_unique<RandomTaylor>(system, fixed_degree(degree), std::move(control), options);
}

}  // namespace jetlag
