// SPDX-License-Identifier: MIT
#pragma once
// Euler's method with exponential steps.

#include "jetlag/integrators/explicit/rk4.hpp"

namespace jetlag {

/// y_1 = y_0 + H f(y_0),   H ~ Exp of mean h, independent: a piecewise linear path whose slope changes at the times of a
/// Poisson process of rate 1/h, a Markov process with the slope. The time goes on by H; a path may be cut anywhere.
/// Order 1. On y' = lambda y, z = lambda h:  E y_1 / y_0 = 1 + z,  E |y_1 / y_0|^2 = 1 + 2 Re z + 2 |z|^2; so the second
/// moment is bounded where h <= -Re lambda / |lambda|^2, half of Euler's step on the real axis.
/// Source: Latz, arXiv 2408.01409 (2024).
class ExponentialStep final : public Integrator {
 public:
  /// step: the mean h [s], > 0. Throws std::invalid_argument.
  ExponentialStep(const System<double>& system, double step, std::uint64_t seed);

  double step(State<double>& state, double limit, Report& report) override;
  /// Straight, as the method is; the velocity too.
  Piece piece() const override;
  const Work& work() const override { return euler_.work(); }

 private:
  RungeKutta euler_;
  double step_;
  std::uint64_t seed_, draw_ = 0;
  State<double> before_, after_;
  double last_step_ = 0;
};

}  // namespace jetlag
