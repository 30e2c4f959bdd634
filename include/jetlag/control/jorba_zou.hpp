// SPDX-License-Identifier: MIT
#pragma once
// The step of Jorba and Zou, from an estimate of the radius of convergence.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "jetlag/control/control.hpp"

namespace jetlag {

/// The degree for a tolerance: p = ceil(1 - ln(tol) / 2), at least 2.         Source: [JZ05] 3.2.
int jorba_zou_degree(double tolerance);

/// ln sigma, see jorba_zou_step.
inline double log_safety_of_jorba_zou(int degree) { return -2.0 - 0.5 / std::max(1, degree - 1); }

/// The largest step h <= max_step at which the last two terms are small against the largest of those before them,
///
///     c_q h^q <= sigma^q max_{n<q} c_n h^n   for q = p-1, p,      sigma = exp(-2 - 0.5 / (p-1)),
///
/// norms: c_n = |y_n|, the sizes of the coefficients 0 .. p of one kind of quantity (positions, say), p >= 1.
/// Where c_0 is the largest term this is Jorba and Zou's h = sigma min((c_0 / c_{p-1})^{1/(p-1)}, (c_0 / c_p)^{1/p}),
/// sigma times an estimate of the radius of convergence; the other terms take over where c_0 vanishes. The step goes
/// with the unit of time and does not depend on that of y. The accuracy follows from p: the first term left out is
/// some exp(-2p) of the largest.
/// Where the last two coefficients vanish, the last ones above order p/2 that do not stand in for them.
/// max_step where all of these vanish, or all before them; 0 where a norm is not finite.
/// Source: [JZ05] 3.2, with 0.5 in place of 0.7: 1 % fewer steps at p = 20.
/// Throws std::invalid_argument for fewer than two norms.
double jorba_zou_step(std::span<const double> norms, double max_step);

/// The sizes of the orders of a motion that its step is read from, times their order,
///
///     d_0 = |x_0|,   d_k = k |x_k| = u |v_{k-1}|,   k = 1, 2, p, p+1,      u: the unit of time.
struct EndsOfMotion {
  double position, velocity, acceleration;  // d_0, d_1, d_2
  double last[2];                           // d_p, d_{p+1}

  /// Whether all are normal numbers, and these orders not the same.
  bool are_regular(int p) const {
    return p > 2 && std::isnormal(position) && std::isnormal(velocity) && std::isnormal(acceleration) &&
           std::isnormal(last[0]) && std::isnormal(last[1]);
  }
};

/// log2 of the share C by which a position may outweigh the way in a step, see jorba_zou_step_of_sizes: of 16 from degree 20 on, of 1
/// below.
double log2_share_of_velocities(int p);

/// The step of a motion: that of jorba_zou_step for the velocities, whose last two terms are held to the largest of the positions,
/// too, where a velocity counts as the way in a step,
///
///     h |v_q| h^q <= sigma^q min(max(|x_0|, m), C m),   m = max_{n<q} h |v_n| h^n,   q = p-1, p.
///
/// What this leaves out of a velocity is small against what the rounding of positions makes of it, some eps |x_0| / h; and against
/// the velocity itself: C = 16 only where C sigma^p is below the rounding of a double, eps / 5 for p = 20. So the step does not
/// depend much on where the origin is. Positions, x_{q+1} = v_q / (q+1), lose less. One norm of positions and one of velocities,
/// each held to itself, took 7 % more steps of degree 20 on a pendulum, 8 % on a planet, 15 % on the outer Solar System, to errors
/// that rounding makes. What is left out of the energy of a planet, e = .5 and .9, is 7e-19 and 1.3e-17 a period, then 1.3e-19
/// and 3.5e-18, where rounding adds 2e-16 and 1e-15 to compensated sums (degree 20, the motion in 50 digits).
/// Where orders 1 and 2 vanish, or the last two, all are read; see jorba_zou_step for what takes their place.
///
/// d: the sizes d_0 .. d_{p+1} as above, p >= 1.
double jorba_zou_step_of_sizes(std::span<const double> d, double max_step);

/// The same where the others need not be looked at.
double jorba_zou_step_of_ends(const EndsOfMotion& ends, int p, double max_step);

/// The same of what is read: size(k) = d_k.   Throws std::invalid_argument for p < 1.
template <class Size>
double jorba_zou_step_of(int p, const Size& size, double max_step) {
  if (p < 1) throw std::invalid_argument("jorba_zou_step_of: velocities must be known to order 1 at least");
  if (p > 2) {
    const EndsOfMotion ends{size(0), size(1), size(2), {size(p), size(p + 1)}};
    if (ends.are_regular(p)) return jorba_zou_step_of_ends(ends, p, max_step);  // nearly always
  }
  std::vector<double> d(p + 2, 0.0);
  for (int k = 0; k <= p + 1; ++k)
    if (k <= 2 || k >= p) d[k] = size(k);
  if ((d[1] == 0 && d[2] == 0) || (d[p] == 0 && d[p + 1] == 0))
    for (int k = 3; k < p; ++k) d[k] = size(k);
  return jorba_zou_step_of_sizes(d, max_step);
}

/// The step of the motion of a series, in its unit of time; p: the degree, or the largest one that it holds of velocities.
template <class Series>
double jorba_zou_step_of(const Series& series, int degree, double max_step) {
  const auto size = [&](int k) { return std::max(1, k) * static_cast<double>(series.position_norm(k)); };
  return jorba_zou_step_of(std::min(degree, series.order() - 1), size, max_step);
}

/// The step of a motion, |.| being the largest component over all particles. Neither the unit of length nor that of time
/// matters. Particles at rest and in free fall get max_step.
class JorbaZou final : public Control {
 public:
  /// max_step [s], > 0; it is the step where the series ends before its second half.
  explicit JorbaZou(double max_step = std::numeric_limits<double>::infinity()) : max_step_(max_step) {
    require_positive("max_step", max_step, true);
  }
  int orders_read(const TruncationLaw& law, VelocitySeries velocity) const override {
    return order_needed(law.max_degree(), velocity);
  }
  double propose(const Prospect& prospect) override;
  double past_kinks() const override { return 0.0; }  // but for rounding
  double longest() const override { return max_step_; }
  std::unique_ptr<Control> clone() const override { return std::make_unique<JorbaZou>(*this); }

 private:
  double max_step_;
};

}  // namespace jetlag
