// SPDX-License-Identifier: MIT
// Kinks of forces and changes of their choices within the steps of particles, and whether a new series goes on where the former one was to lead.
#include <algorithm>
#include <cmath>
#include <utility>

#include "schedule/local/local_motion.hpp"

namespace jetlag {

/// A bound of how far a particle goes in h from a straight line:  sum_{n>=2} w_n |x_n| h^n.
template <int stride>
double LocalMotion::curve_padded(int particle, double h) const {
  const double *c = series(particle), *weights = stops_.weights();
  double sum[stride] = {}, squared = 0;
  for (int n = degree_[particle]; n >= 2; --n)
    for (int d = 0; d < stride; ++d) sum[d] = (sum[d] + weights[n] * std::abs(c[n * stride + d])) * h;
  for (double component : sum) squared += component * component;
  return std::sqrt(squared) * h;
}
double LocalMotion::curve(int particle, double h) const {
  if (stride_ == 1) return curve_padded<1>(particle, h);
  if (stride_ == 2) return curve_padded<2>(particle, h);
  return curve_padded<4>(particle, h);
}

namespace {

/// The series of all particles from a tick on.
class Now final : public Paths {
 public:
  Now(const LocalMotion& motion, Ticks::Count now) : motion_(motion), now_(now) {}
  double now() const override { return motion_.ticks().time(now_); }
  void velocity(int particle, double* v) const override {
    double x[3];
    motion_.evaluate(particle, since(particle), x, v);
  }
  void at(int particle, double s, double* x) const override {
    if (s == 0 && motion_.begin_of(particle) == now_)
      std::copy_n(motion_.series(particle), motion_.model().dimension(), x);
    else
      motion_.evaluate(particle, since(particle) + s, x, nullptr);
  }

 private:
  double since(int particle) const { return motion_.ticks().seconds(now_ - motion_.begin_of(particle)); }

  const LocalMotion& motion_;
  Ticks::Count now_;
};

}  // namespace

void LocalMotion::shorten_late(Count now, std::vector<Kinks::Step>& shortened) {
  double largest = 0;
  for (const Kinks::Step& step : to_kinks_.late()) {
    natural_[step.particle] = step_of(step.particle);
    largest = std::max(largest, norm_of(step.particle, 0));
  }
  const double depth = std::max(options_.tolerance, depth_of_rounding(largest));
  const auto shorter = to_kinks_.shortened(depth, Now(*this, now), degree(), 1.0,
                                           [&](int particle, int k) { return norm_of(particle, k); });
  shortened.assign(shorter.begin(), shorter.end());
}

/// How far [s] beyond the change of its choice the step of an element ends at least: some places of the time, more where that was
/// not enough for the next step to see it.
double LocalMotion::beyond_change(std::span<const int> particles, Count now) const {
  int instants = 0;
  for (int i : particles) instants = std::max(instants, std::abs(instants_[i]));
  return std::ldexp(std::max(StepsToKinks::least(ticks_.time(now)), ticks_.seconds(1)),
                    std::min(instants, 20));
}

/// left(i): what is left of the step of a particle [s].
void LocalMotion::up_to_changes(Count now, std::span<const int> particles,
                                const std::function<double(int)>& left, std::vector<Kinks::Step>& shortened) {
  for (int i : particles) to_change_[i] = false;
  struct End {
    int particle;
    double h;         // [s]
    bool is_instant;  // to a change, and no longer than 2^12 times what it ends beyond that
    auto operator<=>(const End&) const = default;
  };
  std::vector<End> ends;
  const auto horizon = [&](std::span<const int> rows) {
    double most = 0;
    for (int i : rows)
      if (!model().fixed()[i]) most = std::max(most, left(i));
    return most;
  };
  const auto found = [&](std::span<const int> rows, double s, bool is_change) {
    const double beyond = beyond_change(rows, now), h = is_change ? s + beyond : s;
    for (int i : rows)
      if (!model().fixed()[i] && h < left(i)) ends.push_back({i, h, is_change && h <= 0x1p12 * beyond});
  };
  if (updated_)
    updated_->find_changes(order_, horizon, found);
  else
    all_.find_changes(horizon, found);
  std::ranges::sort(ends);                               // of each particle the nearest first
  for (int i : particles) instants_[i] = -instants_[i];  // below 0: not yet seen to go on
  int last = -1;
  for (const auto& [i, h, is_instant] : ends) {
    if (i == std::exchange(last, i)) continue;
    natural_[i] = step_of(i);
    to_change_[i] = true;
    shortened.push_back({i, h, 0.0});
    if (begin_[i] == now && is_instant) instants_[i] = std::abs(instants_[i]) + 1;
  }
  for (int i : particles) {
    // A step that is as short without a change, as one after such a step may be, neither counts nor ends the row.
    const bool goes_on = left(i) > 0x1p12 * beyond_change({&i, 1}, now);
    if (instants_[i] < 0) instants_[i] = goes_on ? 0 : -instants_[i];
    if (instants_[i] >= 100) sliding_ = i;
  }
}

void LocalMotion::remember(std::span<const int> particles) {
  former_.clear();
  former_begin_.clear();
  former_degree_.clear();
  former_natural_.clear();
  former_series_.clear();
  if (to_kinks_.none() && !watches_ && along_.none()) return;
  for (int i : particles) {
    if (!in_doubt(i) && !to_other_elements_[i]) continue;
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
  return most <= options_.tolerance * std::max(1.0, std::pow(reached, degree()));
}

}  // namespace jetlag
