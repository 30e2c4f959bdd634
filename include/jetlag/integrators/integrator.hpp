// SPDX-License-Identifier: MIT
#pragma once
// An integrator: one step of one method on a whole system.
//
// Invariants, tested for every member of the family:
//   - its measured order is the declared one; steps of any length up to `limit` may be asked for;
//   - on failure the state is untouched and the report says where and why;
//   - same state, seed and update number: same bits.

#include <memory>
#include <optional>
#include <string>

#include "jetlag/base/courant_frequency.hpp"
#include "jetlag/base/outcome.hpp"
#include "jetlag/base/step_length.hpp"
#include "jetlag/base/work.hpp"
#include "jetlag/control/control.hpp"
#include "jetlag/model/finite.hpp"
#include "jetlag/model/system.hpp"
#include "jetlag/motion/piece.hpp"

namespace jetlag {

class Integrator {
 public:
  virtual ~Integrator() = default;

  /// One step of at most `limit` [s]: the length the control proposes, or `limit` where that is shorter. state.time
  /// is the beginning of the step and stays so: the caller keeps the time. Rests of the state are kept by methods with
  /// compensated sums and dropped by others. Returns the length; on failure 0.
  virtual double step(State<double>& state, double limit, Report& report) = 0;

  /// The motion during the step that was taken last: begin is the time at its beginning.
  virtual Piece piece() const = 0;

  /// The same where it stands, until the next step or the next call. Without a copy where the method has its coefficients at
  /// hand.
  virtual PieceView motion() const {
    kept_ = piece();
    return kept_;
  }

  virtual const Work& work() const = 0;

  /// What the steps so far may have got wrong although they succeeded, in a sentence. Empty: nothing that is known.
  virtual std::string warning() const { return {}; }

  /// What the Courant limit of its steps stands on, if it has one.
  virtual std::optional<CourantFrequency> courant_frequency() const { return std::nullopt; }

 private:
  mutable Piece kept_;  // of `motion`
};

/// The report for a step h that does not change the time: names the fastest particle.
Report step_underflow(const Expansion<double>& series, double h);

/// As all_finite for the series of a motion: names the first coefficient that does not exist.
bool all_finite(const Expansion<double>& series, Report& report);

}  // namespace jetlag
