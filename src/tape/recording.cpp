// SPDX-License-Identifier: MIT
#include "jetlag/tape/recording.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "jetlag/tape/fusion.hpp"

namespace jetlag {

int Recording::append(Node node) {
  tape_.nodes.push_back(std::move(node));
  return static_cast<int>(tape_.nodes.size()) - 1;
}

Recorded Recording::input(Input input) {
  const auto key = std::tuple(static_cast<int>(input.kind), input.participant, input.component);
  if (const auto found = inputs_.find(key); found != inputs_.end()) return {this, found->second};
  const int node = append({.kind = Node::Kind::input, .is_static = false, .operands = {}, .input = input});
  inputs_[key] = node;
  return {this, node};
}

Recorded Recording::parameter(int number) {
  if (const auto found = parameters_.find(number); found != parameters_.end()) return {this, found->second};
  const int node =
      append({.kind = Node::Kind::parameter, .is_static = true, .operands = {}, .parameter = number});
  tape_.parameters = std::max(tape_.parameters, number + 1);
  parameters_[number] = node;
  return {this, node};
}

int Recording::node_of(const Recorded& x) {
  if (!x.is_number()) {
    if (x.recording() != this) throw std::invalid_argument("Recording: a value of another recording");
    return x.node();
  }
  const auto key =
      std::bit_cast<std::uint64_t>(x.value());  // by bits: 0.0 and -0.0 differ, NaN equals itself
  if (const auto found = constants_.find(key); found != constants_.end()) return found->second;
  return constants_[key] =
             append({.kind = Node::Kind::constant, .is_static = true, .operands = {}, .value = x.value()});
}

bool Recording::is_static(const Recorded& x) const {
  if (x.is_number()) return true;
  if (x.recording() != this) throw std::invalid_argument("Recording: a value of another recording");
  return tape_.nodes[x.node()].is_static;
}

namespace {
std::pair<int, std::vector<int>> key_of(int rule, std::vector<int> operands) {
  if (rule == rule_id<Add> || rule == rule_id<Multiply>) std::ranges::sort(operands);  // they commute
  return {rule, std::move(operands)};
}
}  // namespace

bool Recording::knows(int rule, std::vector<int> operands) const {
  return operations_.contains(key_of(rule, std::move(operands)));
}

Recorded Recording::operation(int rule, std::vector<int> operands, bool is_static) {
  const auto key = key_of(rule, std::move(operands));
  if (const auto found = operations_.find(key); found != operations_.end()) return {this, found->second};
  const int node =
      append({.kind = Node::Kind::operation, .is_static = is_static, .rule = rule, .operands = key.second});
  operations_[key] = node;
  return {this, node};
}

std::pair<Recorded, Recorded> Recording::coupled(int rule_a, int rule_b, std::vector<int> u, bool is_static) {
  const auto key = std::pair(rule_a, std::move(u));
  if (const auto found = operations_.find(key); found != operations_.end())
    return {Recorded(this, found->second), Recorded(this, found->second + 1)};
  const int a = static_cast<int>(tape_.nodes.size()), b = a + 1;
  const auto add = [&](int rule, int other) {
    std::vector<int> operands = key.second;
    operands.push_back(other);
    append({.kind = Node::Kind::operation,
            .is_static = is_static,
            .rule = rule,
            .operands = std::move(operands)});
  };
  add(rule_a, b);
  add(rule_b, a);
  operations_[key] = a;
  return {Recorded(this, a), Recorded(this, b)};
}

std::optional<Recording::Choice> Recording::choice_beside_constant(const Recorded& x) {
  if (is_static(x) || tape_.nodes[x.node()].kind != Node::Kind::operation) return {};
  const Node node = tape_.nodes[x.node()];  // a copy: the tape grows below
  const auto operand = [&](int i) { return Recorded(this, node.operands[i]); };
  const auto each = [&](int i, auto f) {  // f of both values of the choice that operand i is
    auto of = choice_beside_constant(operand(i));
    if (of) *of = {of->rule, of->by, f(of->first), f(of->second)};
    return of;
  };
  if (node.rule == rule_id<Negate>) return each(0, [](const Recorded& u) { return -u; });
  if (node.rule == rule_id<Scale>) return each(1, [&](const Recorded& u) { return operand(0) * u; });
  if (node.rule == rule_id<DivideByConstant>)
    return each(0, [&](const Recorded& u) { return u / operand(1); });
  if (node.rule != rule_id<Select> && node.rule != rule_id<BySign>) return {};
  const auto number = [&](int i) {  // rather than its series
    int value = node.operands[i];
    if (tape_.nodes[value].rule == rule_id<Embed>) value = tape_.nodes[value].operands[0];
    const Node& of = tape_.nodes[value];
    return of.kind == Node::Kind::constant ? Recorded(of.value) : Recorded(this, value);
  };
  const Choice choice{node.rule, operand(0), number(1), number(2)};
  if (!is_static(choice.first) && !is_static(choice.second)) return {};
  return choice;
}

Recorded Recording::choose(const Choice& as, const Recorded& first, const Recorded& second) {
  if (as.rule == rule_id<Select>) return detail::record<Select>(as.by, first, second);
  return detail::record<BySign>(as.by, first, second);
}

Tape Recording::finish(const std::vector<Recorded>& outputs) {
  tape_.outputs.clear();
  for (const Recorded& output : outputs) tape_.outputs.push_back(node_of(output));
  // Either no output has a series, or all do: a constant component beside others is zero at the orders above 0.
  if (!tape_.is_static())
    for (int& output : tape_.outputs)
      if (tape_.nodes[output].is_static) output = operation(rule_id<Embed>, {output}, false).node();
  return fused(pruned(tape_));
}

namespace {
/// The value when all operands are static, so that the general rule at order 0 serves.
bool both_static(const Recorded& u, const Recorded& v) {
  const Recording* recording = detail::recording_of(u, v);
  return !recording || (recording->is_static(u) && recording->is_static(v));
}
bool is_static(const Recorded& u) { return u.is_number() || u.recording()->is_static(u); }

/// log(u), also of a number recorded: the tape computes it in the precision of its own number type.
Recorded log_of(const Recorded& u, Recording& recording) {
  return log(Recorded(&recording, recording.node_of(u)));
}

/// (x^2 + y^2) / h_0, h_0 = hypot(x_0, y_0): one value for hypot(x, y), hypot(y, x) and atan2 of both.
Recorded scaled_squares(const Recorded& x, const Recorded& y) {
  if (is_static(x) != is_static(y) ? is_static(x) : x.node() > y.node()) return scaled_squares(y, x);
  const Recorded length = detail::record<Length>(x, y);
  if (is_static(y) && !is_static(x)) return detail::record<ScaledSquare>(length, x);
  return detail::record<ScaledSumOfSquares>(length, x, y);
}
}  // namespace

Recorded operator+(const Recorded& u, const Recorded& v) {
  if (u.is_number(0.0)) return v;
  if (v.is_number(0.0)) return u;
  if (both_static(u, v)) return detail::record<Add>(u, v);
  if (is_static(u)) return detail::record<Offset>(u, v);
  if (is_static(v)) return detail::record<Offset>(v, u);
  return detail::record<Add>(u, v);
}

Recorded operator-(const Recorded& u, const Recorded& v) {
  if (v.is_number(0.0)) return u;
  if (both_static(u, v)) return detail::record<Subtract>(u, v);
  if (is_static(u)) return detail::record<Offset>(u, -v);
  if (is_static(v)) return detail::record<Offset>(-v, u);
  return detail::record<Subtract>(u, v);
}

Recorded operator-(const Recorded& u) { return detail::record<Negate>(u); }

Recorded operator*(const Recorded& u, const Recorded& v) {
  if (u.is_number(1.0)) return v;
  if (v.is_number(1.0)) return u;
  if (both_static(u, v)) return detail::record<Multiply>(u, v);
  if (is_static(u)) return detail::record<Scale>(u, v);
  if (is_static(v)) return detail::record<Scale>(v, u);
  if (u.node() == v.node()) return detail::record<Square>(u);
  return detail::record<Multiply>(u, v);
}

Recorded pow(const Recorded& u, const Recorded& v) {
  if (v.is_number()) return pow(u, v.value());
  if (is_static(v)) return detail::record<Power>(v, u);
  return detail::record<PowerOfSeries>(u, v, v * log_of(u, *v.recording()));
}

Recorded hypot(const Recorded& x, const Recorded& y) {
  if (both_static(x, y)) return detail::record<Length>(x, y);
  return detail::record<RootOfScaled>(scaled_squares(x, y));
}

Recorded atan2(const Recorded& y, const Recorded& x) {
  const Recorded w = scaled_squares(x, y);
  if (both_static(x, y)) return detail::record<Atan2>(y, x, w);
  if (is_static(y)) return detail::record<Atan2OfConstant>(y, x, w);
  if (is_static(x)) return detail::record<Atan2OverConstant>(x, y, w);
  return detail::record<Atan2>(y, x, w);
}

Recorded operator/(const Recorded& u, const Recorded& v) {
  if (v.is_number(1.0)) return u;
  if (both_static(u, v)) return detail::record<Divide>(u, v);
  if (is_static(v)) return detail::record<DivideByConstant>(u, v);
  if (is_static(u)) return detail::record<Reciprocal>(u, v);
  return detail::record<Divide>(u, v);
}

RecordedCondition operator<(const Recorded& u, const Recorded& v) {
  return RecordedCondition(detail::record<Less>(u, v));
}
RecordedCondition operator<=(const Recorded& u, const Recorded& v) {
  return RecordedCondition(detail::record<LessOrEqual>(u, v));
}
RecordedCondition operator&&(const RecordedCondition& a, const RecordedCondition& b) {
  return RecordedCondition(detail::record<And>(a.holds(), b.holds()));
}
RecordedCondition operator||(const RecordedCondition& a, const RecordedCondition& b) {
  return RecordedCondition(detail::record<Or>(a.holds(), b.holds()));
}
RecordedCondition operator!(const RecordedCondition& a) {
  return RecordedCondition(detail::record<Not>(a.holds()));
}

Recorded select(const RecordedCondition& condition, const Recorded& a, const Recorded& b) {
  const Recorded& holds = condition.holds();
  if (holds.is_number()) return holds.value() != 0.0 ? a : b;
  return detail::record<Select>(holds, a, b);
}

Recorded min(const Recorded& u, const Recorded& v) {
  return detail::record<BySign>(detail::record<Sign>(u - v), u, v);
}
Recorded max(const Recorded& u, const Recorded& v) {
  return detail::record<BySign>(detail::record<Sign>(u - v), v, u);
}

}  // namespace jetlag
