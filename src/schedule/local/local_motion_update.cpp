// SPDX-License-Identifier: MIT
// New series: for a group of particles, expanded together about a tick, or for all.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "jetlag/base/text.hpp"
#include "jetlag/integrators/integrator.hpp"
#include "jetlag/model/finite.hpp"
#include "schedule/local/local_motion.hpp"
#include "schedule/local/stopped_sum.hpp"

namespace jetlag {

/// What others are told of a particle: its series with the weights of its degree.
template <int stride>
void LocalMotion::told(int particle, double* to, std::size_t next_order) const {
  const double* c = series(particle);
  if (stops_.law().is_fixed()) {
    for (int n = 0; n <= order_; ++n)
      for (int d = 0; d < stride; ++d) to[n * next_order + d] = c[n * stride + d];
    return;
  }
  const double* weights = stops_.weights();
  for (int n = 0; n <= order_; ++n)
    for (int d = 0; d < stride; ++d)
      to[n * next_order + d] = n <= degree_[particle] ? weights[n] * c[n * stride + d] : 0.0;
}

void LocalMotion::told(int particle, double* to) const {
  if (stride_ == 1) return told<1>(particle, to, 1);
  if (stride_ == 2) return told<2>(particle, to, 2);
  told<4>(particle, to, 4);
}

bool LocalMotion::finite_series(const double* c, int particle, Count now, Report& report) const {
  for (std::size_t i = 0; i < size_; ++i) {
    if (std::isfinite(c[i])) continue;
    const int k = static_cast<int>(i / stride_);
    report = {Outcome::non_finite,
              "coefficient " + std::to_string(k) + " of the motion of particle " + std::to_string(particle) +
                  " is not finite at t = " + shown(ticks_.time(now)) + ": " + cause_of_no_coefficient(k) +
                  ", or the motion has blown up; start beside that place, soften the force or take a smaller "
                  "tolerance",
              particle};
    return false;
  }
  return true;
}

/// Whether the force on a particle at the end of its series, s [s] after it began, is the one to which this leads. c_2: coefficient
/// 2 of its position there. The defect d = s^2 |2 c_2 - x''| may be
///
///     2^16 eps max(|x|, s |v|, s^2 |a|) + 4 N (N+1) tolerance + 16 sum_{n>m} n (n-1) w_n |x_n| s^n
///   + 8 eps |t/s| sum_{n>2} n (n-1) (n-2) |x_n| s^n
///
/// much as in integrators/step_check.hpp, |.| at the beginning of the series, but with no limit by the motion of the particle,
/// which others may set in motion, and four times as much of the tolerance, by which neighbours may depart from their series. A
/// step that ends beyond a kink or the change of a choice is not looked at.
bool LocalMotion::agrees(int particle, double time, double s, const double* c_2, Report& report) const {
  if (updates_[particle] == 0 || !(s > 0) || in_doubt(particle)) return true;
  const double *c = series(particle), *weights = stops_.weights();
  double defect = 0;
  for (int d = 0; d < dimension_; ++d) {
    double led = 0;
    for (int n = degree_[particle]; n >= 2; --n)
      led = led * s + n * (n - 1) * weights[n] * c[n * stride_ + d];
    defect = std::max(defect, std::abs(2 * c_2[d] - led) * s * s);
  }
  const double tolerance = 4 * degree() * (degree() + 1) * options_.tolerance;
  if (!(defect > tolerance)) return true;
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const double position = norm_of(particle, 0), velocity = s * norm_of(particle, 1),
               force = 2 * s * s * norm_of(particle, 2);
  double allowed = tolerance + 0x1p16 * eps * std::max({position, velocity, force});
  double power = s;
  for (int n = 2; n <= order_; ++n) {
    power *= s;
    const double term = n * (n - 1) * norm_of(particle, n) * power;
    if (n > stops_.law().min_degree())
      allowed += 16 * (n <= degree() ? std::max(1.0, weights[n]) : 1.0) * term;
    allowed += 8 * eps * std::abs(time / s) * (n - 2) * term;
  }
  if (!(defect > allowed)) return true;
  report = {Outcome::contradicted,
            "the force on particle " + std::to_string(particle) + " at t = " + shown(time) +
                " contradicts its series of the last " + shown(s) +
                " s, which others have relied on: the force is singular or jumps there; write it with "
                "select, abs, min "
                "or max, which are watched, or take Lockstep, which takes such steps again",
            particle};
  return false;
}

void LocalMotion::publish(int particle, Count now, std::uint64_t group) {
  begin_[particle] = now;
  if (!stops_.law().is_fixed())
    degree_[particle] = options_.shared_draw
                            ? stops_.drawn(shared_by_all, group)
                            : stops_.drawn(static_cast<std::uint32_t>(particle), updates_[particle]);
  ++updates_[particle];
  work_.degrees += degree_[particle];
}

void LocalMotion::count(std::size_t updated) {
  ++groups_;
  ++work_.steps;
  work_.updates += updated;
  work_.coefficients += static_cast<std::uint64_t>(order_ - 1) * updated;
  work_.element_coefficients = all_.element_coefficients() - at_ends_ + partial_coefficients_;
}

bool LocalMotion::update(PartialExpansion& group, Count now, Report& report) {
  const std::uint64_t before = group.element_coefficients();
  const bool done = stride_ == 1   ? update_padded<1>(group, now, report)
                    : stride_ == 2 ? update_padded<2>(group, now, report)
                                   : update_padded<4>(group, now, report);
  partial_coefficients_ += group.element_coefficients() - before;
  updated_ = &group;
  if (!done) return false;
  for (int i : group.active()) publish(i, now, groups_);
  count(group.active().size());
  return refresh_limits(now, report);
}

template <int stride>
bool LocalMotion::update_padded(PartialExpansion& group, Count now, Report& report) {
  const auto &active = group.active(), &known = group.known();
  const std::size_t next_order = group.next_order();
  const bool own = options_.velocity == VelocitySeries::own_series;
  for (std::size_t a = 0; a < active.size(); ++a)
    stopped_sum<stride>(series(active[a]), degree_[active[a]], stops_.weights(), own,
                        ticks_.seconds(now - begin_[active[a]]), group.active_row(0, a),
                        group.active_row(1, a));
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
  for (std::size_t a = 0; a < active.size(); ++a)
    if (!agrees(active[a], ticks_.time(now), ticks_.seconds(now - begin_[active[a]]), group.active_row(2, a),
                report))
      return false;
  for (std::size_t a = 0; a < active.size(); ++a) copy(a, series(active[a]));
  return true;
}

bool LocalMotion::update_all(Count now, Report& report) {
  updated_ = nullptr;
  all_.start(at_tick(now));
  all_.grow_to(order_);
  if (!all_finite(all_, report)) return false;
  for (int i : moving_)
    if (!agrees(i, ticks_.time(now), ticks_.seconds(now - begin_[i]), all_.position(2).row(i).data(), report))
      return false;
  for (int n = 0; n <= order_; ++n) {
    const auto x = all_.position(n);
    for (int i : moving_)
      for (int d = 0; d < dimension_; ++d) series(i)[n * stride_ + d] = x(i, d);
  }
  for (int i : moving_) publish(i, now, groups_);
  count(moving_.size());
  return refresh_limits(now, report);
}

bool LocalMotion::agree_at(double time, Report& report) {
  if (std::ranges::all_of(moving_, [&](int i) { return !(ticks_.since(begin_[i], time) > 0); })) return true;
  const std::uint64_t before = all_.element_coefficients();
  all_.start(at(time));
  all_.grow_to(2);
  at_ends_ += all_.element_coefficients() - before;
  if (!all_.position(2).allFinite()) return true;  // said by whoever goes on from there
  return std::ranges::all_of(moving_, [&](int i) {
    return agrees(i, time, ticks_.since(begin_[i], time), all_.position(2).row(i).data(), report);
  });
}

}  // namespace jetlag
