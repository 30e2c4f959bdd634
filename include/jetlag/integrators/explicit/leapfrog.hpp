// SPDX-License-Identifier: MIT
#pragma once
// Leapfrog in its velocity form (Stoermer, Verlet; not the midpoint leapfrog of fluid dynamics).

#include "jetlag/integrators/integrator.hpp"
#include "jetlag/motion/expansion.hpp"

namespace jetlag {

/// x_1 = x_0 + h v_0 + h^2/2 a_0,   v_1 = v_0 + h/2 (a_0 + a_1).
/// Order 2, symmetric and symplectic for forces that depend on positions only; one force evaluation a step.
/// Where forces depend on velocities, a_1 is taken at the velocity v_0 + h a_0 (Heun): order 2, two evaluations.
/// Source: [HLW06] I.1.4.
class Leapfrog final : public Integrator {
 public:
  /// step [s], > 0.
  Leapfrog(const System<double>& system, double step);
  double step(State<double>& state, double limit, Report& report) override;
  Piece piece() const override;
  const Work& work() const override { return work_; }

 private:
  bool acceleration(const State<double>& state, Coordinates<double>& result, Report& report);

  Expansion<double> series_;
  bool forces_depend_on_velocity_, forces_depend_on_time_;
  int moving_;
  double step_;
  State<double> before_;
  Coordinates<double> a_before_, a_after_;
  Coordinates<double> position_of_a_after_;  // where a_after_ was computed, so that the next step can use it
  double time_of_a_after_ = 0;
  State<double> next_;  // room for a step
  Coordinates<double> a_, a_next_;
  double last_step_ = 0;
  Work work_;
};

}  // namespace jetlag
