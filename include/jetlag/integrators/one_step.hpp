// SPDX-License-Identifier: MIT
#pragma once
// The frame of methods that go from one state to the next: what is the same for all of them is written once.

#include <span>

#include "jetlag/integrators/accelerations.hpp"

namespace jetlag {

/// A member writes `advance`; failures, counts and the piece are here.
class OneStep : public Integrator {
 public:
  double step(State<double>& state, double limit, Report& report) final;
  const Work& work() const override { return work_; }

 protected:
  /// order: of the method, counted as the degree of an update.
  OneStep(const System<double>& system, int order);

  /// The state after a step of at most `limit` from `from`, of which only positions, velocities and rests count.
  /// Returns the length, or 0 with a report.
  virtual double advance(const State<double>& from, double limit, State<double>& to, Report& report) = 0;

  /// Coefficients of the positions of a particle computed so far: those of the accelerations, unless the method says
  /// otherwise.
  virtual std::uint64_t coefficients() const { return accelerations_.coefficients(); }

  /// `step` or what is left of it; 0 with a report where it does not change the time.
  double fixed_length(const State<double>& from, double step, double limit, Report& report);

  /// `proposal`, the choice of a control, or what is left of it. 0 where it does not change the time or, unless it is
  /// the last one, is below ten of its roundings, where the times of its stages are none: then the report is that of
  /// the underflow, or the one that is there already of what made the step so short.   Source: [HNW93] dopri5.f,
  /// dop853.f.
  double chosen_length(const State<double>& from, double proposal, double limit, Report& report);

  /// After a step: where it began and ended.
  const State<double>& before() const { return before_; }
  const State<double>& after() const { return after_; }
  double length() const { return length_; }

  Accelerations accelerations_;
  Work work_;
  std::uint64_t other_element_coefficients_ = 0;  // computed by the method itself

 private:
  int order_, moving_;
  State<double> before_, after_, next_;  // next_: room for a step
  double length_ = 0;
};

/// The largest absolute component.
double largest(const Coordinates<double>& rows);

/// A length to begin with where an estimate of the error will choose: 1/100 of the least of |x| / |v|, |v| / |a| and
/// sqrt(|x| / |a|), in largest components; infinite where nothing moves.
double first_length(const State<double>& from, const Coordinates<double>& acceleration);

/// The polynomial in s = t - begin with the given values and derivatives [m/s^k] at both ends, and its derivative as the
/// velocity. left: x, x', x'' .. at s = 0; right: the same at s = h. With n of them together the error of the position
/// is O(h^n), of the velocity O(h^(n-1)).   Source: Hermite's interpolation.
Piece hermite_piece(double begin, double h, std::span<const Coordinates<double>> left,
                    std::span<const Coordinates<double>> right);

}  // namespace jetlag
