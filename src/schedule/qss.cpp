// SPDX-License-Identifier: MIT
#include "jetlag/schedule/qss.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "jetlag/base/text.hpp"
#include "jetlag/integrators/accelerations.hpp"
#include "schedule/departure.hpp"
#include "schedule/quantized_forces.hpp"

namespace jetlag {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Whole numbers in the order of the times, for the queue.
EventQueue::Time ordinal(double time) {
  if (time == never) return EventQueue::never;
  const auto bits = std::bit_cast<std::int64_t>(time + 0.0);  // -0 becomes 0
  return bits >= 0 ? bits : std::numeric_limits<std::int64_t>::min() - bits;
}

void require_max_step(const System<double>& system, double max_step) {
  for (const auto& group : system.elements()) {
    if (group.count() == 0 || max_step < never) continue;
    const auto& nodes = group.law.force.nodes;
    const auto ends = group.law.force.ends_at_order_0();
    const bool time = std::ranges::any_of(nodes, [](const Node& node) {
      return node.kind == Node::Kind::input && node.input.kind == Input::Kind::time;
    });
    if (time || std::ranges::find(ends, true) != ends.end())
      throw std::invalid_argument(
          "qss renews a force where a quantized state changes; that of " + group.law.name +
          (time ? " depends on the time" : " has a border, which nobody may notice") + ": give a max_step");
  }
}

/// A force is kept for each pair of particles, or for one.
void require_pairs(const System<double>& system) {
  for (const auto& group : system.elements())
    if (group.count() > 0 &&
        (group.law.participants > 2 || (group.law.participants == 2 && group.law.is_external())))
      throw std::invalid_argument("qss knows forces on one particle and between two; " + group.law.name +
                                  (group.law.participants == 2
                                       ? " gives the forces on both of two by themselves"
                                       : " acts on " + std::to_string(group.law.participants)) +
                                  ": leave it out or take another integrator");
}

/// The polynomial about a point at the distance s.
template <std::size_t N>
void shift(std::array<double, N>& c, double s) {
  for (std::size_t first = 0; first + 1 < N; ++first)
    for (std::size_t k = N - 1; k > first; --k) c[k - 1] += s * c[k];
}

bool finite(const std::array<double, 4>& c) {
  return std::ranges::all_of(c, [](double k) { return std::isfinite(k); });
}

}  // namespace

Qss::Qss(const System<double>& system, const Options& options)
    : EventDriven("qss has one for each component", "take a larger quantum"),
      options_(options),
      dimension_(system.dimension()),
      particles_(system.particles()),
      fixed_(system.fixed()),
      components_(2 * static_cast<std::size_t>(particles_) * dimension_),
      queue_(2 * particles_ * dimension_) {
  if (options.order < 1 || options.order > 3)
    throw std::invalid_argument("qss: the order must be 1, 2 or 3, got " + std::to_string(options.order));
  require_positive("quantum", options.quantum);
  require_positive("velocity_quantum", options.velocity_quantum);
  if (!(options.max_step > 0))
    throw std::invalid_argument("qss: max_step must be > 0, got " + shown(options.max_step));
  require_pairs(system);
  require_max_step(system, options.max_step);
  forces_ = std::make_unique<QuantizedForces>(
      system, options.order, [this](int kind, int particle, double time, double* to, std::size_t next) {
        for (int c = 0; c < dimension_; ++c) {
          const Component& component = components_[number(kind, particle, c)];
          auto q = component.q;
          shift(q, time - component.q_time);
          for (int k = 0; k < options_.order; ++k) to[k * next + c] = q[k];
        }
      });
}

Qss::~Qss() = default;

// ---- the state -------------------------------------------------------------------------------------------

State<double> Qss::at(double time) const {
  State<double> state{time, Coordinates<double>(particles_, dimension_),
                      Coordinates<double>(particles_, dimension_)};
  for (int i = 0; i < particles_; ++i)
    for (int c = 0; c < dimension_; ++c)
      for (int kind = 0; kind < 2; ++kind) {
        const Component& component = components_[number(kind, i, c)];
        (kind == 0 ? state.position : state.velocity)(i, c) = horner(component.x, time - component.x_time);
      }
  return state;
}

Piece Qss::piece(double begin, double end) const {
  const Coefficients zeros(options_.order + 1, particles_, dimension_);
  Piece piece{begin, end, zeros, zeros};
  for (int i = 0; i < particles_; ++i)
    for (int c = 0; c < dimension_; ++c)
      for (int kind = 0; kind < 2; ++kind) {
        const Component& component = components_[number(kind, i, c)];
        auto x = component.x;
        shift(x, begin - component.x_time);
        for (int k = 0; k <= options_.order; ++k)
          (kind == 0 ? piece.position : piece.velocity)[k](i, c) = x[k];
      }
  return piece;
}

Report Qss::not_finite(const char* what, int particle, double time) const {
  std::ostringstream text;
  text.precision(10);
  text << what << " particle " << particle << " at t = " << time
       << " is not finite: the force is singular there (particles that coincide?), or the motion has blown "
          "up; "
          "take a smaller quantum";
  return {Outcome::non_finite, text.str(), particle};
}

