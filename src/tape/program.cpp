// SPDX-License-Identifier: MIT
#include "jetlag/tape/program.hpp"

namespace jetlag {

Program::Program(const Tape& tape) : parameters(tape.parameters), is_static(tape.is_static()) {
  const auto keeps = tape.keeps_history(), ends = tape.ends_at_order_0();
  std::vector<Place> places;
  for (std::size_t i = 0; i < tape.nodes.size(); ++i) {
    if (tape.nodes[i].is_static || ends[i])
      places.push_back({Place::Space::statics, statics++});
    else if (keeps[i])
      places.push_back({Place::Space::history, histories++});
    else
      places.push_back({Place::Space::scratch, scratches++});
  }
  for (std::size_t i = 0; i < tape.nodes.size(); ++i) {
    const Node& node = tape.nodes[i];
    switch (node.kind) {
      case Node::Kind::constant: fixed.push_back({places[i], -1, node.value}); break;
      case Node::Kind::parameter: fixed.push_back({places[i], node.parameter, 0.0}); break;
      case Node::Kind::input: inputs.push_back({places[i], node.input}); break;
      case Node::Kind::operation: {
        Instruction instruction{node.rule, ends[i], false, {}};
        for (int operand : node.operands) {
          instruction.operands.push_back(places[operand]);
          if (operand > static_cast<int>(i)) instruction.coupled = true;
        }
        instruction.operands.push_back(places[i]);
        (node.is_static ? preparation : instructions).push_back(std::move(instruction));
      }
    }
  }
  for (int output : tape.outputs) outputs.push_back(places[output]);
  for (const auto& [node, at_zero, argument] : tape.conditions)
    conditions.push_back(
        {places[node], at_zero, argument < 0 ? std::nullopt : std::optional(places[argument])});
}

}  // namespace jetlag
