// SPDX-License-Identifier: MIT
#pragma once
// Truncation laws: the distribution of the random degree K at which a series is stopped.
//
// A law is known by its tail P(K >= n), n = 0 .. N. The series of terms c_n, stopped at K and weighted,
//
//     g = sum_{n=0..K} c_n / P(K >= n),
//
// is unbiased for the whole sum: E g = sum_{n=0..N} c_n, because term n is kept with probability P(K >= n).
// Source: McLeish 2011; Rhee, Glynn 2015 (coupled sum).

#include <span>
#include <string>
#include <vector>

namespace jetlag {

class TruncationLaw {
 public:
  /// tail[n] = P(K >= n) for n = 0 .. N: starts at 1, does not rise, stays > 0 with finite weights.
  /// Throws std::invalid_argument.
  TruncationLaw(std::string name, std::vector<double> tail);

  const std::string& name() const { return name_; }

  /// P(K >= n); 0 beyond the largest degree.
  double at_least(int n) const { return n < static_cast<int>(tail_.size()) ? tail_[n] : 0.0; }

  /// Weight of term n: 1 / P(K >= n), n <= max_degree().
  double weight(int n) const { return 1.0 / tail_[n]; }

  int min_degree() const { return min_; }                                // K >= min_degree surely
  int max_degree() const { return static_cast<int>(tail_.size()) - 1; }  // K <= max_degree surely
  bool is_fixed() const { return min_degree() == max_degree(); }

  /// E K = sum_{n>=1} P(K >= n).
  double mean() const;

  /// K by inversion: the largest n with u <= P(K >= n), for u uniform on (0, 1].
  int draw(double u) const;

 private:
  std::string name_;
  std::vector<double> tail_;
  int min_;
};

/// K = degree. degree >= 1.
TruncationLaw fixed_degree(int degree);

/// K = min(N, m + G), P(G = i) = p (1-p)^i:  P(K >= n) = (1-p)^(n-m) for m < n <= N.         Source: the paper, corrected.
/// 1 <= m = min_degree <= N = max_degree; 0 < p < 1 (p = 0 or m = N: K = N; p = 1 is refused unless m = N: the
/// terms above m would never be drawn).   Throws std::invalid_argument.
TruncationLaw geometric(int min_degree, int max_degree, double p);

/// Var g and Cov(g, f) for the terms of one or two series stopped by the same draw, in O(N):
///     Cov(g, f) = sum_{n=1..N} (w_n - w_{n-1}) S_n(g) S_n(f),   S_n = sum_{j>=n} c_j,   w_n = 1 / P(K >= n).
/// The terms are c_n h^n: the step is part of them. At least max_degree() + 1 terms.
double variance(const TruncationLaw& law, std::span<const double> terms);
double covariance(const TruncationLaw& law, std::span<const double> g, std::span<const double> f);

}  // namespace jetlag
