// SPDX-License-Identifier: MIT
#include "jetlag/tape/tape.hpp"

#include <array>
#include <span>

#include "jetlag/series/functions.hpp"

namespace jetlag {

namespace {

struct RuleFacts {
  const char* name;
  std::span<const Reads> reads;  // operands, then the result itself
};

template <Rule... R>
std::array<RuleFacts, sizeof...(R)> facts_of(RuleList<R...>) {
  return {RuleFacts{R::name, R::reads}...};
}

const RuleFacts& facts(int rule) {
  static const auto table = facts_of(Rules{});
  return table.at(rule);
}

std::vector<int> watched(const std::vector<Condition>& conditions) {
  std::vector<int> nodes;
  for (const Condition& condition : conditions) {
    nodes.push_back(condition.node);
    if (condition.argument >= 0) nodes.push_back(condition.argument);
  }
  return nodes;
}

}  // namespace

std::vector<bool> Tape::keeps_history() const {
  std::vector<bool> keeps(nodes.size(), false);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    if (node.kind != Node::Kind::operation || node.is_static) continue;
    const auto reads = facts(node.rule).reads;
    for (std::size_t a = 0; a < node.operands.size(); ++a)
      if (reads[a] == Reads::history || reads[a] == Reads::first) keeps[node.operands[a]] = true;
    if (reads.back() == Reads::history) keeps[i] = true;
  }
  for (const int node : watched(conditions)) keeps[node] = true;
  const auto ends = ends_at_order_0();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].is_static || ends[i]) keeps[i] = false;
  return keeps;
}

std::vector<bool> Tape::ends_at_order_0() const {
  // From the outputs backwards: a node ends at order 0 when each of its readers reads coefficient 0, or ends itself.
  std::vector<bool> goes_on(nodes.size(), false);
  for (int output : outputs) goes_on[output] = true;
  for (const int node : watched(conditions)) goes_on[node] = true;
  for (bool changed = true; changed;) {  // more than once only for coupled rules, which read forwards
    changed = false;
    for (std::size_t i = nodes.size(); i-- > 0;) {
      const Node& node = nodes[i];
      if (node.kind != Node::Kind::operation || !goes_on[i]) continue;
      const auto reads = facts(node.rule).reads;
      for (std::size_t a = 0; a < node.operands.size(); ++a)
        if (reads[a] != Reads::first && !goes_on[node.operands[a]])
          goes_on[node.operands[a]] = changed = true;
    }
  }
  std::vector<bool> ends(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    ends[i] = !nodes[i].is_static && nodes[i].kind == Node::Kind::operation && !goes_on[i];
  return ends;
}

bool Tape::is_static() const {
  for (int output : outputs)
    if (!nodes[output].is_static) return false;
  return true;
}

std::string Tape::to_string() const {
  const auto keeps = keeps_history(), ends = ends_at_order_0();
  std::string text;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    text += "v" + std::to_string(i) + " = ";
    switch (node.kind) {
      case Node::Kind::constant: text += std::to_string(node.value); break;
      case Node::Kind::parameter: text += "parameter " + std::to_string(node.parameter); break;
      case Node::Kind::input: {
        static constexpr const char* names[] = {"position", "velocity", "time", "separation"};
        text += names[static_cast<int>(node.input.kind)];
        if (node.input.kind != Input::Kind::time)
          text += "[" + std::to_string(node.input.participant) +
                  (node.input.kind == Input::Kind::separation ? "-" + std::to_string(node.input.minus) : "") +
                  "][" + std::to_string(node.input.component) + "]";
        break;
      }
      case Node::Kind::operation: {
        text += std::string(facts(node.rule).name) + "(";
        for (std::size_t a = 0; a < node.operands.size(); ++a)
          text += (a ? ", v" : "v") + std::to_string(node.operands[a]);
        text += ")";
      }
    }
    text += node.is_static ? "   [static]" : ends[i] ? "   [order 0]" : keeps[i] ? "   [history]" : "";
    text += "\n";
  }
  for (int output : outputs) text += "output v" + std::to_string(output) + "\n";
  for (const Condition& condition : conditions) text += "condition v" + std::to_string(condition.node) + "\n";
  return text;
}

Tape pruned(const Tape& tape) {
  std::vector<bool> needed(tape.nodes.size(), false);
  std::vector<int> open = tape.outputs;
  for (const int node : watched(tape.conditions)) open.push_back(node);
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    if (needed[i]) continue;
    needed[i] = true;
    open.insert(open.end(), tape.nodes[i].operands.begin(), tape.nodes[i].operands.end());
  }
  Tape kept;
  kept.parameters = tape.parameters;
  std::vector<int> renamed(tape.nodes.size(), -1);
  for (std::size_t i = 0; i < tape.nodes.size(); ++i)
    if (needed[i]) {
      renamed[i] = static_cast<int>(kept.nodes.size());
      kept.nodes.push_back(tape.nodes[i]);
    }
  for (Node& node : kept.nodes)
    for (int& operand : node.operands) operand = renamed[operand];
  for (int output : tape.outputs) kept.outputs.push_back(renamed[output]);
  for (const auto& [node, at_zero, argument] : tape.conditions)
    kept.conditions.push_back({renamed[node], at_zero, argument < 0 ? -1 : renamed[argument]});
  return kept;
}

}  // namespace jetlag
