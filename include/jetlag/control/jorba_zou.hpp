// SPDX-License-Identifier: MIT
#pragma once
// The step of Jorba and Zou, from an estimate of the radius of convergence.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
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
/// Source: [JZ05] 3.2, with 0.5 in place of 0.7: 1 % fewer steps at p = 20, and what the series leaves out of the
/// energy of a planet, e = .9, is still 1.5e-18 a period, where rounding adds 1e-15.
/// Throws std::invalid_argument for fewer than two norms.
double jorba_zou_step(std::span<const double> norms, double max_step);

namespace detail {
/// The last two sizes c_{p-1}, c_p of a series and those of its first terms, all of them normal numbers.
template <int low>
struct EndsOfSeries {
  std::array<double, low> first;  // c_0 ..
  std::array<double, 2> last;

  bool are_normal() const {
    const auto is_normal = [](double c) { return std::isnormal(c); };
    return std::ranges::all_of(first, is_normal) && std::ranges::all_of(last, is_normal);
  }
};
/// log2 of jorba_zou_step where all other coefficients vanish, p - 1 >= low, without a largest step.
template <int low>
double log_jorba_zou_step(const EndsOfSeries<low>& ends, int p);
}  // namespace detail

/// The same for a motion: the smaller one of the steps for positions and for velocities, in the unit of time of the series, p
/// the degree. Only the state, the forces in it and the last two coefficients are read, the others only where these vanish.
template <class Series>
double jorba_zou_step_of(const Series& series, int degree, double max_step) {
  const int p = std::min(degree, series.order() - 1);
  const auto position = [&](int k) { return static_cast<double>(series.position_norm(k)); };
  const auto velocity = [&](int k) { return static_cast<double>(series.velocity_norm(k)); };
  if (p >= 4) {  // nearly always nothing vanishes
    const detail::EndsOfSeries<3> x{{position(0), position(1), position(2)}, {position(p - 1), position(p)}};
    const detail::EndsOfSeries<2> v{{velocity(0), velocity(1)}, {velocity(p - 1), velocity(p)}};
    if (x.are_normal() && v.are_normal())
      return std::min(
          max_step, std::exp2(std::min(detail::log_jorba_zou_step(x, p), detail::log_jorba_zou_step(v, p))));
  }
  std::vector<double> norms(p + 1);
  // The state and the forces in it: orders 0 to 2 of x, 0 and 1 of v.
  const auto shortened = [&](double h, int low, const auto& coefficient) {
    for (int k = 0; k <= p; ++k) norms[k] = k <= low || k >= p - 1 ? coefficient(k) : 0.0;
    const auto vanish = [&](int first, int last) {
      return std::all_of(norms.begin() + first, norms.begin() + last + 1, [](double c) { return c == 0.0; });
    };
    if (vanish(0, std::min(low, p - 1)) || vanish(std::max(0, p - 1), p))
      for (int k = low + 1; k < p - 1; ++k) norms[k] = coefficient(k);
    return jorba_zou_step(norms, h);
  };
  return shortened(shortened(max_step, 2, position), 1, velocity);
}

/// The step of a motion, |.| being the largest component over all particles. p: the largest degree of which the series holds
/// both positions and velocities. Neither the unit of length nor that of time matters. Particles at rest and in free fall
/// get max_step.
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
