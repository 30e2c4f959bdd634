// SPDX-License-Identifier: MIT
#pragma once
// What is on a tape, for tests of recordings.

#include <string>
#include <vector>

#include "jetlag/series/functions.hpp"
#include "jetlag/tape/tape.hpp"

namespace jetlag::testing {

/// The names of the operations, in their order: "[name]" without a series, "(name)" if only coefficient 0 is read.
inline std::vector<std::string> names_of_operations(const Tape& tape) {
  static const auto names = []<Rule... R>(RuleList<R...>) {
    return std::vector<std::string>{R::name...};
  }(Rules{});
  const auto ends = tape.ends_at_order_0();
  std::vector<std::string> found;
  for (std::size_t i = 0; i < tape.nodes.size(); ++i) {
    const Node& node = tape.nodes[i];
    if (node.kind != Node::Kind::operation) continue;
    const std::string name = names[node.rule];
    found.push_back(node.is_static ? "[" + name + "]" : ends[i] ? "(" + name + ")" : name);
  }
  return found;
}

}  // namespace jetlag::testing
