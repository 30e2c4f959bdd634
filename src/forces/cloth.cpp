// SPDX-License-Identifier: MIT
// The laws of cloth are recorded here, so that no user has to compile their recording.
#include "jetlag/forces/forces.hpp"

namespace jetlag {

template RecordedLaw record_law<Membrane>(int);
template RecordedLaw record_law<MembraneKelvinVoigt>(int);
template RecordedLaw record_law<Bending>(int);
template RecordedLaw record_law<Hinge>(int);

}  // namespace jetlag
