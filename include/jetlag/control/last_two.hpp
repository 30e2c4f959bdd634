// SPDX-License-Identifier: MIT
#pragma once
// The step from the last two coefficients and a tolerance in metres: for one particle, and for all at once.

#include <array>
#include <functional>

#include "jetlag/control/control.hpp"

namespace jetlag {

/// What the step of a particle is read from: the largest components of coefficients of its position.
struct LastTwoSizes {
  int degree;                   // N >= 1
  std::array<double, 2> first;  // orders 2 and 3: the acceleration and its change
  std::array<double, 2> last;   // orders N - 1 and N
};

/// Where the last two coefficients vanish: the last ones above order N/2 that do not, size(k) that of order k. A series
/// ends early or not at all, and others stand in for those that cancellation has taken.
template <class Size>
void stand_in(LastTwoSizes& sizes, const Size& size) {
  for (int k = sizes.degree - 1; k > sizes.degree / 2 && k > 1; --k) {
    if (size(k) == 0) continue;
    sizes.last = {size(k - 1), size(k)};
    sizes.degree = k;
    return;
  }
}

/// The step at which the last two terms are below the tolerance,
///
///     h = 0.7 min_{k = N-1, N} (tolerance / |c_k|)^{1/k},
///
/// and where the acceleration moves the particle by more than a millionth of the tolerance, no longer than 0.7 times
/// the step at which the last terms of the force reach the first ones, f_k = k (k - 1) c_k:
///
///     f_k h^{k-2} <= max(f_2, f_3 h),   k > 3.
///
/// The second rule keeps a step within the radius of convergence: without it particles that fall into each other would
/// step over their collision as soon as they are nearer than the tolerance.         Source: ours, by experiment.
/// infinity where the last coefficients vanish; 0 where a size is not a number or infinite.
double last_two_step(const LastTwoSizes& sizes, double tolerance);

/// The second of these rules alone, with f_2 alone and all orders: for a force that does not change much, though it may
/// turn, and whose series may be rounding in some orders and not in others. size(k): of coefficient k <= N.
template <class Size>
double step_within_radius(int degree, const Size& size) {
  double h = std::numeric_limits<double>::infinity();
  const double first = 2 * size(2);
  for (int k = 3; k <= degree && first > 0; ++k)
    if (const double force = k * (k - 1) * size(k); force > 0)
      h = std::min(h, 0.7 * std::pow(first / force, 1.0 / (k - 2)));
  return h;
}

/// Whether last_two_step is at least h: its two rules without logarithms, for one h > 0 and many particles. Within a few
/// rounding errors of h either answer may be given.
class LastTwoAllows {
 public:
  LastTwoAllows(int degree, double tolerance, double h);
  bool operator()(const LastTwoSizes& sizes) const;

 private:
  int degree_;
  double tolerance_, h_, s_;     // s = h / 0.7
  std::array<double, 2> power_;  // of s: N - 1 and N
  bool in_range_;                // of a double
};

/// One step for all particles: the shortest of theirs.
class LastTwo final : public Control {
 public:
  /// tolerance [m] > 0; max_step [s] > 0.   Throws std::invalid_argument.
  explicit LastTwo(double tolerance, double max_step = std::numeric_limits<double>::infinity());
  int orders_read(const TruncationLaw& law, VelocitySeries velocity) const override {
    return order_needed(law.max_degree(), velocity);
  }
  double propose(const Prospect& prospect) override;
  double past_kinks() const override { return tolerance_; }
  double longest() const override { return max_step_; }
  std::unique_ptr<Control> clone() const override { return std::make_unique<LastTwo>(*this); }

 private:
  double tolerance_, max_step_;
};

}  // namespace jetlag
