// SPDX-License-Identifier: MIT
// Laws of nearly parallel edges are recorded here, so that no user has to compile their recording.
#include "jetlag/forces/contact/nearly_parallel.hpp"

namespace jetlag {

template RecordedLaw record_law<BarrierMollifiedVertexVertex>(int);
template RecordedLaw record_law<BarrierMollifiedVertexEdge>(int);

}  // namespace jetlag
