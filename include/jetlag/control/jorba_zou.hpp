// SPDX-License-Identifier: MIT
#pragma once
// The step of Jorba and Zou, from an estimate of the radius of convergence.

#include "jetlag/control/control.hpp"

namespace jetlag {

/// The degree for a tolerance: p = ceil(1 - ln(tol) / 2), at least 2.         Source: [JZ05] 3.2.
int jorba_zou_degree(double tolerance);

/// rho = min over y in {x, v} of  min((s_y / |y_{p-1}|)^{1/(p-1)}, (s_y / |y_p|)^{1/p}),
/// h = rho exp(-2 - 0.7 / (p-1)).         Source: [JZ05] 3.2, with a scale of its own for positions and velocities.
/// p: the largest degree of which the series holds both; |.|: largest component; s_y = |y_0|, at least 1 (smaller
/// positions and velocities are held to an absolute error). The accuracy follows from the degree: the first term left
/// out is about exp(-2p) s.
class JorbaZou final : public Control {
 public:
  /// max_step [s], > 0; it is the step where the last coefficients vanish.
  explicit JorbaZou(double max_step = std::numeric_limits<double>::infinity()) : max_step_(max_step) {
    require_positive("max_step", max_step, true);
  }
  bool reads_series() const override { return true; }
  double propose(const Prospect& prospect) override;
  std::unique_ptr<Control> clone() const override { return std::make_unique<JorbaZou>(*this); }

 private:
  double max_step_;
};

}  // namespace jetlag
