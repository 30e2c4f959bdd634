// SPDX-License-Identifier: MIT
// The laws of the register are recorded here, so that no user has to compile their recording.
#include "jetlag/forces/forces.hpp"

namespace jetlag {
template RecordedLaw record_law<Spring>(int);
template RecordedLaw record_law<UniformField>(int);
template RecordedLaw record_law<Drag>(int);
template RecordedLaw record_law<Gravity>(int);
template RecordedLaw record_law<Floor>(int);
template RecordedLaw record_law<QuadraticFloor>(int);
}  // namespace jetlag
