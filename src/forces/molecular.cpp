// SPDX-License-Identifier: MIT
// The laws of molecules are recorded here, so that no user has to compile their recording.
#include "jetlag/forces/forces.hpp"

namespace jetlag {

template RecordedLaw record_law<Angle>(int);
template RecordedLaw record_law<Dihedral<1>>(int);
template RecordedLaw record_law<Dihedral<2>>(int);
template RecordedLaw record_law<Dihedral<3>>(int);

}  // namespace jetlag
