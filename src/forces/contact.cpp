// SPDX-License-Identifier: MIT
// The laws of contact are recorded here, so that no user has to compile their recording.
#include "jetlag/forces/forces.hpp"

namespace jetlag {

template RecordedLaw record_law<BarrierVertexVertex>(int);
template RecordedLaw record_law<BarrierVertexEdge>(int);
template RecordedLaw record_law<BarrierVertexFace>(int);
template RecordedLaw record_law<BarrierEdgeEdge>(int);
template RecordedLaw record_law<BarrierMollifiedEdgeEdge>(int);
template RecordedLaw record_law<LogBarrierVertexVertex>(int);
template RecordedLaw record_law<LogBarrierVertexEdge>(int);
template RecordedLaw record_law<LogBarrierVertexFace>(int);
template RecordedLaw record_law<LogBarrierEdgeEdge>(int);
template RecordedLaw record_law<LogBarrierMollifiedEdgeEdge>(int);

}  // namespace jetlag
