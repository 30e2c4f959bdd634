// SPDX-License-Identifier: MIT
#include "jetlag/model/system_tape.hpp"

#include <cmath>
#include <optional>

#include "jetlag/series/functions.hpp"

namespace jetlag {

namespace {

/// c f^a with numbers c > 0 and a as (c^{1/a} f)^a: the power itself need not be kept beside its product, where the next
/// operations read all of its orders. Tiny and huge c are left alone.
std::optional<Recorded> scaled_power(Recording& recording, const std::vector<Node>& nodes, const Node& node,
                                     const std::vector<Recorded>& value) {
  if (node.rule != rule_id<Scale> || !value[node.operands[0]].is_number()) return {};
  const Node& power = nodes[node.operands[1]];
  if (power.kind != Node::Kind::operation || power.rule != rule_id<Power> || power.is_static) return {};
  const Recorded& exponent = value[power.operands[0]];
  const double c = value[node.operands[0]].value(), a = exponent.is_number() ? exponent.value() : 0.0;
  // The root of c and its product are rounded, and a multiplies that.
  if (!(c > 1e-30 && c < 1e30) || !(std::abs(a) >= 0.5 && std::abs(a) <= 4)) return {};
  const Recorded f = value[power.operands[1]];
  const int scale = recording.node_of(Recorded(std::pow(c, 1 / a)));
  const Recorded scaled = recording.operation(rule_id<Scale>, {scale, recording.node_of(f)}, false);
  return recording.operation(rule_id<Power>, {recording.node_of(exponent), scaled.node()}, false);
}

/// A value whose sign decides, the sign that a zero is taken for, and of a root its argument: see Condition.
struct Decision {
  Recorded value;
  int at_zero;
  std::optional<Recorded> argument;
};

/// The forces that the law of one element gives, recorded: component by component. Its conditions join the `decisions`.
std::vector<Recorded> record_element(Recording& recording, const RecordedLaw& law, const int* particles,
                                     const double* parameters, const std::vector<double>& mass,
                                     std::vector<Decision>& decisions) {
  const int width = static_cast<int>(law.parameters.size());
  std::vector<Recorded> value;
  const auto input = [&](const Input& of) {
    const auto position = [&](int i) {
      return recording.input({Input::Kind::position, particles[i], of.component});
    };
    switch (of.kind) {
      case Input::Kind::time: return recording.input(of);
      case Input::Kind::separation: return position(of.participant) - position(of.minus);
      default: return recording.input({of.kind, particles[of.participant], of.component});
    }
  };
  const std::vector<Node>& nodes = law.force.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    switch (node.kind) {
      case Node::Kind::constant: value.emplace_back(node.value); break;
      case Node::Kind::parameter:
        value.emplace_back(node.parameter < width ? parameters[node.parameter]
                                                  : mass[particles[node.parameter - width]]);
        break;
      case Node::Kind::input: value.push_back(input(node.input)); break;
      case Node::Kind::operation: {
        if (node.operands.back() == static_cast<int>(i) + 1) {  // coupled with the next one
          std::vector<int> u;
          for (const int operand : node.operands)
            if (operand <= static_cast<int>(i)) u.push_back(recording.node_of(value[operand]));
          const auto [a, b] = recording.coupled(node.rule, nodes[i + 1].rule, std::move(u), node.is_static);
          value.push_back(a);
          value.push_back(b);
          ++i;
          break;
        }
        const auto scaled = scaled_power(recording, nodes, node, value);
        if (scaled) {
          value.push_back(*scaled);
          break;
        }
        if (node.rule == rule_id<Multiply> && node.is_static && value[node.operands[0]].is_number() &&
            value[node.operands[1]].is_number()) {
          value.emplace_back(value[node.operands[0]].value() * value[node.operands[1]].value());
          break;
        }
        std::vector<int> operands;
        for (int operand : node.operands) operands.push_back(recording.node_of(value[operand]));
        value.push_back(recording.operation(node.rule, std::move(operands), node.is_static));
      }
    }
  }
  for (const auto& [node, at_zero, argument] : law.force.conditions)
    if (!value[node].is_number() && !recording.is_static(value[node]))
      decisions.push_back(
          {value[node], at_zero, argument < 0 ? std::nullopt : std::optional(value[argument])});
  std::vector<Recorded> force;
  for (int output : law.force.outputs) force.push_back(value[output]);
  return force;
}

Recorded sum(const std::vector<Recorded>& terms) {
  Recorded total(0.0);
  for (const Recorded& term : terms) total += term;
  return total;
}

}  // namespace

Tape system_tape(const Model<double>& model) {
  const int dimension = model.dimension();
  Recording recording;
  struct Terms {
    std::vector<Recorded> plus, minus;
  };
  std::vector<Decision> decisions;
  std::vector<Terms> terms(static_cast<std::size_t>(model.particles()) * dimension);
  for (const auto& of_law : model.laws()) {
    const auto& [law, members, parameters] = of_law->elements();
    for (const int e : of_law->all()) {
      const auto particles = of_law->particles_of(e);
      const auto force =
          record_element(recording, law, particles.data(), parameters.data() + e * law.parameters.size(),
                         model.mass(), decisions);
      const auto on = [&](int participant, int c) -> Terms& {
        return terms[static_cast<std::size_t>(particles[participant]) * dimension + c];
      };
      const int given = law.given;
      for (int i = 0; i < given; ++i)
        for (int c = 0; c < dimension; ++c) {
          const Recorded& f = force[i * dimension + c];
          if (!model.is_fixed(particles[i])) on(i, c).plus.push_back(f);
          if (!law.is_external() && !model.is_fixed(particles[given])) on(given, c).minus.push_back(f);
        }
    }
  }
  std::vector<Recorded> outputs;
  for (const Terms& of : terms)
    outputs.push_back(of.plus.empty() && !of.minus.empty() ? -sum(of.minus) : sum(of.plus) - sum(of.minus));
  // The decisions are computed like outputs, and then are none.
  const std::size_t forces = outputs.size();
  for (const Decision& decision : decisions) {
    outputs.push_back(decision.value);
    if (decision.argument) outputs.push_back(*decision.argument);
  }
  Tape tape = recording.finish(outputs);
  std::size_t next = forces;
  for (const Decision& decision : decisions) {
    const int node = tape.outputs[next++];
    tape.conditions.push_back({node, decision.at_zero, decision.argument ? tape.outputs[next++] : -1});
  }
  tape.outputs.resize(forces);
  return tape;
}

}  // namespace jetlag
