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

Stops stops_of(const System<double>& system, const Truncation& law, const RandomTaylor::Options& options) {
  if (options.shared_draw) return Stops(law, options.draws, options.seed);
  return Stops(law, options.draws, options.seed, system.fixed());
}

StoppedSeries<Expansion<double>> series_of(const System<double>& system, const Truncation& law,
                                           const RandomTaylor::Options& options) {
  Stops stops = stops_of(system, law, options);
  Expansion<double> series(system, stops.law().max_degree() + 1, kernels<double>(), Workers(options.threads));
  return {std::move(series), std::move(stops), order_needed(0, options.velocity)};
}

}  // namespace

RandomTaylor::RandomTaylor(const System<double>& system, Truncation law, std::unique_ptr<Control> control,
                           Options options)
    : options_(options),
      series_(series_of(system, law, options)),
      control_(system, std::move(control)),
      fixed_(system.fixed()),
      moving_(moving_particles(system)) {
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
  double h = up_to_change(proposal);
  if (is_stuck(state.time, report)) return 0.0;
  if (!advances(state.time, h)) {
    if (!all_finite(expansion(), report)) return short_step(state, limit, changes, report);
    report = step_underflow(expansion(), h);
    return 0.0;
  }
  proposed_ = h;
  if (!end(state, h, report)) return short_step(state, limit, changes, report);
  while (!agrees_with_forces(state, h)) {
    ++work_.rejected;
    changes_.take_none();
    const int particle = most_departed(h);
    h *= 0.5;
    if (!advances(state.time, h)) {
      report = {
          Outcome::step_underflow,
          "the force on particle " + std::to_string(particle) +
              " at the end of a step contradicts the series from its beginning at t = " + shown(state.time) +
              ", however short the step: the force is singular or jumps there; end before, or write it with "
              "select, abs, min or max, which are watched",
          particle};
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

// ---- the forces at the end -----------------------------------------------------------------------------------

/// Whether they are those to which the series leads; always for steps that are given.
bool RandomTaylor::agrees_with_forces(const State<double>& from, double h) {
  if (ahead_ < 2) return true;
  StepDefect defect = defect_at_end(from, h);
  if (control_.is_given() && !changes_.is_to_change()) return add_to_ledger(from, defect);
  bool is_right = is_allowed(defect) || changes_.is_instant() || (h == proposed_ && agrees_but_for_kinks(h));
  // Just beyond a change they have gone another way: a little before.
  if (const double before = h * (1 - 0x1p-20);
      !is_right && changes_.is_to_change() && advances(from.time, before)) {
    sum(from, before, next_);
    defect = defect_at_end(from, before);
    sum(from, h, next_);
    is_right = is_allowed(defect) || from.time + before == from.time + h;
  }
  if (!control_.is_given()) return is_right;
  if (is_right) defect.force = 0;
  return add_to_ledger(from, defect);
}

/// Of a step that is given. A defect that is no larger than 4 times one that the terms have explained in the last 16 steps is
/// taken for explained too: norms of coefficients cost as much as sums. Always true.
bool RandomTaylor::add_to_ledger(const State<double>& from, const StepDefect& defect) {
  ledger_.begin(from.position);
  const auto who = [&] { return most_departed(defect.step); };
  bool is_right = defect.force <= 4 * explained_.force && explained_.steps < 16;
  if (is_right) {
    ++explained_.steps;
  } else {
    is_right = is_allowed(defect);
    explained_ = {is_right ? defect.force : 0.0, is_right ? ratio_of_orders(defect) : 1.0, 0};
  }
  const int degree = stops().degree();
  if (!is_right)
    ledger_.add(defect, defect.force, defect.force / defect.step, next_.position, who);
  else if (stops().law().is_fixed())
    ledger_.add(defect, left_out(defect), (degree + 2) * explained_.ratio * left_out(defect) / defect.step,
                next_.position, who);
  else
    ledger_.add(defect, 0, 0, next_.position, who);
  return true;
}

/// What a fixed degree N leaves out of the positions in a step, |x_{N+1}| h^{N+1}, as the defect tells it, 64 times: errors
/// grow faster than in a free motion where bodies pass each other (measured on a planet of e = .9).
double RandomTaylor::left_out(const StepDefect& defect) const {
  const int degree = stops().degree();
  return 64 * defect.force / (degree * (degree + 1));
}

/// |x_{N+2}| h / |x_{N+1}|, continued from the orders that are known: with it N + 2 times the error of the positions over h is what
/// is left out of velocities of their own series; of those from the derivative it is nearly 1.
double RandomTaylor::ratio_of_orders(const StepDefect& defect) const {
  const int degree = stops().degree();
  if (options_.velocity == VelocitySeries::derivative || expansion().order() <= degree) return 1.0;
  const double first = expansion().position_norm(degree - 1), last = expansion().position_norm(degree + 1);
  return first > 0 ? std::min(1.0, std::sqrt(last / first) * defect.step / expansion().time_unit()) : 1.0;
}

/// Whether they are right for all but the particles for whose kinks the step was shortened, and for these as far as it may end
/// beyond a kink, a tolerance of the path: not where the velocity changes there.
bool RandomTaylor::agrees_but_for_kinks(double h) const {
  const std::vector<int>& at_kinks = control_.at_kinks();
  if (at_kinks.empty()) return false;
  const double s = h / expansion().time_unit();
  int first = 0;
  Expansion<double>::Departure others, these;
  for (const int i : at_kinks) {
    take_departure(s, first, i, others);
    take_departure(s, i, i + 1, these);
    first = i + 1;
  }
  take_departure(s, first, expansion().particles(), others);
  const StepDefect of_these = defect_of(these, h);
  return is_allowed(defect_of(others, h)) &&
         of_these.force * control_.past_kinks() <= of_these.begun * of_these.begun / 16;
}

/// Of the state at the end, from which the next step will begin.
StepDefect RandomTaylor::defect_at_end(const State<double>& from, double h) {
  next_.time = from.time + h;
  series_.series().look_ahead(next_, ahead_);
  Expansion<double>::Departure all;
  take_departure(h / expansion().time_unit(), 0, expansion().particles(), all);
  return defect_of(all, h);
}

StepDefect RandomTaylor::defect_of(const Expansion<double>::Departure& departure, double h) const {
  const double s = h / expansion().time_unit();
  const auto motion = [&](int side) {
    return std::max(departure.velocity[side] * s, departure.acceleration[side] * s * s);
  };
  return {expansion().time(), h,         proposed_, departure.force * s * s,
          departure.position, motion(0), motion(1)};
}

/// Of the particles from first to before end, where the state ahead is the sum at s.
void RandomTaylor::take_departure(double s, int first, int end,
                                  Expansion<double>::Departure& departure) const {
  if (!known_.empty()) return take_departure_of_known(s, first, end, departure);
  if (foreseen_.at == s) return expansion().take_departure(foreseen_.accelerations, first, end, departure);
  if (stops().shared())
    return expansion().take_departure(stops().degree(), series_.weights(0), s, first, end, departure);
  for (int i = first; i < end; ++i)
    expansion().take_departure(stops().degree(i), series_.weights(i), s, i, i + 1, departure);
}

/// The particle with the largest defect.
int RandomTaylor::most_departed(double h) const {
  int most = -1;
  double largest = -1;
  for (int i = 0; i < expansion().particles(); ++i) {
    Expansion<double>::Departure own;
    take_departure(h / expansion().time_unit(), i, i + 1, own);
    if (!(own.force > largest)) continue;
    largest = own.force;
    most = i;
  }
  return most;
}

bool RandomTaylor::is_allowed(const StepDefect& defect) const {
  const double s = defect.step / expansion().time_unit();
  const auto size = [&](int n) { return expansion().position_norm(n) * std::pow(s, n); };
  const auto weight = [&](int n) {  // the largest of those that have been drawn
    double most = 1;
    for (std::size_t draw = 0; draw < stops().draws(); ++draw)
      if (n <= stops().degree(draw)) most = std::max(most, series_.weights(draw)[n]);
    return most;
  };
  return jetlag::is_allowed(defect, stops().law(), control_.is_given() ? 0.0 : control_.past_kinks(),
                            control_.is_given(), weight, expansion().order(), size);
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
