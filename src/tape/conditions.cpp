// SPDX-License-Identifier: MIT
// The conditions of a tape: what its choices depend on, as series.

#include <algorithm>
#include <array>

#include "jetlag/series/functions.hpp"
#include "jetlag/tape/tape.hpp"

namespace jetlag {

namespace {

/// An operation that is there, or a new one.
int operation(Tape& tape, int rule, bool is_static, std::vector<int> operands) {
  const auto known = std::ranges::find_if(tape.nodes, [&](const Node& node) {
    return node.kind == Node::Kind::operation && node.rule == rule && node.operands == operands;
  });
  if (known != tape.nodes.end()) return static_cast<int>(known - tape.nodes.begin());
  tape.nodes.push_back(
      {.kind = Node::Kind::operation, .is_static = is_static, .rule = rule, .operands = std::move(operands)});
  return static_cast<int>(tape.nodes.size()) - 1;
}

/// u - v, at least one of which has a series; -(u - v) where `flipped` says so.
int difference(Tape& tape, int u, int v, bool& flipped) {
  const auto is_static = [&](int i) { return tape.nodes[i].is_static; };
  const auto is_zero = [&](int i) {
    return tape.nodes[i].kind == Node::Kind::constant && tape.nodes[i].value == 0;
  };
  flipped = is_static(u);
  if (flipped) std::swap(u, v);
  if (is_zero(v)) return u;
  if (!is_static(v)) return operation(tape, rule_id<Subtract>, false, {u, v});
  return operation(tape, rule_id<Offset>, false, {operation(tape, rule_id<Negate>, true, {v}), u});
}

/// A root that is zero in the numerator as well turns round with it, as v / |v|; u (u^2)^a has a pole for a < -1/2. Of a
/// parameter the sign is not known: what is written with a minus, as pow(w, -q), is meant to have a pole.
bool is_pole(const Tape& tape, const Node& node) {
  if (node.rule != rule_id<Power>) return false;
  const Node& exponent = tape.nodes[node.operands[0]];
  if (exponent.kind == Node::Kind::constant) return exponent.value < -0.5;
  return exponent.kind == Node::Kind::operation && exponent.rule == rule_id<Negate>;
}

/// Whether a node is a sum of squares, which touches zero and does not cross it.
bool is_of_squares(const Tape& tape, int i) {
  const Node& node = tape.nodes[i];
  static const std::array squares{rule_id<Square>, rule_id<SquaredNorm<2>>, rule_id<SquaredNorm<3>>,
                                  rule_id<ScaledSquare>, rule_id<ScaledSumOfSquares>};
  if (std::ranges::find(squares, node.rule) != squares.end()) return true;
  return node.rule == rule_id<Add> &&
         std::ranges::all_of(node.operands, [&](int u) { return is_of_squares(tape, u); });
}

/// What a root is drawn of, where that may cross zero; -1 where it does not.
int argument_of(const Tape& tape, const Node& root) {
  const int argument = root.operands.back();
  return root.rule == rule_id<RootOfScaled> || is_of_squares(tape, argument) ? -1 : argument;
}

}  // namespace

Tape with_conditions(Tape tape) {
  const int given = static_cast<int>(tape.nodes.size());
  const auto add = [&](int node, int at_zero, int argument = -1) {
    const auto known = std::ranges::find_if(tape.conditions, [&](const Condition& condition) {
      return condition.node == node && condition.at_zero == at_zero;
    });
    if (known == tape.conditions.end() && !tape.nodes[node].is_static)
      tape.conditions.push_back({node, at_zero, argument});
  };
  static const std::array roots{rule_id<Sqrt>, rule_id<RootOfScaled>, rule_id<Power>};
  for (int i = 0; i < given; ++i) {
    const Node node = tape.nodes[i];
    if (node.kind != Node::Kind::operation || node.is_static) continue;
    if (node.rule == rule_id<Less> || node.rule == rule_id<LessOrEqual>) {
      bool flipped = false;
      const int margin = difference(tape, node.operands[0], node.operands[1], flipped);
      // u < v does not hold at zero, as for u > v; u <= v does, as for u < v.
      const int side = node.rule == rule_id<Less> ? 1 : -1;
      add(margin, flipped ? -side : side);
    } else if (node.rule == rule_id<Sign>) {
      add(node.operands[0], 0);
    } else if (std::ranges::find(roots, node.rule) != roots.end() && !is_pole(tape, node)) {
      add(i, 0, argument_of(tape, node));
    } else if (node.rule == rule_id<FirstStretchInvariant>) {  // a b - J
      bool flipped = false;
      add(difference(tape, operation(tape, rule_id<Multiply>, false, {i, node.operands[3]}), node.operands[2],
                     flipped),
          0);
    }
  }
  return tape;
}

}  // namespace jetlag
