// SPDX-License-Identifier: MIT
#pragma once
// The Courant limit: no step beyond what is stable for the stiffest oscillation of a scene.

#include "jetlag/control/control.hpp"
#include "jetlag/motion/system.hpp"
#include "jetlag/truncation/truncation.hpp"

namespace jetlag {

/// The largest y such that the law is stable in mean square for q'' = -q at every step in (0, y]:
///     E|R_K(i y)|^2 = |T_N(i y)|^2 + sum_{n>m} (w_n - w_{n-1}) |S_n(i y)|^2 <= 1,   S_n(z) = sum_{j=n..N} z^j / j!.
/// 0 where the first steps are unstable already (degree 6, say). For a fixed degree: its limit on the imaginary axis.
double imaginary_stability_limit(const TruncationLaw& law);

/// An upper bound of the fastest angular frequency [rad/s] of a system at any configuration, from the elements that
/// have a stiffness k:  omega^2 <= max over elements (a, b) of  sum_{j at a} k_aj / m_a + sum_{j at b} k_bj / m_b.
/// Fixed particles count as infinitely heavy. 0 when no law of the system has a stiffness.
double frequency_bound(const System<double>& system);

/// Another control, cropped at  safety * limit / omega.
class Courant final : public Control {
 public:
  /// limit: see imaginary_stability_limit (2 for leapfrog). safety: in (0, 1].
  Courant(std::unique_ptr<Control> inner, double safety, double limit, double omega);
  bool reads_series() const override { return inner_->reads_series(); }
  double propose(const Prospect& prospect) override {
    return std::min(inner_->propose(prospect), largest_step_);
  }
  std::unique_ptr<Control> clone() const override {
    return std::unique_ptr<Control>(new Courant(inner_->clone(), largest_step_));
  }

 private:
  Courant(std::unique_ptr<Control> inner, double largest_step)
      : inner_(std::move(inner)), largest_step_(largest_step) {}

  std::unique_ptr<Control> inner_;
  double largest_step_;
};

}  // namespace jetlag
