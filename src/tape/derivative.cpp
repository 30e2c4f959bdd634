// SPDX-License-Identifier: MIT
#include "jetlag/tape/derivative.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <stdexcept>
#include <string>
#include <utility>

#include "tape/adjoints.hpp"

namespace jetlag {

namespace {

bool is_operation(const Node& node) { return node.kind == Node::Kind::operation; }

bool is_zero(const Recording& recording, int i) {
  const Node* node = &recording.nodes()[i];
  if (is_operation(*node) && node->rule == rule_id<Embed>) node = &recording.nodes()[node->operands[0]];
  return node->kind == Node::Kind::constant && node->value == 0.0;
}

/// Whether a value is 0 on the other side of a choice, so that it need not be chosen once more.
bool vanishes_beside(const Recording& recording, const Side& side, int i) {
  const Node& node = recording.nodes()[i];
  if (!is_operation(node)) return false;
  if (node.rule == side.rule && node.operands[0] == side.by)
    return is_zero(recording, node.operands[side.second ? 1 : 2]);
  if (node.rule == rule_id<Scale>) return vanishes_beside(recording, side, node.operands[1]);
  static constexpr std::array linear{rule_id<Negate>, rule_id<DivideByConstant>, rule_id<Square>};
  return std::ranges::find(linear, node.rule) != linear.end() &&
         vanishes_beside(recording, side, node.operands[0]);
}

/// first or second, as the choice falls.
Recorded chosen(Recording& recording, const Side& side, const Recorded& first, const Recorded& second) {
  if (first.is_number() && second.is_number() && first.value() == second.value()) return first;
  if (!first.is_number() && !second.is_number() && first.node() == second.node()) return first;
  return recording.choose({side.rule, Recorded(&recording, side.by), {}, {}}, first, second);
}

bool is_sum(const Node& node) {
  static constexpr std::array sums{rule_id<Add>, rule_id<Subtract>, rule_id<Sum<3>>, rule_id<Sum<4>>};
  return is_operation(node) && std::ranges::find(sums, node.rule) != sums.end();
}

/// The name of a rule.
const char* name_of(int rule) {
  static const auto names = []<Rule... R>(RuleList<R...>) {
    return std::array<const char*, sizeof...(R)>{R::name...};
  }(Rules{});
  return names.at(rule);
}

/// Whether an operand is what a difference takes away.
bool is_second(const Node& node, int operand) {
  return node.rule == rule_id<Subtract> && node.operands[1] == operand;
}

}  // namespace

Adjoints::Adjoints(Recording& recording, const std::vector<Recorded>& inputs) : recording_(recording) {
  for (const Recorded& input : inputs)
    if (input.is_number() || is_operation(recording.nodes()[recording.node_of(input)]))
      throw std::invalid_argument("derivatives: by inputs and parameters of the recording alone");
  const auto& nodes = recording.nodes();
  depends_.assign(nodes.size(), false);
  adjoints_.resize(nodes.size());
  for (const Recorded& input : inputs) depends_[recording.node_of(input)] = true;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const int operand : nodes[i].operands) depends_[i] = depends_[i] || depends_[operand];
}

void Adjoints::run(const Recorded& output) {
  if (output.is_number() || !depends(recording_.node_of(output))) return;
  adjoints_[output.node()][{}].push_back({});
  for (here_node_ = output.node(); here_node_ >= 0; --here_node_) {
    if (!depends(here_node_) || adjoints_[here_node_].empty()) continue;
    here_ = recording_.nodes()[here_node_];  // a copy: the tape grows
    if (!is_operation(here_)) continue;
    const Derivative derivative = derivative_of(here_.rule);
    if (derivative == nullptr)
      throw std::invalid_argument(std::string("derivatives: '") + name_of(here_.rule) + "' has none");
    collect(adjoints_[here_node_]);
    const bool fans_out =
        is_sum(here_) && std::ranges::count_if(here_.operands, [&](int i) { return depends(i); }) > 1;
    for (const auto& [path, sum] : Adjoint(adjoints_[here_node_])) {
      path_ = path;
      adjoint_ = fans_out ? shared(sum.front()) : sum.front();
      derivative(*this);
    }
  }
}

/// Sums become one product each; where both sides of a choice have one, it is the choice between them.
void Adjoints::collect(Adjoint& adjoint) {
  const auto collected = [&](std::vector<Product>& sum) { sum = {sum_of(recording_, std::move(sum))}; };
  for (auto& [path, sum] : adjoint) collected(sum);
  std::erase_if(adjoint, [](const auto& entry) { return entry.second.front().is_zero(); });
  for (bool changed = true; std::exchange(changed, false);) {
    std::vector<Path> paths;
    for (const auto& [path, sum] : adjoint) paths.push_back(path);
    std::ranges::sort(paths, [](const Path& a, const Path& b) {  // the innermost choices first
      return a.size() != b.size() ? a.size() > b.size() : a < b;
    });
    for (const Path& first : paths) {
      if (first.empty() || first.back().second) continue;
      Path second = first;
      second.back().second = true;
      if (!adjoint.contains(second)) continue;
      std::vector<Product> both{adjoint[first].front(), adjoint[second].front()};
      const Product common = common_factor(both);
      const Recorded choice =
          chosen(recording_, first.back(), value_of(recording_, both[0]), value_of(recording_, both[1]));
      Path rest = first;
      rest.pop_back();
      adjoint.erase(first);
      adjoint.erase(second);
      auto& sum = adjoint[rest];
      sum.push_back(common * (recording_.is_static(choice) ? Product{.constant = choice}
                                                           : Product{.powers = {{choice.node(), 1.0}}}));
      collected(sum);
      changed = true;
      break;
    }
  }
}

