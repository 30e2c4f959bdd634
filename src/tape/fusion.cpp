// SPDX-License-Identifier: MIT
#include "jetlag/tape/fusion.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "jetlag/series/functions.hpp"

namespace jetlag {

namespace {

constexpr bool is_operation(const Node& node, int rule) {
  return node.kind == Node::Kind::operation && node.rule == rule && !node.is_static;
}

/// How often each value is read, by operations and as an output.
std::vector<int> readers(const Tape& tape) {
  std::vector<int> count(tape.nodes.size(), 0);
  for (const Node& node : tape.nodes)
    for (int operand : node.operands) ++count[operand];
  for (int output : tape.outputs) ++count[output];
  return count;
}

/// Differences of the positions of two participants become inputs.
void fuse_separations(Tape& tape) {
  const auto is_position = [&](int node) {
    return tape.nodes[node].kind == Node::Kind::input && tape.nodes[node].input.kind == Input::Kind::position;
  };
  for (Node& node : tape.nodes) {
    if (!is_operation(node, rule_id<Subtract>) || !is_position(node.operands[0]) ||
        !is_position(node.operands[1]))
      continue;
    const Input plus = tape.nodes[node.operands[0]].input, minus = tape.nodes[node.operands[1]].input;
    if (plus.component != minus.component || plus.participant == minus.participant) continue;
    node = {.kind = Node::Kind::input,
            .is_static = false,
            .operands = {},
            .input = {Input::Kind::separation, plus.participant, plus.component, minus.participant}};
  }
}

/// The terms of a sum, by what they are.
struct Terms {
  std::vector<int> squares;                  // u, for u^2
  std::vector<std::array<int, 2>> products;  // u, v, for u v
  std::vector<int> others;

  std::size_t size() const { return squares.size() + products.size() + others.size(); }
};

/// Takes a tree of additions apart, as far as nothing else reads its parts.
void take_apart(const Tape& tape, const std::vector<int>& readers, int i, bool is_root, Terms& terms) {
  const Node& node = tape.nodes[i];
  if (is_root || readers[i] == 1) {
    if (is_operation(node, rule_id<Add>)) {
      for (int operand : node.operands) take_apart(tape, readers, operand, false, terms);
      return;
    }
    if (is_operation(node, rule_id<Square>)) return terms.squares.push_back(node.operands[0]);
    if (is_operation(node, rule_id<Multiply>))
      return terms.products.push_back({node.operands[0], node.operands[1]});
  }
  terms.others.push_back(i);
}

class Fusion {
 public:
  explicit Fusion(Tape tape)
      : tape_(std::move(tape)), readers_(readers(tape_)), renamed_(tape_.nodes.size(), -1) {}

  Tape result() {
    for (std::size_t i = 0; i < tape_.nodes.size(); ++i) {
      const Node& node = tape_.nodes[i];
      Terms terms;
      if (is_operation(node, rule_id<Add>) && !(readers_[i] == 1 && read_by_a_sum_[i]))
        take_apart(tape_, readers_, static_cast<int>(i), true, terms);
      renamed_[i] = terms.size() > 2 || terms.squares.size() == 2 || terms.products.size() == 2
                        ? fuse(terms)
                        : append(node);
    }
    for (Node& node : fused_.nodes)  // a coupled operation names one that comes later: renamed last
      for (int& operand : node.operands) operand = operand < 0 ? renamed_[-1 - operand] : operand;
    for (int output : tape_.outputs) fused_.outputs.push_back(renamed_[output]);
    fused_.parameters = tape_.parameters;
    return pruned(fused_);
  }

  void find_sums() {
    read_by_a_sum_.assign(tape_.nodes.size(), false);
    for (const Node& node : tape_.nodes)
      if (is_operation(node, rule_id<Add>))
        for (int operand : node.operands) read_by_a_sum_[operand] = true;
  }

 private:
  int append(Node node) {
    for (int& operand : node.operands) operand = renamed_[operand] >= 0 ? renamed_[operand] : -1 - operand;
    fused_.nodes.push_back(std::move(node));
    return static_cast<int>(fused_.nodes.size()) - 1;
  }

  /// A new operation on values of the fused tape.
  int operation(int rule, std::vector<int> operands) {
    fused_.nodes.push_back(
        {.kind = Node::Kind::operation, .is_static = false, .rule = rule, .operands = std::move(operands)});
    return static_cast<int>(fused_.nodes.size()) - 1;
  }

  /// The sum of the terms, in squared norms, dot products and sums of as many components as there are rules for.
  int fuse(const Terms& terms) {
    std::vector<int> sums;
    for (std::size_t i = 0; i < terms.squares.size();) {
      std::vector<int> u;
      for (; i < terms.squares.size() && u.size() < 3; ++i) u.push_back(renamed_[terms.squares[i]]);
      const int rules[] = {rule_id<Square>, rule_id<SquaredNorm<2>>, rule_id<SquaredNorm<3>>};
      sums.push_back(operation(rules[u.size() - 1], u));
    }
    for (std::size_t i = 0; i < terms.products.size();) {
      std::vector<int> u;
      for (; i < terms.products.size() && u.size() < 6; ++i)
        for (int operand : terms.products[i]) u.push_back(renamed_[operand]);
      const int rules[] = {rule_id<Multiply>, rule_id<Dot<2>>, rule_id<Dot<3>>};
      sums.push_back(operation(rules[u.size() / 2 - 1], u));
    }
    for (int other : terms.others) sums.push_back(renamed_[other]);
    while (sums.size() > 1) {
      std::vector<int> shorter;
      for (std::size_t i = 0; i < sums.size();) {
        const std::size_t n = std::min<std::size_t>(4, sums.size() - i);
        const int rules[] = {-1, rule_id<Add>, rule_id<Sum<3>>, rule_id<Sum<4>>};
        shorter.push_back(n == 1
                              ? sums[i]
                              : operation(rules[n - 1], {sums.begin() + static_cast<std::ptrdiff_t>(i),
                                                         sums.begin() + static_cast<std::ptrdiff_t>(i + n)}));
        i += n;
      }
      sums = std::move(shorter);
    }
    return sums.front();
  }

  Tape tape_, fused_;
  std::vector<int> readers_, renamed_;
  std::vector<bool> read_by_a_sum_;
};

}  // namespace

Tape fused(const Tape& tape) {
  Fusion fusion(tape);
  fusion.find_sums();
  return fusion.result();
}

Tape with_separations(const Tape& tape) {
  Tape separated = tape;
  fuse_separations(separated);
  return pruned(separated);
}

}  // namespace jetlag
