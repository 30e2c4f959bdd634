// SPDX-License-Identifier: MIT
#pragma once
// The accelerations of all particles at a state, for methods that need no more of the series.

#include <cstdint>

#include "jetlag/integrators/integrator.hpp"
#include "jetlag/motion/expansion.hpp"

namespace jetlag {

/// Whether a force of the system depends on a kind of input.
bool forces_read(const System<double>& system, Input::Kind kind);

/// x'' = F(t, x, x') / m, 0 for fixed particles; on demand x''' along the motion. Where it is asked for the state that
/// it was asked for last, it remembers: then a step begins where the one before ended, and nothing is computed.
class Accelerations {
 public:
  explicit Accelerations(const System<double>& system);

  bool depend_on_velocity() const { return depend_on_velocity_; }

  /// a [m/s^2], shape (particles, dimension). False where it is not finite: the report then says where and why.
  bool operator()(const State<double>& state, Coordinates<double>& a, Report& report);

  /// As above with derivatives of the motion: the k-th entry of `derivatives` becomes x^(k+2), k = 0 .. size - 1.
  bool operator()(const State<double>& state, std::vector<Coordinates<double>>& derivatives, Report& report);

  /// The report for a step h from a state that does not change its time.
  Report underflow(const State<double>& state, double h);

  /// (element, order) pairs computed, and coefficients of the positions beyond order 1 of a particle.
  std::uint64_t element_coefficients() const { return series_.element_coefficients(); }
  std::uint64_t coefficients() const { return coefficients_; }

 private:
  bool knows_forces(const State<double>& state) const;
  bool knows(const State<double>& state) const;
  void begin(const State<double>& state);

  Expansion<double> series_;
  bool depend_on_velocity_, depend_on_time_;
  State<double> last_;  // empty before the first
  std::uint64_t coefficients_ = 0;
};

}  // namespace jetlag
