// SPDX-License-Identifier: MIT
#pragma once
// Derivatives of what has been recorded, recorded as well: from the energy of a law, its forces.
//
//   Recording recording;
//   Recorded x = recording.input({Input::Kind::position, 0, 0});
//   Recorded force = derivatives(recording, -cosh(x), {x})[0];      // -sinh(x)
//   Tape tape = recording.finish({force});

#include <vector>

#include "jetlag/tape/recording.hpp"

namespace jetlag {

/// d output / d input for each of the inputs or parameters of the recording, by one pass from the output backwards.
///
/// Of a choice (select, min, max) it is the derivative of what is chosen. That of |u| is the sign of u, and 0 where u is.
/// Values without a series stay so, and what the derivatives have in common is computed once.
/// Where a power meets another of the same value, as in r / r, they are one: a derivative may exist where a value does not.
/// Throws std::invalid_argument if the output depends on an input by a rule that has no derivative, and for an input that is a
/// number or an operation.
///
/// Cost: at most some four operations for each that the output needs (Griewank & Walther, Evaluating Derivatives, 2nd ed.,
/// section 3.3), of which most have no history.
std::vector<Recorded> derivatives(Recording& recording, const Recorded& output,
                                  const std::vector<Recorded>& inputs);

/// Whether a rule of the register has one. Those that have none are parts of others, which have.
bool has_derivative(int rule);

}  // namespace jetlag
