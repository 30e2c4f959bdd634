// SPDX-License-Identifier: MIT
#pragma once
// An integrator: one step of one method on a whole system.
//
// Invariants, tested for every member of the family:
//   - its measured order is the declared one; steps of any length up to `limit` may be asked for;
//   - on failure the state is untouched and the report says where and why;
//   - same state, seed and update number: same bits.

#include <memory>

#include "jetlag/base/outcome.hpp"
#include "jetlag/base/work.hpp"
#include "jetlag/control/control.hpp"
#include "jetlag/model/system.hpp"
#include "jetlag/motion/piece.hpp"

namespace jetlag {

/// What can be asked about the step that was taken last.
class LastStep {
 public:
  virtual ~LastStep() = default;

  /// The motion during it: begin is the time at its beginning.
  virtual Piece piece() const = 0;

  virtual const Work& work() const = 0;
};

class Integrator : public LastStep {
 public:
  /// One step of at most `limit` [s]: the length the control proposes, or `limit` where that is shorter. state.time
  /// is the beginning of the step and stays so: the caller keeps the time. Rests of the state are kept by methods with
  /// compensated sums and dropped by others. Returns the length; on failure 0.
  virtual double step(State<double>& state, double limit, Report& report) = 0;
};

/// Whether a step changes the time: below half of its last place (6e-8 s at 1e9 s) no step is taken.
inline bool advances(double time, double h) { return h > 0.0 && time + h != time; }

/// The report for a step h that does not change the time: names the fastest particle.
Report step_underflow(const Expansion<double>& series, double h);

/// Number of particles that are not fixed.
int moving_particles(const System<double>& system);

/// Whether all numbers are finite; otherwise `report` names the first particle with one that is not.
bool all_finite(const Coordinates<double>& position, const Coordinates<double>& velocity, double time,
                Report& report);

/// Positions [m] and velocities [m/s] beyond it have squares, and so energies, that overflow.
inline constexpr double largest_number = 1e150;

/// Whether all numbers of a state are below `largest`; otherwise `report` names the first particle with one that is not.
/// `begin`: of the step that led to the state.
bool in_range(const State<double>& state, double largest, double begin, Report& report);

/// As all_finite for the series of a motion: names the first coefficient that does not exist.
bool all_finite(const Expansion<double>& series, Report& report);

}  // namespace jetlag
