// SPDX-License-Identifier: MIT
#pragma once
// The whole system as one tape, whose element is a trajectory: what ensembles run, one trajectory in each lane.

#include "jetlag/model/model.hpp"
#include "jetlag/tape/tape.hpp"

namespace jetlag {

/// The forces on all particles, all laws together [N].
/// Inputs: position and velocity with the particle as participant, time; separations are written out.
/// Outputs: particles x dimension, particle by particle; zero for fixed ones. Parameters and masses are constants.
Tape system_tape(const Model<double>& model);

}  // namespace jetlag
