// SPDX-License-Identifier: MIT
#pragma once
// The adjoints of a recording: of each value the derivative of the output by it, gathered from the output backwards.

#include <compare>
#include <map>
#include <vector>

#include "tape/product.hpp"

namespace jetlag {

/// One side of a choice: Select or BySign, and what decides.
struct Side {
  int rule, by;
  bool second;
  auto operator<=>(const Side&) const = default;
};

/// The choices, outermost first, that must fall to one side for a derivative to count. They are made last: what is not
/// chosen may be NaN, and 0 NaN is NaN.
using Path = std::vector<Side>;
using Adjoint = std::map<Path, std::vector<Product>>;  // sums

class Adjoints {
 public:
  Adjoints(Recording& recording, const std::vector<Recorded>& inputs);

  void run(const Recorded& output);
  Recorded of(const Recorded& input);

  // ---- for the derivatives of the rules: derivative_rules.cpp ----

  Recording& recording() { return recording_; }
  Recorded operand(int i) { return {&recording_, here_.operands[i]}; }
  Recorded result() { return {&recording_, here_node_}; }
  const Node& node(const Recorded& value) const { return recording_.nodes()[value.node()]; }
  bool depends_on_inputs(const Recorded& value) const { return !value.is_number() && depends(value.node()); }

  /// A value as a factor of a derivative, and its reciprocal.
  Product value(const Recorded& x) { return product_of(recording_, x); }
  Product one_over(const Recorded& x) { return power_of(recording_, x, -1.0); }
  Product power(const Recorded& x, double exponent) { return power_of(recording_, x, exponent); }

  /// d result / d operand = local.
  void give(const Recorded& operand, const Product& local);
  void give(const Recorded& operand, double local) { give(operand, Product{.number = local}); }
  /// The operand is what is chosen on one side, else no matter.
  void give_where(const Recorded& operand, bool second);
  /// The same for |u|: the adjoint takes the sign s.
  void give_with_sign(const Recorded& operand, const Recorded& sign);

 private:
  bool depends(int node) const { return node < static_cast<int>(depends_.size()) && depends_[node]; }
  void collect(Adjoint& adjoint);
  Product shared(const Product& adjoint);
  void look_at_terms(int i, double sign, double& ahead, bool& is_linear) const;
  double sign_ahead(int i, double sign) const;

  Recording& recording_;
  std::vector<bool> depends_;  // on the inputs
  std::vector<Adjoint> adjoints_;
  Node here_{};
  int here_node_ = -1;
  Path path_;
  Product adjoint_;
};

/// Gives the operands of a rule their derivatives; null for a rule without.
using Derivative = void (*)(Adjoints&);
Derivative derivative_of(int rule);

}  // namespace jetlag
