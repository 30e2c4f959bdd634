// SPDX-License-Identifier: MIT
#pragma once
// Products of powers of recorded values, which are multiplied out as late as can be: then powers of the same value meet,
//
//   d/dx (k/2 (r - L)^2) = k (r - L)  1/(2 r)  2 x,      r = sqrt(x^2 + ...)
//   d/dx (-c / r)        = c q^-1  1/2 q^-1/2  2 x = c q^-3/2 x,      q = r^2
//
// numbers cancel, and what has no series is one factor.

#include <map>
#include <vector>

#include "jetlag/tape/recording.hpp"

namespace jetlag {

/// number x constant x the product of value^exponent. A constant has no series.
struct Product {
  double number = 1.0;
  Recorded constant = 1.0;
  std::map<int, double> powers{};  // by node

  bool is_zero() const { return number == 0.0; }
  /// Whether it is a value times what has no series.
  bool is_scaled_value() const { return powers.size() == 1 && powers.begin()->second == 1.0; }
  /// Whether it is a value times a number.
  bool is_value() const { return is_scaled_value() && constant.is_number(1.0); }
};

Product operator*(const Product& a, const Product& b);
Product operator*(double number, Product a);
Product operator-(Product a);

/// A value by what it is made of: products, squares, roots, reciprocals. A quotient stays: what it is the derivative of uses it.
Product product_of(Recording& recording, const Recorded& value);

/// a^exponent for -1 or 2. Other powers are of values: power_of.
Product reciprocal(Recording& recording, const Product& a);
Product squared(const Product& a);
/// value^exponent.
Product power_of(Recording& recording, const Recorded& value, double exponent);

/// The product, recorded.
Recorded value_of(Recording& recording, const Product& product);

/// What all have in common is taken out of them.
Product common_factor(std::vector<Product>& products);

/// The sum as one product: equal powers are collected, common factors taken out, the rest is recorded.
Product sum_of(Recording& recording, std::vector<Product> products);

}  // namespace jetlag
