// SPDX-License-Identifier: MIT
// How far the pairs of a surface stay what they are.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "contact/barrier_along.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/series/calculus/first_change.hpp"
#include "jetlag/series/jet.hpp"

namespace jetlag {

using namespace barrier_switch;

namespace {

using MotionSeries = Jet<double, Dynamic>;

/// About the time of the motion, of the vertices of a stencil.
struct Views {
  std::array<PathView, 4> path;
  int count;

  Views(const Stencil& stencil, const MotionAhead& motion) : path{}, count(vertices_of(stencil.kind)) {
    for (int i = 0; i < count; ++i) path[i] = motion.path(stencil.vertices[i]);
  }
  std::span<const PathView> all() const { return std::span(path).first(count); }

  double coefficient(int i, int n, int d) const {
    const PathView& p = path[i];
    if (n > p.degree || d >= p.dimension) return 0;
    return p.c_0[n * p.stride + d] * (p.weights ? p.weights[n] : 1.0);
  }
  std::array<Vector3<double>, 4> at(double s) const {
    std::array<Vector3<double>, 4> x;
    x.fill(Vector3<double>::Zero());
    for (int i = 0; i < count; ++i)
      for (int n = s == 0 ? 0 : path[i].degree; n >= 0; --n)
        for (int d = 0; d < 3; ++d) x[i][d] = x[i][d] * (s / path[i].unit) + coefficient(i, n, d);
    return x;
  }
  double distance_at(StencilKind kind, double s) const {
    const auto x = at(s);
    return closest(kind, std::span(x).first(count)).distance;
  }

