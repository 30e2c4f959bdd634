// SPDX-License-Identifier: MIT
// What the barriers of a surface do along a motion, counted.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "contact/barrier_along.hpp"

namespace jetlag {

namespace {

/// How far the features of a stencil are apart at a time of a step [s].
double distance_at(const Stencil& stencil, const MotionAhead& motion, double time) {
  std::array<Eigen::Vector3d, 4> x;
  x.fill(Eigen::Vector3d::Zero());
  for (int i = 0; i < vertices_of(stencil.kind); ++i) {
    const PathView path = motion.path(stencil.vertices[i]);
    for (int n = path.degree; n >= 0; --n)
      for (int c = 0; c < path.dimension; ++c)
        x[i][c] = x[i][c] * (time / path.unit) +
                  (path.weights ? path.weights[n] : 1.0) * path.c_0[n * path.stride + c];
  }
  return closest(stencil.kind, std::span(x).first(vertices_of(stencil.kind))).distance;
}

}  // namespace

/// The smallest gap of a step that is at hand: at eighths of it, and at the lowest point of the parabola through the lowest one
/// and those beside it. A step keeps half of a gap, so that most need not be looked at.
void BarrierAlong::foresee(const MotionAhead& motion, double h) {
  tested_ += awake_.size();
  foreseen_ = {};
  const double smallest = contact_->record->smallest_gap.value;
  for (const int p : awake_) {
    const Pair& pair = pairs_[p];
    if (!pair.is_on || !(gap_of(distance_at(pair.stencil, motion, 0)) < 2.1 * smallest)) continue;
    constexpr int parts = 8;
    std::array<double, parts + 1> gaps;
    for (int j = 0; j <= parts; ++j) gaps[j] = gap_of(distance_at(pair.stencil, motion, h * j / parts));
    const auto lowest = std::ranges::min_element(gaps) - gaps.begin();
    double time = h * static_cast<double>(lowest) / parts, gap = gaps[lowest];
    if (0 < lowest && lowest < parts) {
      const double before = gaps[lowest - 1] - gap, after = gaps[lowest + 1] - gap;
      const double between = time + h / parts * 0.5 * (before - after) / (before + after);
      const double gap_between = gap_of(distance_at(pair.stencil, motion, between));
      if (gap_between < gap) time = between, gap = gap_between;
    }
    if (gap < foreseen_.gap) foreseen_ = {gap, time, motion.time(), pair.stencil};
  }
}

/// The pairs that act now, and what has been counted.
void BarrierAlong::record_changes() {
  ContactRecord& record = *contact_->record;
  record.stencils_tested += std::exchange(tested_, 0);
  record.crossings_tested += std::exchange(searched_, 0);
  record.looks += candidates_.looks() - std::exchange(looks_recorded_, candidates_.looks());
  std::vector<Stencil> active;
  const auto take = [&](const Pair& pair) {
    if (pair.is_on) active.push_back(pair.stencil);
  };
  if (first_of_.empty())  // one clock
    for (const int p : awake_) take(pairs_[p]);
  else
    std::ranges::for_each(pairs_, take);
  const auto without = [](const std::vector<Stencil>& all, const std::vector<Stencil>& others) {
    std::vector<Stencil> rest;
    std::ranges::set_difference(all, others, std::back_inserter(rest));
    return rest.size();
  };
  record.begun += without(active, active_);
  record.ended += without(active_, active);
  record.active_largest = std::max<std::uint64_t>(record.active_largest, active.size());
  active_ = std::move(active);
}

/// A step that was foreseen is taken as far as h.
void BarrierAlong::record_step(double h, const Coordinates<double>& position) {
  record_changes();
  ContactRecord& record = *contact_->record;
  Foreseen lowest = std::exchange(foreseen_, {});
  if (lowest.gap < record.smallest_gap.value && lowest.time > h) {  // the step became shorter
    std::array<Eigen::Vector3d, 4> x;
    x.fill(Eigen::Vector3d::Zero());
    for (int i = 0; i < vertices_of(lowest.stencil.kind); ++i)
      x[i].head(dimension_) = position.row(lowest.stencil.vertices[i]);
    lowest.gap =
        gap_of(closest(lowest.stencil.kind, std::span(x).first(vertices_of(lowest.stencil.kind))).distance);
    lowest.time = h;
  }
  if (!(lowest.gap < record.smallest_gap.value)) return;
  const auto particles = lowest.stencil.particles();
  record.smallest_gap = {lowest.gap, lowest.begin + lowest.time, {particles.begin(), particles.end()}};
}

/// With clocks of their own: the gap of a pair that acts, where a step of it begins.
void BarrierAlong::record_gap(const Stencil& stencil, double gap, double time) {
  ContactRecord::Gap& smallest = contact_->record->smallest_gap;
  if (!(gap < smallest.value)) return;
  const auto particles = stencil.particles();
  smallest = {gap, time, {particles.begin(), particles.end()}};
}

}  // namespace jetlag