/// From the values alone: each pass over all particles gives their quantized polynomials one coefficient more.
bool Qss::begin(const State<double>& state, double /*until*/, Report& report) {
  require_shape(state, particles_, dimension_);
  last_ = state.time;
  told_.assign(particles_, state.time);
  for (int i = 0; i < particles_; ++i)
    for (int c = 0; c < dimension_; ++c)
      for (int kind = 0; kind < 2; ++kind) {
        Component& component = components_[number(kind, i, c)];
        component = {.x_time = state.time, .q_time = state.time, .due = never};
        component.x[0] = component.q[0] = (kind == 0 ? state.position : state.velocity)(i, c);
        queue_.set(number(kind, i, c), EventQueue::never);
      }
  for (int pass = 1; pass <= options_.order; ++pass) {
    for (int i = 0; i < particles_; ++i)
      if (!fixed_[i] && !forces_->renew(0, i, state.time)) {
        report = not_finite("the force on", i, state.time);
        return false;
      }
    for (int i = 0; i < particles_; ++i)
      if (!fixed_[i]) {
        for (int c = 0; c < dimension_; ++c) move(i, c, state.time);
        if (!push(i, state.time, report)) return false;
      }
    if (pass < options_.order)
      for (Component& component : components_) component.q[pass] = component.x[pass];
  }
  for (int v = 0; v < static_cast<int>(components_.size()); ++v)
    if (!fixed_[v / dimension_ % particles_]) schedule(v, state.time);
  return true;
}

// ---- events ----------------------------------------------------------------------------------------------

double Qss::next_time() const { return queue_.empty() ? never : components_[queue_.clock()].due; }

/// x about a time. False where it is not finite; then it stays.
bool Qss::advance(Component& component, double time) const {
  auto x = component.x;
  shift(x, time - component.x_time);
  if (!finite(x)) return false;
  component.x = x;
  component.x_time = time;
  return true;
}

/// x' = q_v, for a component whose x is about `time`.
void Qss::move(int particle, int component, double time) {
  Component& x = components_[number(0, particle, component)];
  const Component& v = components_[number(1, particle, component)];
  auto q = v.q;
  shift(q, time - v.q_time);
  for (int k = 0; k < options_.order; ++k) x.x[k + 1] = q[k] / (k + 1);
}

/// v' = F / m.
bool Qss::push(int particle, double time, Report& report) {
  const auto a = forces_->acceleration(particle, time);
  for (int c = 0; c < dimension_; ++c) {
    Component& v = components_[number(1, particle, c)];
    auto x = v.x;
    shift(x, time - v.x_time);
    for (int k = 0; k < options_.order; ++k) x[k + 1] = a[k][c] / (k + 1);
    if (!finite(x)) {
      report = not_finite("the velocity of", particle, time);
      return false;
    }
    v.x = x;
    v.x_time = time;
  }
  work_.coefficients += options_.order;
  return true;
}

/// The event of a component whose x is about `time`.
void Qss::schedule(int number, double time) {
  Component& component = components_[number];
  auto q = component.q;
  shift(q, time - component.q_time);
  Cubic distance = component.x;
  for (int k = 0; k < options_.order; ++k) distance[k] -= q[k];
  const bool position = number < particles_ * dimension_;
  const double s = first_departure(distance, position ? options_.quantum : options_.velocity_quantum);
  component.due = std::min(time + s, component.q_time + options_.max_step);
  component.due = std::max(component.due, time);
  queue_.set(number, ordinal(component.due));
}

void Qss::tell(int particle, double time, const Observer& observer) {
  const double begin = std::exchange(told_[particle], time);
  if (!observer.on_update || !(time > begin)) return;
  int degree = options_.order;
  const auto is_zero = [&](int c) { return components_[number(0, particle, c)].x[degree] == 0; };
  const auto all_zero = [&] {
    for (int c = 0; c < dimension_; ++c)
      if (!is_zero(c)) return false;
    return true;
  };
  while (degree > 0 && all_zero()) --degree;
  observer.on_update({particle, begin, time - begin, degree});
}

/// The first event that is due: q becomes x without its last coefficient, and all that depends on it is renewed.
bool Qss::next_event(const Observer& observer, Report& report) {
  const int v = queue_.clock(), kind = v / (particles_ * dimension_), i = v / dimension_ % particles_;
  Component& component = components_[v];
  const double now = component.due;
  const char* const of = kind == 0 ? "the position of" : "the velocity of";
  if (now == component.q_time) {
    std::ostringstream text;
    text.precision(10);
    text << of << " particle " << i << " at t = " << now
         << " crosses its quantum in a step that no longer changes the time; take a larger quantum or count "
            "the "
            "time from a later origin";
    report = {Outcome::step_underflow, text.str(), i};
    return false;
  }
  Component& x = components_[number(0, i, v % dimension_)];
  if (!advance(component, now) || !advance(x, now)) {
    report = not_finite(of, i, now);
    return false;
  }
  last_ = now;
  tell(i, now, observer);
  std::copy_n(component.x.begin(), options_.order, component.q.begin());
  component.q_time = now;
  ++work_.steps;
  ++work_.updates;
  work_.degrees += options_.order;
  if (!forces_->renew(kind, i, now)) {
    report = not_finite("the force on", i, now);
    return false;
  }
  work_.element_coefficients = forces_->element_coefficients();
  if (kind == 1) {
    move(i, v % dimension_, now);
    schedule(number(0, i, v % dimension_), now);
  }
  schedule(v, now);
  for (const int j : forces_->pushed()) {
    if (!push(j, now, report)) return false;
    for (int c = 0; c < dimension_; ++c) schedule(number(1, j, c), now);
  }
  return true;
}

}  // namespace jetlag
