// SPDX-License-Identifier: MIT
#include "jetlag/tape/fusion.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

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
  struct Scaled {
    int constant, value;
    bool is_taken_away;
  };
  std::vector<int> squares;                  // u, for u^2
  std::vector<std::array<int, 2>> products;  // u, v, for u v
  std::vector<Scaled> scaled;                // c, u, for c u
  std::vector<int> others;

  std::size_t size() const { return squares.size() + products.size() + others.size(); }
};

/// Takes a tree of additions apart, as far as nothing else reads its parts; with_scaled: also where c u is taken away.
void take_apart(const Tape& tape, const std::vector<int>& readers, int i, bool is_root, bool with_scaled,
                Terms& terms) {
  const Node& node = tape.nodes[i];
  const auto scaled = [&](int operand, bool is_taken_away) {
    const Node& of = tape.nodes[operand];
    if (!with_scaled || readers[operand] != 1 || !is_operation(of, rule_id<Scale>)) return false;
    terms.scaled.push_back({of.operands[0], of.operands[1], is_taken_away});
    return true;
  };
  if (is_root || readers[i] == 1) {
    if (is_operation(node, rule_id<Add>)) {
      for (int operand : node.operands)
        if (!scaled(operand, false)) take_apart(tape, readers, operand, false, with_scaled, terms);
      return;
    }
    if (is_operation(node, rule_id<Subtract>) && scaled(node.operands[1], true)) {
      if (!scaled(node.operands[0], false))
        take_apart(tape, readers, node.operands[0], false, with_scaled, terms);
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
      : tape_(std::move(tape)),
        readers_(readers(tape_)),
        renamed_(tape_.nodes.size(), -1),
        negated_(tape_.nodes.size(), -1) {}

  Tape result() {
    for (std::size_t i = 0; i < tape_.nodes.size(); ++i) renamed_[i] = fused_or_same(static_cast<int>(i));
    for (Node& node : fused_.nodes)  // a coupled operation names one that comes later: renamed last
      for (int& operand : node.operands) operand = operand < 0 ? renamed_[-1 - operand] : operand;
    for (int output : tape_.outputs) fused_.outputs.push_back(renamed_[output]);
    fused_.parameters = tape_.parameters;
    return pruned(fused_);
  }

  void find_sums() {
    read_by_a_sum_.assign(tape_.nodes.size(), false);
    for (const Node& node : tape_.nodes) {
      if (is_operation(node, rule_id<Add>))
        for (int operand : node.operands) read_by_a_sum_[operand] = true;
      if (takes_scaled_away(node)) read_by_a_sum_[node.operands[0]] = true;
    }
  }

 private:
  /// What is taken apart here and again by a sum that takes it in is pruned in the end.
  int fused_or_same(int i) {
    const Node& node = tape_.nodes[i];
    const bool adds = is_operation(node, rule_id<Add>), subtracts = is_operation(node, rule_id<Subtract>);
    if (!adds && !subtracts) return append(node);
    if (readers_[i] == 1 && read_by_a_sum_[i] && (adds || takes_scaled_away(node))) return append(node);
    Terms linear;
    take_apart(tape_, readers_, i, true, true, linear);
    const bool takes_away = std::ranges::any_of(linear.scaled, &Terms::Scaled::is_taken_away);
    if (linear.scaled.size() > 1 || (takes_away && linear.size() > 1)) return linear_combination(linear);
    if (subtracts) {
      const int u = node.operands[0], v = node.operands[1];
      return is_product(u) && is_product(v)
                 ? operation(rule_id<DifferenceOfProducts>,
                             {factor(u, 0), factor(u, 1), factor(v, 0), factor(v, 1)})
                 : append(node);
    }
    Terms terms;
    take_apart(tape_, readers_, i, true, false, terms);
    const bool is_longer = terms.size() > 2 || terms.squares.size() == 2 || terms.products.size() == 2;
    return is_longer ? fuse(terms) : append(node);
  }

  bool takes_scaled_away(const Node& node) const {
    return is_operation(node, rule_id<Subtract>) && readers_[node.operands[1]] == 1 &&
           is_operation(tape_.nodes[node.operands[1]], rule_id<Scale>);
  }
  bool is_product(int i) const { return readers_[i] == 1 && is_operation(tape_.nodes[i], rule_id<Multiply>); }
  int factor(int product, int i) const { return renamed_[tape_.nodes[product].operands[i]]; }

  int append(Node node) {
    for (int& operand : node.operands) operand = renamed_[operand] >= 0 ? renamed_[operand] : -1 - operand;
    fused_.nodes.push_back(std::move(node));
    return static_cast<int>(fused_.nodes.size()) - 1;
  }

  /// A new operation on values of the fused tape.
  int operation(int rule, std::vector<int> operands, bool is_static = false) {
    fused_.nodes.push_back({.kind = Node::Kind::operation,
                            .is_static = is_static,
                            .rule = rule,
                            .operands = std::move(operands)});
    return static_cast<int>(fused_.nodes.size()) - 1;
  }

  /// A number of the tape, or minus that, which is computed once.
  int coefficient(const Terms::Scaled& term) {
    if (!term.is_taken_away) return renamed_[term.constant];
    int& negated = negated_[term.constant];
    if (negated < 0) negated = operation(rule_id<Negate>, {renamed_[term.constant]}, true);
    return negated;
  }

  /// The sum of the terms, those that are scaled last.
  int linear_combination(const Terms& terms) {
    std::size_t i = 0;
    int sum = terms.size() > 0 ? fuse(terms)
                               : operation(rule_id<Scale>,
                                           {coefficient(terms.scaled[0]), renamed_[terms.scaled[i++].value]});
    while (i < terms.scaled.size()) {
      constexpr std::array<std::pair<std::size_t, int>, 4> rules{{{5, rule_id<LinearCombination<5>>},
                                                                  {3, rule_id<LinearCombination<3>>},
                                                                  {2, rule_id<LinearCombination<2>>},
                                                                  {1, rule_id<LinearCombination<1>>}}};
      const std::size_t left = terms.scaled.size() - i;
      const auto [n, rule] = *std::ranges::find_if(rules, [&](const auto& r) { return r.first <= left; });
      std::vector<int> operands{sum};
      for (const std::size_t end = i + n; i < end; ++i)
        operands.insert(operands.end(), {coefficient(terms.scaled[i]), renamed_[terms.scaled[i].value]});
      sum = operation(rule, std::move(operands));
    }
    return sum;
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
  std::vector<int> negated_;  // of a number of the tape, in the fused one
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
