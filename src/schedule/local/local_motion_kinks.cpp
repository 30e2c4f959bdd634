// SPDX-License-Identifier: MIT
// Kinks of forces within the steps of particles, and whether a new series goes on where the former one was to lead.
#include <algorithm>
#include <cmath>

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

void LocalMotion::remember(std::span<const int> particles) {
  former_.clear();
  former_begin_.clear();
  former_degree_.clear();
  former_natural_.clear();
  former_series_.clear();
  if (to_kinks_.none()) return;
  for (int i : particles) {
    if (!to_kinks_.kinks().in_doubt(i)) continue;
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
