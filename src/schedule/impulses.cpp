// SPDX-License-Identifier: MIT
#include "jetlag/schedule/impulses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "jetlag/model/finite.hpp"

namespace jetlag {

namespace {

Report not_finite(const char* what, int particle, double time) {
  std::ostringstream text;
  text.precision(10);
  text
      << what << " particle " << particle << " at t = " << time << " is not finite or beyond "
      << largest_number
      << ": the force is singular there (particles that coincide?), or the motion has blown up; take shorter "
         "steps, and not such that they resonate";
  return {Outcome::non_finite, text.str(), particle};
}

bool in_range(double x) { return std::abs(x) < largest_number; }

}  // namespace

struct Impulses::Clock {
  double step;  // [s]
  std::vector<ElementBlocks<double>> laws;
  std::uint64_t elements = 0;
  std::vector<int> particles;       // that it pushes: none fixed
  std::vector<int> others{};        // that its elements read besides
  std::uint64_t rung = 0;           // how often
  double last = 0;                  // [s]: when
  std::vector<double> force{};      // then, on its particles: padded rows
  std::vector<double> set_aside{};  // the positions of others at their own times: padded rows
};

Impulses::Impulses(const Model<double>& model, std::string name, std::string owner)
    : EventDriven(name + " has one for each " + owner, "take longer steps"),
      model_(model),
      name_(std::move(name)),
      dimension_(model.dimension()),
      stride_(padded(model.dimension())) {}
Impulses::~Impulses() = default;

void Impulses::add_clock(double step, const std::vector<std::vector<int>>& elements,
                         std::vector<int> pushed) {
  Clock clock{.step = step, .laws = {}, .particles = std::move(pushed)};
  for (std::size_t g = 0; g < elements.size(); ++g) {
    if (elements[g].empty()) continue;
    const auto& law = model_.law(g);
    clock.laws.push_back(law.blocks(law.elements().law.force, kernels<double>(), elements[g]));
    clock.laws.back().reserve(1);
    clock.elements += elements[g].size();
    for (const int e : elements[g])
      for (const int i : law.particles_of(e))
        if (!std::ranges::binary_search(clock.particles, i)) clock.others.push_back(i);
  }
  std::ranges::sort(clock.others);
  const auto repeated = std::ranges::unique(clock.others);
  clock.others.erase(repeated.begin(), repeated.end());
  clocks_.push_back(std::move(clock));
}

// ---- the state -------------------------------------------------------------------------------------------

State<double> Impulses::at(double time) const {
  const auto n = static_cast<Eigen::Index>(model_.particles());
  State<double> state{time, Coordinates<double>(n, dimension_), Coordinates<double>(n, dimension_)};
  for (Eigen::Index i = 0; i < n; ++i)
    for (int c = 0; c < dimension_; ++c) {
      const double v = v_[i * stride_ + c];
      state.velocity(i, c) = v;
      state.position(i, c) = x_[i * stride_ + c] + (time - own_time_[i]) * v;
    }
  for (const Clock& clock : clocks_) {
    const double early = 0.5 * clock.step - (time - clock.last);
    for (std::size_t p = 0; p < clock.particles.size(); ++p) {
      const int i = clock.particles[p];
      for (int c = 0; c < dimension_; ++c)
        state.velocity(i, c) -= early * model_.inverse_mass(i) * clock.force[p * stride_ + c];
    }
  }
  return state;
}

/// Half an impulse of every clock.
bool Impulses::begin(const State<double>& state, double /*until*/, Report& report) {
  const std::size_t n = model_.particles();
  require_shape(state, static_cast<int>(n), dimension_);
  origin_ = last_ = state.time;
  own_time_.assign(n, state.time);
  f_.assign(n * stride_, 0.0);
  x_ = v_ = f_;
  for (std::size_t i = 0; i < n; ++i)
    for (int c = 0; c < dimension_; ++c) {
      x_[i * stride_ + c] = state.position(i, c);
      v_[i * stride_ + c] = state.velocity(i, c);
    }
  due_.clear();
  for (Clock& clock : clocks_) {
    clock.rung = 0;
    clock.force.assign(clock.particles.size() * stride_, 0.0);
    clock.set_aside.assign(clock.others.size() * stride_, 0.0);
    if (!push(clock, state.time, 0.5, report)) return false;
  }
  for (std::size_t c = 0; c < clocks_.size(); ++c)
    if (!schedule(static_cast<int>(c), report)) return false;
  return true;
}

// ---- the clocks ------------------------------------------------------------------------------------------

double Impulses::next_time() const {
  return due_.empty() ? std::numeric_limits<double>::infinity() : due_.front().time;
}

/// Until when clocks ring with the next one. Steps that are meant to have a ratio may differ from it by some roundings, of
/// which n steps make a share of the time, and so do times; or, given in decimals, by a billionth of a step.
double Impulses::together() const {
  if (due_.empty()) return next_time();
  const double now = next_time(), shortest = clocks_.front().step;
  const double rounding =
      8 * std::numeric_limits<double>::epsilon() * (std::abs(now) + std::abs(now - origin_));
  return now + std::min(1e-9 * shortest + rounding, 0.25 * shortest);
}

/// From here on the next clock rings.
double Impulses::reach() const {
  return due_.empty() ? next_time() : next_time() - (together() - next_time());
}

/// Its next time is that of its beginning plus a whole number of steps, rounded once.
bool Impulses::schedule(int number, Report& report) {
  Clock& clock = clocks_[number];
  const double next = std::fma(static_cast<double>(clock.rung + 1), clock.step, origin_);
  if (!(next > clock.last)) {
    std::ostringstream text;
    text.precision(10);
    text << "the step " << clock.step << " of " << clock.particles.size()
         << " particles at t = " << clock.last
         << " no longer changes the time; take longer steps or count the time from a later origin";
    report = {Outcome::step_underflow, text.str(), clock.particles.empty() ? -1 : clock.particles.front()};
    return false;
  }
  ++clock.rung;
  due_.push_back({next, number});
  std::ranges::push_heap(due_, std::greater<>());
  return true;
}

/// The particles of a clock go on to this time. On failure none of them is anywhere new that is not finite.
bool Impulses::drift(const Clock& clock, double time, const Observer& observer, Report& report) {
  for (const int i : clock.particles) {
    const double h = time - own_time_[i];
    if (h <= 0) continue;
    for (int c = 0; c < dimension_; ++c)
      if (!in_range(x_[i * stride_ + c] + h * v_[i * stride_ + c])) {
        report = not_finite("the position of", i, time);
        return false;
      }
    if (observer.on_update) observer.on_update({i, own_time_[i], h, 1});
    for (int c = 0; c < dimension_; ++c) x_[i * stride_ + c] += h * v_[i * stride_ + c];
    own_time_[i] = time;
  }
  return true;
}

/// v += share h F / m on the particles of a clock, where they and the others are now. On failure nothing has been pushed.
bool Impulses::push(Clock& clock, double time, double share, Report& report) {
  const auto row = [this](auto& rows, std::size_t i) { return std::span(&rows[i * stride_], stride_); };
  for (std::size_t p = 0; p < clock.others.size(); ++p) {
    const int i = clock.others[p];
    std::ranges::copy(row(x_, i), row(clock.set_aside, p).begin());
    for (int c = 0; c < dimension_; ++c) x_[i * stride_ + c] += (time - own_time_[i]) * v_[i * stride_ + c];
  }
  for (auto& law : clock.laws) {
    const MotionRows<double> motion{x_.data(), nullptr, 0, time, 1.0};
    law.push_all(0, 1, motion, f_.data());
  }
  for (std::size_t p = 0; p < clock.others.size(); ++p) {
    const int i = clock.others[p];
    std::ranges::copy(row(clock.set_aside, p), row(x_, i).begin());
    std::ranges::fill(row(f_, i), 0.0);
  }
  work_.element_coefficients += clock.elements;

  const double h = share * clock.step;
  for (const int i : clock.particles)
    for (int c = 0; c < dimension_; ++c) {
      const std::size_t r = i * stride_ + c;
      const double v = v_[r] + h * model_.inverse_mass(i) * f_[r];
      if (!in_range(v) || !in_range(x_[r] + clock.step * v)) {
        report = not_finite("the force on", i, time);
        return false;
      }
    }
  for (std::size_t p = 0; p < clock.particles.size(); ++p) {
    const int i = clock.particles[p];
    for (int c = 0; c < dimension_; ++c) {
      const std::size_t r = i * stride_ + c;
      v_[r] += h * model_.inverse_mass(i) * f_[r];
      clock.force[p * stride_ + c] = f_[r];
      f_[r] = 0.0;
    }
  }
  clock.last = time;
  return true;
}

/// Straight lines; between impulses the velocity of `at` is linear in time.
Piece Impulses::piece(double begin, double end) const {
  const State<double> from = at(begin), to = at(end);
  const double h = end - begin;
  return {begin,
          end,
          {from.position, (to.position - from.position) / h},
          {from.velocity, (to.velocity - from.velocity) / h}};
}

/// All clocks that ring at the next time, but for the rounding of times: 10 steps of 0.1 and one of 1 end together.
bool Impulses::next_event(const Observer& observer, Report& report) {
  const double now = next_time(), end = together();
  ++work_.steps;
  ringing_.clear();
  while (next_time() <= end) {
    std::ranges::pop_heap(due_, std::greater<>());
    ringing_.push_back(due_.back().clock);
    due_.pop_back();
  }
  std::ranges::sort(ringing_);
  for (const int number : ringing_)
    if (!drift(clocks_[number], now, observer, report)) return false;
  for (const int number : ringing_) {
    Clock& clock = clocks_[number];
    if (!push(clock, now, 1.0, report)) return false;
    last_ = now;
    work_.updates += clock.particles.size();
    work_.degrees += clock.particles.size();
    work_.coefficients += clock.particles.size();
    if (!schedule(number, report)) return false;
  }
  return true;
}

}  // namespace jetlag
