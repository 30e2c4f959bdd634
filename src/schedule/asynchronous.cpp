// SPDX-License-Identifier: MIT
#include "jetlag/schedule/asynchronous.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "jetlag/base/step_length.hpp"
#include "jetlag/base/text.hpp"
#include "schedule/local/local_motion.hpp"

namespace jetlag {

namespace {

/// A number of ticks times a factor; as many as a step may have at most.
Ticks::Count times(double factor, Ticks::Count ticks) {
  const double product = factor * static_cast<double>(ticks);
  return product < static_cast<double>(Ticks::step(0)) ? static_cast<Ticks::Count>(product) : Ticks::step(0);
}

}  // namespace

Asynchronous::Asynchronous(const System<double>& system, TruncationLaw law, const Options& options)
    : ParticleClocks(system, std::move(law), options), grading_(options.grading), notify_(options.notify) {
  if (!(grading_ >= 1))
    throw std::invalid_argument("Asynchronous: grading must be at least 1, got " + shown(grading_));
  require_positive("Asynchronous: notify", notify_, true);
  overlap_ = std::min(0.5, 5.0 / motion_->degree());
}
Asynchronous::~Asynchronous() = default;

void Asynchronous::begin_clocks() {
  const int particles = motion_->model().particles();
  queue_ = EventQueue(particles);
  for (int i : motion_->moving()) queue_.set(i, 0);
  step_.assign(particles, Ticks::step(0));
  natural_.assign(particles, Ticks::step(0));
  doubt_.assign(particles, 0.0);
  group_ = std::make_unique<PartialExpansion>(motion_->group());
}

bool Asynchronous::update(Report& report) {
  const Ticks::Count now = queue_.time();
  due_.clear();
  for (; queue_.time() == now; queue_.set(due_.back(), EventQueue::never)) due_.push_back(queue_.clock());
  const bool all = due_.size() == motion_->moving().size();
  if (motion_->change_elements(now, due_)) group_->move_to(motion_->model());
  expected_positions(now);
  if (!all) group_->choose(due_, motion_->places());
  if (!(all ? motion_->update_all(now, report) : motion_->update(*group_, now, report))) return false;
  if (!choose_steps(now, report)) return false;
  notify_neighbours(now);
  return true;
}

/// Those that rely on a particle are the neighbours that are not due.
void Asynchronous::expected_positions(Ticks::Count now) {
  expected_.clear();
  if (std::isinf(notify_)) return;
  for (int i : due_)
    for (int n : motion_->model().neighbours(i)) {
      const Ticks::Count end = motion_->begin_of(n) + step_[n];
      const std::size_t size = expected_.size();
      expected_.resize(size + 3, std::numeric_limits<double>::quiet_NaN());
      if (end > now && queue_.time_of(n) != EventQueue::never)
        motion_->position(i, end - motion_->begin_of(i), &expected_[size]);
    }
}

/// The first tick after one at which the time is another, by some places.
Ticks::Count Asynchronous::next_after(Ticks::Count now) const {
  const Ticks& ticks = motion_->ticks();
  const double places = 8 * std::numeric_limits<double>::epsilon() * std::abs(ticks.time(now));
  return now + std::max<Ticks::Count>(1, ticks.in(places));
}

void Asynchronous::notify_neighbours(Ticks::Count now) {
  if (std::isinf(notify_)) return;
  const int dimension = motion_->model().dimension();
  const double most = notify_ * motion_->options().tolerance;
  const double* expected = expected_.data();
  for (int i : due_)
    for (int n : motion_->model().neighbours(i)) {
      const double* before = expected;
      expected += 3;
      const Ticks::Count end = motion_->begin_of(n) + step_[n];
      if (std::isnan(before[0]) || queue_.time_of(n) == now) continue;
      std::array<double, 3> after{};
      motion_->position(i, end - now, after.data());
      double departure = 0;
      for (int c = 0; c < dimension; ++c) departure = std::max(departure, std::abs(after[c] - before[c]));
      doubt_[n] += departure;
      if (doubt_[n] > most) {
        // Who has been updated at this tick already, as one that comes over a kink, is so again at the next.
        const Ticks::Count next = motion_->begin_of(n) == now ? next_after(now) : now;
        if (next >= queue_.time_of(n)) continue;
        queue_.set(n, next);
        motion_->count_wake_up();
      }
    }
}

/// Steps for those that have been updated: shortened until none is too long for a neighbour, the same in any order.
bool Asynchronous::choose_steps(Ticks::Count now, Report& report) {
  const Ticks& ticks = motion_->ticks();
  std::vector<int> stuck;
  const auto underflows = [&](int i) {
    return step_[i] < 1 || !advances(ticks.time(now), ticks.seconds(step_[i]));
  };
  for (int i : due_) {
    natural_[i] = step_[i] = ticks.in(motion_->step_of(i));
    doubt_[i] = 0;
    if (underflows(i)) stuck.push_back(i);
  }
  motion_->up_to_kinks(now, due_, [&](int i) { return step_[i]; }, shortened_);
  if (motion_->sliding() >= 0) {
    report = sliding(now, motion_->sliding());
    return false;
  }
  if (motion_->elements().outcome != Outcome::success) {
    report = motion_->elements();
    return false;
  }
  for (const Kinks::Step& step : shortened_) {
    const int i = step.particle;
    const Ticks::Count end = now + std::max<Ticks::Count>(ticks.in(step.h), 1) - motion_->begin_of(i);
    if (end >= step_[i]) continue;
    step_[i] = end;
    if (queue_.time_of(i) == EventQueue::never) continue;  // due: its clock is set below
    queue_.set(i, motion_->begin_of(i) + end);
    motion_->count_wake_up();
  }
  for (bool changed = stuck.empty(); changed;) {
    changed = false;
    for (int i : due_)
      for (int n : motion_->model().neighbours(i)) {
        const Ticks::Count end = motion_->begin_of(n) + step_[n],
                           most =
                               std::min(times(grading_, step_[n]), end - now + times(overlap_, natural_[n]));
        if (step_[i] <= most) continue;
        step_[i] = most;
        changed = true;
      }
  }
  for (int i : due_)
    if (stuck.empty() && underflows(i)) stuck.push_back(i);
  if (!stuck.empty()) {
    report = underflow(now, stuck);
    return false;
  }
  for (int i : due_) queue_.set(i, now + step_[i]);
  return true;
}

}  // namespace jetlag
