// SPDX-License-Identifier: MIT
#pragma once
// Sequential truncation: after each term it is decided, in view of those known, with what probability to go on.
//
//     g = c_0 + .. + c_m + [U_1 < p_{m+1}] / p_{m+1} (c_{m+1} + [U_2 < p_{m+2}] / p_{m+2} (c_{m+2} + ..
//
// p_n may depend on c_0 .. c_{n-1}: given these, term n is kept with probability p_n and weighted with 1 / p_n, so the
// sum is unbiased as before, and no term beyond K is ever needed. One uniform number serves all decisions: go on
// to n while u <= P_n = p_{m+1} .. p_n. Given all terms, the law is a tail like any other: given().
// Source: Bhanot, Kennedy 1985 (the estimator); Russian roulette.

#include <functional>
#include <span>
#include <string>
#include <variant>

#include "jetlag/truncation/truncation.hpp"

namespace jetlag {

class SequentialLaw {
 public:
  /// p_n in (0, 1], from the sizes |c_0| .. |c_{n-1}| of the terms known and the weight 1 / P_{n-1} of the last of
  /// them.
  using Rule = std::function<double(int n, std::span<const double> sizes, double weight)>;

  /// 0 <= min_degree <= max_degree, max_degree >= 1. least: what the rule gives is raised to it; in (0, 1]. Weights stay
  /// below least^-(max_degree - min_degree), and below 1 / least_probability (truncation/draws.hpp): where they would
  /// exceed it, the sum goes on surely. Throws std::invalid_argument.
  SequentialLaw(std::string name, int min_degree, int max_degree, double least, Rule rule);

  const std::string& name() const { return name_; }
  int min_degree() const { return min_; }
  int max_degree() const { return max_; }

  /// p_n: what the rule says, between `least` and 1; `least` where it says NaN.
  double go_on(int n, std::span<const double> sizes, double weight) const;

  /// The law for these terms: P(K >= n) given that they are what they are. At least max_degree() terms (the last is not
  /// asked for); throws std::invalid_argument for fewer.
  TruncationLaw given(std::span<const double> terms) const;

  /// The smallest tail the law may have, max(least^(n-m), least_probability): what is known before any term.
  TruncationLaw lower_bound() const;

 private:
  std::string name_;
  int min_, max_;
  double least_;
  Rule rule_;
};

/// Russian roulette: go on surely while the next weighted term is expected to be as large as `target`, else with the
/// probability that makes it so,
///
///     p_n = min(1, w_{n-1} e_n / target),      e_n = a min(1, sqrt(a / b)),
///
/// e_n: what the larger a of the last two terms says about the next, b that of the two before them (a series may have
/// only even or only odd terms). target [unit of the terms], > 0.
/// 1 <= min_degree <= max_degree; least: see SequentialLaw.
/// Source: throughput roulette of light transport; the prediction is ours.   Throws std::invalid_argument.
SequentialLaw sequential(int min_degree, int max_degree, double target, double least = 0.05);

/// Where a series is stopped: by a law known beforehand, or in view of its terms.
using Truncation = std::variant<TruncationLaw, SequentialLaw>;

/// The law before any term is known: of a sequential one its lower bound.
TruncationLaw known_beforehand(const Truncation& law);

}  // namespace jetlag
