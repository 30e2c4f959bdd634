// SPDX-License-Identifier: MIT
#pragma once
// A tape: the operations of one law, in the order in which they are computed.
//
// Values are of two sorts. A *static* value has no series: a constant of the law, a parameter of the element,
// or anything computed from these alone; it is computed once, when the elements are set up. A *series* value
// gains one coefficient for each order: an input (position, velocity, time) or anything that depends on one.
//
// The tape knows nothing of number types, blocks or memory; program.hpp lays it out.

#include <string>
#include <vector>

namespace jetlag {

/// What a tape reads from the scene. A separation is the position of `participant` minus that of `minus`.
struct Input {
  enum class Kind { position, velocity, time, separation } kind;
  int participant;  // 0 for time
  int component;    // 0 for time
  int minus = 0;    // of a separation
  friend bool operator==(const Input&, const Input&) = default;
};

struct Node {
  enum class Kind { constant, parameter, input, operation } kind;
  bool is_static;             // no series
  int rule = -1;              // operation: position in the register of rules
  std::vector<int> operands;  // operation: nodes; a coupled rule may name the node that follows it
  double value = 0.0;         // constant
  int parameter = -1;         // parameter: its number
  Input input{};              // input
};

/// A series whose sign has decided which way a tape goes: where it changes, the tape goes another way.
struct Condition {
  int node;
  int at_zero;        // the sign that a zero is taken for; 0: that of what follows
  int argument = -1;  // of a root, where that has a series
};

struct Tape {
  std::vector<Node> nodes;
  std::vector<int> outputs;
  std::vector<Condition> conditions{};  // those that are watched; see with_conditions
  int parameters = 0;                   // number of parameters of one element

  /// For each node, whether any rule reads coefficients older than the newest.
  std::vector<bool> keeps_history() const;

  /// For each node, whether it has a series of which only coefficient 0 is ever read: nothing is computed above it.
  std::vector<bool> ends_at_order_0() const;

  /// Whether no output has a series, so that orders above 0 are zero.
  bool is_static() const;

  /// One operation a line, for people: "v7 = multiply(v3, v6)   [history]".
  std::string to_string() const;
};

/// The tape with only what its outputs and conditions need, in the same order.
Tape pruned(const Tape& tape);

/// The tape with all conditions that its outputs depend on: u - v of a comparison u < v; u of a sign, and so of |u| and
/// max(u, v); a b - J of stretch invariants, zero where the rotation jumps; and the root of a square root, a length or a
/// power, which changes sign where the series goes on and the function turns back, as in sqrt(t^2); not that of a power below
/// -1/2 or of minus a parameter, which has a pole there. Where its argument crosses zero, as in sqrt(max(t, 0)), the root has
/// no series that tells: the argument is known beside it. All are computed to all orders.
Tape with_conditions(Tape tape);

}  // namespace jetlag
