// SPDX-License-Identifier: MIT
// The laws of solids are recorded here, so that no user has to compile their recording.
#include "jetlag/forces/forces.hpp"

namespace jetlag {

template RecordedLaw record_law<NeoHookean>(int);
template RecordedLaw record_law<PlaneNeoHookean>(int);
template RecordedLaw record_law<StableNeoHookean>(int);
template RecordedLaw record_law<PlaneStableNeoHookean>(int);
template RecordedLaw record_law<PolynomialNeoHookean>(int);
template RecordedLaw record_law<PlanePolynomialNeoHookean>(int);
template RecordedLaw record_law<Stvk>(int);
template RecordedLaw record_law<PlaneStvk>(int);
template RecordedLaw record_law<Corotated>(int);
template RecordedLaw record_law<PlaneCorotated>(int);
template RecordedLaw record_law<KelvinVoigt>(int);
template RecordedLaw record_law<PlaneKelvinVoigt>(int);
template RecordedLaw record_law<Pressure>(int);
template RecordedLaw record_law<Traction>(int);

}  // namespace jetlag