  /// How much nearer to each other the two sides may come within h [m].
  double stray(StencilKind kind, double h) const {
    double of_side[2] = {};
    for (int i = 0; i < count; ++i) {
      const double s = h / path[i].unit, s_last = h / path[count - 1].unit;
      double square = 0, curve = 0;
      for (int d = 0; d < 3; ++d) {
        const double v = coefficient(i, 1, d) * s - coefficient(count - 1, 1, d) * s_last;
        square += v * v;
      }
      for (int n = path[i].degree; n >= 2; --n) {
        double size = 0;
        for (int d = 0; d < path[i].dimension; ++d) size += std::abs(coefficient(i, n, d));
        curve = (curve + size) * s;
      }
      double& side = of_side[i < first_side(kind) ? 0 : 1];
      side = std::max(side, std::sqrt(square) + curve * s);
    }
    return of_side[0] + of_side[1];
  }
};

/// Where rounding hides on which side of a switch a pair is, the change is found at once: it is just after [s].
double least_step(double now, double h) { return std::max(rounding_of_time(now), h * 0x1p-40); }

}  // namespace

double BarrierAlong::up_to_change(const PositionSeries& position, double h, Report& report) {
  const SeriesAhead motion(position, dimension_, h);
  h = candidates_.cover(motion, h);
  if (!candidates_.are_finite()) return h;  // a matter of the method
  take_candidates();
  wake_pairs(position.time + h);
  for (const int p : awake_) {
    h = up_to_change(pairs_[p], motion, h);
    if (h > 0) continue;
    report = underflow(pairs_[p], position.time);
    return 0.0;
  }
  if (contact_->record) foresee(motion, h);
  return h;
}

/// Those that tracks and rooms do not keep from turning on up to a time, and all that were awake before and still are to be.
void BarrierAlong::wake_pairs(double end) {
  constexpr auto later = std::greater<>();
  std::erase_if(awake_, [&](int p) {
    if (pairs_[p].is_on || !(end <= pairs_[p].safe_until)) return false;
    asleep_.emplace_back(pairs_[p].safe_until, p);
    std::ranges::push_heap(asleep_, later);
    return true;
  });
  const std::size_t before = awake_.size();
  for (; !asleep_.empty() && !(end <= asleep_.front().first); asleep_.pop_back()) {
    awake_.push_back(asleep_.front().second);
    std::ranges::pop_heap(asleep_, later);
  }
  if (awake_.size() > before) std::ranges::sort(awake_);
}

Report BarrierAlong::underflow(const Pair& pair, double time) const {
  return {Outcome::step_underflow,
          "the gap between " + names_of(pair.stencil) + " at t = " + shown(time) +
              " is below the rounding of their positions; take a stiffer or thicker contact",
          pair.stencil.vertices[0]};
}

/// Whether a pair that does not act keeps its distance for h.
bool BarrierAlong::is_far(Pair& pair, double now, double h) const {
  if (pair.is_on) return false;
  if (now + h <= pair.safe_until) return true;
  pair.safe_until = candidates_.apart_until(pair.stencil, now, contact_->gap + contact_->thickness);
  return now + h <= pair.safe_until;
}

double BarrierAlong::up_to_change(Pair& pair, const MotionAhead& motion, double h) {
  pair.change = Change::none;
  pair.is_near = false;
  if (is_far(pair, motion.time(), h)) return h;
  const double gap = gap_of(Views(pair.stencil, motion).distance_at(pair.stencil.kind, 0));
  const double reach = contact_->gap + (pair.is_on ? gap / 2 : contact_->thickness * (1 - hysteresis));
  const auto time = first_approach(pair.stencil, motion, h, reach);
  pair.is_near = pair.is_on || time.has_value();
  if (time && pair.is_on) {
    if (!(*time > 0)) return 0.0;
    h = std::min(h, *time);
  } else if (time) {
    pair.change = Change::on;
    pair.time = std::max(*time, least_step(motion.time(), h));
    h = std::min(h, pair.time);
  }
  return pair.is_on ? up_to_other_region(pair, motion, h) : h;
}

/// The first time [s] within a step at which a pair is nearer than that [m].
std::optional<double> BarrierAlong::first_approach(const Stencil& stencil, const MotionAhead& motion,
                                                   double h, double reach) {
  const Views views(stencil, motion);
  if (views.distance_at(stencil.kind, 0) - views.stray(stencil.kind, h) > reach) return {};
  ++searched_;
  return approach_.first(stencil.kind, views.all(), h, reach);
}

/// A pair that acts: the switch where it turns off, the borders of its region, and of how its edges lie.
double BarrierAlong::up_to_other_region(Pair& pair, const MotionAhead& motion, double h) const {
  const Stencil& stencil = pair.stencil;
  const Views views(stencil, motion);
  int degree = 0;
  for (const PathView& path : views.all()) degree = std::max(degree, path.degree);
  std::array<Vector3<MotionSeries>, 4> x;
  std::vector<double> c(degree + 1);
  const double unit = h;  // of the series: they may have others
  for (int i = 0; i < views.count; ++i)
    for (int d = 0; d < 3; ++d) {
      double power = 1;
      for (int n = 0; n <= degree; ++n, power *= unit / views.path[i].unit)
        c[n] = views.coefficient(i, n, d) * power;
      x[i][d] = MotionSeries::from(c);
    }
  const std::span<const Vector3<MotionSeries>> all(x.data(), static_cast<std::size_t>(views.count));
  double most = 1;
  const auto ends = [&](Change change, double time) {
    pair.change = change;
    pair.time = std::max(time, least_step(motion.time(), h));
    most = std::min(most, pair.time / unit);
  };
  const auto stays = [&](const MotionSeries& condition, Change change) {
    if (!(condition[0] >= 0)) {
      // Left behind by rounding: the end of the step tells. With clocks it needs an end that all four have together.
      if (aim_ > 1 && (change != Change::region || acts_otherwise(pair, views.at(0)))) ends(change, 0);
      return;
    }
    std::optional<double> first;
    find_first_change<double>(
        std::span<const double>(condition.coefficients().data(), condition.degree() + 1), 1, most, first);
    if (first) ends(change, *first * unit);
  };
  const double off = contact_->gap + contact_->thickness * (1 + aim_ * hysteresis);
  const auto region = region_of<MotionSeries>(stencil.kind, pair.support, all, aim_ * band);
  stays(MotionSeries(off * off) - region.square, Change::off);
  for (const MotionSeries& condition : region.conditions) stays(condition, Change::region);
  if (stencil.kind == StencilKind::edge_edge) {
    const MotionSeries sine = squared_sine(all);
    const double scale = parallel_below(stencil);
    const auto stays_above = [&](double part) {
      stays(sine - MotionSeries(part * scale * (1 - aim_ * hysteresis)), Change::region);
    };
    const auto stays_below = [&](double part) {
      stays(MotionSeries(part * scale * (1 + aim_ * hysteresis)) - sine, Change::region);
    };
    if (pair.lie == Lie::any) stays_above(nearly_parallel_below);
    if (pair.lie == Lie::nearly_parallel) {
      stays_below(nearly_parallel_below);
      stays_above(barrier_switch::parallel_below);
    }
    if (pair.lie == Lie::parallel) stays_below(barrier_switch::parallel_below);
  }
  return std::min(h, most * unit);
}

bool BarrierAlong::is_safe(const PositionSeries& position, double h, bool is_given, Report& report) {
  const SeriesAhead motion(position, dimension_, h);
  if (candidates_.cover(motion, h, is_given) < h) return false;
  if (!candidates_.are_finite()) return true;
  take_candidates();
  wake_pairs(position.time + h);
  for (const int p : awake_) {
    Pair& pair = pairs_[p];
    if (is_far(pair, position.time, h)) {
      pair.is_near = false;
      continue;
    }
    const Views views(pair.stencil, motion);
    const double gap = gap_of(views.distance_at(pair.stencil.kind, 0));
    // What is drawn at random may differ from what was looked at, and what is given was not looked at: but not by half of
    // what there is, nor to twice that: a force that grows as w^-8 has been passed over.
    const double reach = contact_->gap + (pair.is_on ? gap : contact_->thickness) / 2;
    pair.is_near = true;
    const bool leaps = is_given && pair.is_on && gap_of(views.distance_at(pair.stencil.kind, h)) > 2 * gap;
    if (!leaps && !first_approach(pair.stencil, motion, h, reach)) continue;
    if (is_given)
      report = {
          Outcome::contradicted,
          "the gap between " + names_of(pair.stencil) + ", " + shown(gap) + " m at t = " +
              shown(position.time) + ", changes by more than half in the given step of " + shown(h) +
              " s: the force of contact is passed over; take shorter steps, or a control that chooses them",
          pair.stencil.vertices[0]};
    return false;
  }
  if (contact_->record) foresee(motion, h);
  return true;
}

/// Of every pair with a particle that has a new series, up to the first end of a step of its particles: at that it is looked at
/// again.
bool BarrierAlong::find_changes(const MotionAhead& motion, std::span<const int> updated,
                                std::vector<ShorterStep>& shorter, Report& report) {
  aim_ = 2;
  const bool is_other = candidates_.cover(motion, updated);
  if (!candidates_.are_finite()) return true;
  take_candidates();
  list_pairs_of_particles();
  const double left = candidates_.until() - motion.time();
  const auto stay_in_rooms = [&](std::span<const int> particles) {
    for (const int i : particles)
      if (candidates_.has(i) && motion.left(i) > left) shorter.push_back({i, left});
  };
  stay_in_rooms(is_other ? std::span<const int>(candidates_.surface().vertices()) : updated);
  ++look_;
  const auto look_at = [&](Pair& pair) {
    if (std::exchange(pair.look, look_) == look_) return true;
    ++tested_;
    double most = std::numeric_limits<double>::infinity();
    for (const int i : pair.stencil.particles()) most = std::min(most, motion.left(i));
    const double h = up_to_change(pair, motion, most);
    if (contact_->record && pair.is_on)
      record_gap(pair.stencil, gap_of(Views(pair.stencil, motion).distance_at(pair.stencil.kind, 0)),
                 motion.time());
    if (h < most)
      for (const int i : pair.stencil.particles()) shorter.push_back({i, h});
    if (!(h > 0)) report = underflow(pair, motion.time());
    return h > 0;
  };
  if (is_other) return std::ranges::all_of(pairs_, look_at);
  for (const int i : updated)
    for (int p = first_of_[i]; p < first_of_[i + 1]; ++p)
      if (!look_at(pairs_[pairs_of_[p]])) return false;
  return true;
}

}  // namespace jetlag