/// An adjoint that goes to several terms of a sum is computed once, with the number that most of them will ask for: the 2 of
/// the derivative of a square, and the sign.
Product Adjoints::shared(const Product& adjoint) {
  double ahead = 0.0;
  bool is_linear = true;
  look_at_terms(here_node_, 1.0, ahead, is_linear);
  if (adjoint.powers.empty() || adjoint.is_value() || (adjoint.is_scaled_value() && is_linear))
    return adjoint;
  const Recorded value = value_of(recording_, ahead * adjoint);
  return {.number = 1.0 / ahead, .powers = {{value.node(), 1.0}}};
}

/// ahead: +-2 for the first square, or else the sign of the first term, as its operands will get it.
void Adjoints::look_at_terms(int i, double sign, double& ahead, bool& is_linear) const {
  const Node& node = recording_.nodes()[i];
  if (!depends(i)) return;
  if (is_operation(node) && is_sum(node)) {
    for (const int operand : node.operands)
      look_at_terms(operand, is_second(node, operand) ? -sign : sign, ahead, is_linear);
    return;
  }
  static constexpr std::array linear{rule_id<Embed>, rule_id<Negate>, rule_id<Offset>, rule_id<Scale>,
                                     rule_id<DivideByConstant>};
  const bool is_product = is_operation(node) && std::ranges::find(linear, node.rule) == linear.end();
  const double factor = is_product && node.rule == rule_id<Square> ? 2.0 : 1.0;
  is_linear = is_linear && !is_product;
  if (std::abs(ahead) < factor) ahead = factor * sign_ahead(i, sign);
}

/// The sign with which a value passes its adjoint on to an input, as far as it is a difference or the function of one.
double Adjoints::sign_ahead(int i, double sign) const {
  for (;;) {
    const Node& node = recording_.nodes()[i];
    const auto next =
        std::ranges::find_if(node.operands, [&](int operand) { return operand < i && depends(operand); });
    if (next == node.operands.end()) return sign;
    if (node.rule == rule_id<Negate> || is_second(node, *next)) sign = -sign;
    i = *next;
  }
}

void Adjoints::give(const Recorded& operand, const Product& local) {
  if (!operand.is_number() && depends(operand.node()) && !local.is_zero())
    adjoints_[operand.node()][path_].push_back(adjoint_ * local);
}

void Adjoints::give_where(const Recorded& operand, bool second) {
  if (!depends(operand.node())) return;
  const Side side{here_.rule, here_.operands[0], second}, other{side.rule, side.by, !second};
  if (std::ranges::find(path_, other) != path_.end()) return;  // never both
  Path path = path_;
  if (std::ranges::find(path, side) == path.end()) path.push_back(side);
  adjoints_[operand.node()][path].push_back(adjoint_);
}

void Adjoints::give_with_sign(const Recorded& operand, const Recorded& sign) {
  if (!depends(operand.node())) return;
  Product rest = adjoint_;
  rest.number = 1.0;
  const Recorded signed_value = detail::record<Abs>(sign, value_of(recording_, rest));
  adjoints_[operand.node()][path_].push_back(adjoint_.number *
                                             (recording_.is_static(signed_value)
                                                  ? Product{.constant = signed_value}
                                                  : Product{.powers = {{signed_value.node(), 1.0}}}));
}

Recorded Adjoints::of(const Recorded& input) {
  Adjoint& adjoint = adjoints_[recording_.node_of(input)];
  collect(adjoint);
  Recorded sum = 0.0;
  for (const auto& [path, products] : adjoint) {
    Recorded value = value_of(recording_, products.front());
    for (const Side& side : std::views::reverse(path)) {
      if (!value.is_number() && vanishes_beside(recording_, side, value.node())) continue;
      value = side.second ? chosen(recording_, side, 0.0, value) : chosen(recording_, side, value, 0.0);
    }
    sum = sum + value;
  }
  return sum;
}

std::vector<Recorded> derivatives(Recording& recording, const Recorded& output,
                                  const std::vector<Recorded>& inputs) {
  Adjoints adjoints(recording, inputs);
  adjoints.run(output);
  std::vector<Recorded> all;
  for (const Recorded& input : inputs) all.push_back(adjoints.of(input));
  return all;
}

bool has_derivative(int rule) { return derivative_of(rule) != nullptr; }

}  // namespace jetlag
