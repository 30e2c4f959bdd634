// SPDX-License-Identifier: MIT
#pragma once
// The list of all functions of jets, each with the points at which its accuracy is measured.
//
// The table of bench/accuracy/table.md has a row for each, the test tests/series/functions/accuracy_test.cpp holds each to its
// limit. A new function gets a line in functions.cpp; the test says which rules of the register have none.

#include <array>
#include <boost/multiprecision/mpfr.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "jetlag/series/jet.hpp"

namespace jetlag::accuracy {

/// 75 digits, 252 bits.
using Precise = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<75, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

constexpr int degree = 20;
using Computed = Jet<double, degree>;
constexpr int neighbours = 5;  // that tell the amplitude of an oscillating coefficient
using True = Jet<Precise, degree + neighbours>;

/// A number without a series, of so many digits that differences give its derivatives.
using Wide = Jet<boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<750>,
                                               boost::multiprecision::et_off>,
                 0>;

/// One series for each operand; a number is a series of which the other coefficients are 0.
using Operands = std::vector<Computed>;

/// S_k and C_k of measure.hpp.
struct Terms {
  True sum;
  True condition;
};

/// Where the first coefficient of an operand is taken from, and how its series is scaled.
struct Domain {
  std::string text;
  std::vector<double> corners;          // points that are always taken
  std::function<double(double)> draw;   // from [0, 1) to a point
  std::function<double(double)> scale;  // of the coefficients 1, 2, ...: about the distance to a singularity,
                                        // 0 for a number
};

struct Function {
  std::string name;
  bool composed;                   // of more than one rule that rounds
  std::vector<std::string> rules;  // of the register, that it runs
  std::vector<Domain> domains;     // of each operand
  std::function<Computed(const Operands&)> computed;
  std::function<True(const Operands&)> truth;
  std::function<Wide(const std::vector<Wide>&)> value;  // of numbers: no recurrence
  std::function<Terms(const Operands&)> terms;

  /// The largest error that is allowed, in the units of measure.hpp.
  double limit() const { return composed ? 16 : 4; }
};

const std::vector<Function>& functions();

}  // namespace jetlag::accuracy
