// SPDX-License-Identifier: MIT
#include "tape/product.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>

namespace jetlag {

namespace {

bool is_whole(double x) { return x == std::trunc(x); }

/// Of a few binary digits, so that sums and products of such numbers are exact.
bool is_short(double x) { return is_whole(16 * x) && std::abs(x) < 1024; }

bool is_power_of_two(double x) {
  int exponent = 0;
  return std::abs(std::frexp(x, &exponent)) == 0.5;
}

/// Whether two values are known to be the same.
bool same(const Recorded& a, const Recorded& b) {
  return a.is_number() == b.is_number() && (a.is_number() ? a.value() == b.value() : a.node() == b.node());
}

/// value^n, n >= 1, by repeated squaring.
Recorded whole_power(const Recorded& value, int n) {
  if (n == 1) return value;
  const Recorded half = whole_power(value, n / 2), whole = half * half;
  return n % 2 == 0 ? whole : whole * value;
}

/// The product of all, by products that have been recorded where there are any.
Recorded multiplied(const Recording& recording, std::vector<Recorded> all) {
  const auto known = [&] {
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = i + 1; j < all.size(); ++j)
        if (recording.knows(rule_id<Multiply>, {all[i].node(), all[j].node()})) return std::pair(i, j);
    return std::pair<std::size_t, std::size_t>(0, 1);
  };
  while (all.size() > 1) {
    const auto [i, j] = known();
    all[i] = all[i] * all[j];
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(j));
  }
  return all.front();
}

}  // namespace

Product operator*(const Product& a, const Product& b) {
  Product product{a.number * b.number, a.constant * b.constant, a.powers};
  for (const auto& [value, exponent] : b.powers)
    if ((product.powers[value] += exponent) == 0.0) product.powers.erase(value);
  return product;
}
Product operator*(double number, Product a) {
  a.number *= number;
  return a;
}
Product operator-(Product a) { return -1.0 * std::move(a); }

Product product_of(Recording& recording, const Recorded& value) {
  if (value.is_number()) return {.number = value.value()};
  const Node node = recording.nodes()[value.node()];  // a copy: the tape grows
  if (node.kind == Node::Kind::constant && is_short(node.value)) return {.number = node.value};
  if (recording.is_static(value)) return {.constant = value};
  const auto operand = [&](int i) { return Recorded(&recording, node.operands[i]); };
  const auto factor = [&](int i) { return product_of(recording, operand(i)); };
  if (node.rule == rule_id<Embed>) return factor(0);
  if (node.rule == rule_id<Negate>) return -factor(0);
  if (node.rule == rule_id<Scale> || node.rule == rule_id<Multiply>) return factor(0) * factor(1);
  if (node.rule == rule_id<Square>) return squared(factor(0));
  if (node.rule == rule_id<DivideByConstant>) return factor(0) * reciprocal(recording, factor(1));
  if (node.rule == rule_id<Reciprocal>) return factor(0) * reciprocal(recording, factor(1));
  if (node.rule == rule_id<Sqrt>) return power_of(recording, operand(0), 0.5);
  if (node.rule == rule_id<Power>) {
    const Node& exponent = recording.nodes()[node.operands[0]];
    if (exponent.kind == Node::Kind::constant && is_short(exponent.value))
      return power_of(recording, operand(1), exponent.value);
  }
  return {.powers = {{value.node(), 1.0}}};
}

Product reciprocal(Recording& recording, const Product& a) {
  Product result{1.0, 1.0, a.powers};
  for (auto& [value, exponent] : result.powers) exponent = -exponent;
  if (is_power_of_two(a.number) && a.constant.is_number(1.0)) {
    result.number = 1.0 / a.number;
  } else {  // by the tape, in the precision of its numbers
    const Recorded constant = a.number * a.constant;
    result.constant = Recorded(1.0) / Recorded(&recording, recording.node_of(constant));
  }
  return result;
}

Product squared(const Product& a) { return a * a; }

Product power_of(Recording& recording, const Recorded& value, double exponent) {
  if (recording.is_static(value)) {
    if (exponent == 1.0) return product_of(recording, value);
    if (exponent == -1.0) return reciprocal(recording, product_of(recording, value));
    return {.constant = exponent == 0.5 ? sqrt(value) : detail::record<Power>(Recorded(exponent), value)};
  }
  if (exponent == 1.0) return product_of(recording, value);
  if (exponent == -1.0) return reciprocal(recording, product_of(recording, value));
  return {.powers = {{value.node(), exponent}}};
}

Recorded value_of(Recording& recording, const Product& product) {
  const Recorded factor = product.number * product.constant;
  std::vector<Recorded> above, below;
  for (const auto& [node, exponent] : product.powers) {
    const Recorded value(&recording, node);
    if (exponent == 0.5) {
      above.push_back(sqrt(value));
    } else if (exponent > 0 && is_whole(exponent)) {
      above.push_back(whole_power(value, static_cast<int>(exponent)));
    } else if (exponent == -0.5) {
      below.push_back(sqrt(value));
    } else if (exponent == -1.0) {
      below.push_back(value);
    } else {  // one operation, whatever the exponent; below 0 there is no power at 0 either way
      above.push_back(detail::record<Power>(Recorded(exponent), value));
    }
  }
  if (above.empty()) return below.empty() ? factor : factor / multiplied(recording, below);
  const Recorded numerator = multiplied(recording, above);
  const Recorded scaled = factor.is_number(-1.0) ? -numerator : factor * numerator;
  return below.empty() ? scaled : scaled / multiplied(recording, below);
}

Product common_factor(std::vector<Product>& products) {
  Product common;
  for (const auto& [value, exponent] : std::map(products.front().powers)) {
    const auto has_it = [&](const Product& product) {
      const auto found = product.powers.find(value);
      return found != product.powers.end() && found->second == exponent;
    };
    if (!std::ranges::all_of(products, has_it)) continue;
    common.powers[value] = exponent;
    for (Product& product : products) product.powers.erase(value);
  }
  return common;
}

Product sum_of(Recording& recording, std::vector<Product> products) {
  std::vector<Product> different;
  for (const Product& product : products) {
    const auto equal = std::ranges::find(different, product.powers, &Product::powers);
    if (equal == different.end()) {
      different.push_back(product);
    } else if (same(equal->constant, product.constant)) {
      equal->number += product.number;
    } else {
      equal->constant = equal->number * equal->constant + product.number * product.constant;
      equal->number = 1.0;
    }
  }
  std::erase_if(different, [](const Product& product) { return product.is_zero(); });
  if (different.empty()) return {.number = 0.0};
  if (different.size() == 1) return different.front();
  const Product common = common_factor(different);
  // b - a rather than -a + b; other numbers take their sign along, and sums of several terms are one operation.
  const auto is_taken_away = [](const Product& product) {
    return product.number == -1.0 && product.constant.is_number(1.0);
  };
  const auto first = std::ranges::find_if_not(different, is_taken_away);
  if (first != different.end()) std::swap(different.front(), *first);
  Recorded sum = value_of(recording, different.front());
  for (const Product& product : different | std::views::drop(1))
    sum = is_taken_away(product) ? sum - value_of(recording, -product) : sum + value_of(recording, product);
  return common *
         (recording.is_static(sum) ? Product{.constant = sum} : Product{.powers = {{sum.node(), 1.0}}});
}

}  // namespace jetlag
