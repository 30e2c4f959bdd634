// SPDX-License-Identifier: MIT
#pragma once
// Leapfrog in its velocity form (Stoermer, Verlet; not the midpoint leapfrog of fluid dynamics).

#include "jetlag/integrators/one_step.hpp"

namespace jetlag {

/// x_1 = x_0 + h v_0 + h^2/2 a_0,   v_1 = v_0 + h/2 (a_0 + a_1).
/// Order 2, symmetric and symplectic for forces that depend on positions only; one force evaluation a step.
/// Where forces depend on velocities, a_1 is taken at the velocity v_0 + h a_0 (Heun): order 2, two evaluations.
/// Source: [HLW06] I.1.4.
class Leapfrog final : public OneStep {
 public:
  /// step [s], > 0.
  Leapfrog(const System<double>& system, double step);

  /// x is a parabola and v too; both meet the end of the step exactly.
  Piece piece() const override;

 private:
  double advance(const State<double>& from, double limit, State<double>& to, Report& report) override;
  std::uint64_t coefficients() const override { return work_.steps; }  // one a step

  double step_;
  Coordinates<double> a_before_, a_after_;  // of the last step
};

}  // namespace jetlag
