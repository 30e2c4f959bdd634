// SPDX-License-Identifier: MIT
// The laws of the register are recorded here, so that no user has to compile their recording.
#include "jetlag/forces/forces.hpp"

#include <algorithm>

namespace jetlag {

bool reads(const Tape& tape, Input::Kind kind) {
  return std::ranges::any_of(tape.nodes, [kind](const Node& node) {
    return node.kind == Node::Kind::input &&
           (node.input.kind == kind ||
            (kind == Input::Kind::position && node.input.kind == Input::Kind::separation));
  });
}
bool reads_places(const Tape& tape) {
  return std::ranges::any_of(tape.nodes, [](const Node& node) {
    return node.kind == Node::Kind::input && node.input.kind == Input::Kind::position;
  });
}
bool reads(const RecordedLaw& law, Input::Kind kind) { return reads(law.force, kind); }

template RecordedLaw record_law<Spring>(int);
template RecordedLaw record_law<ZeroLengthSpring>(int);
template RecordedLaw record_law<UniformField>(int);
template RecordedLaw record_law<OscillatingField>(int);
template RecordedLaw record_law<Drag>(int);
template RecordedLaw record_law<Gravity>(int);
template RecordedLaw record_law<SoftenedGravity>(int);
template RecordedLaw record_law<Floor>(int);
template RecordedLaw record_law<QuadraticFloor>(int);

}  // namespace jetlag
