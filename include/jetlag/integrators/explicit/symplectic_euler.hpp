// SPDX-License-Identifier: MIT
#pragma once
// The symplectic (semi-implicit) Euler method.

#include "jetlag/integrators/one_step.hpp"

namespace jetlag {

/// v_1 = v_0 + h a(x_0),   x_1 = x_0 + h v_1.
/// Order 1, symplectic, not symmetric; one force evaluation a step. Conserves momentum and angular momentum.
/// Source: [HLW06] I.1.9 (de Vogelaere 1956).
class SymplecticEuler final : public OneStep {
 public:
  /// step [s], > 0. Throws std::invalid_argument; also for a system whose forces depend on velocities (drag): then it
  /// is not symplectic, and leapfrog or an implicit method is the better choice.
  SymplecticEuler(const System<double>& system, double step);

  /// Straight lines: as accurate as the method.
  Piece piece() const override;

 private:
  double advance(const State<double>& from, double limit, State<double>& to, Report& report) override;

  double step_;
};

}  // namespace jetlag
