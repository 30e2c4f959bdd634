// SPDX-License-Identifier: MIT
#pragma once
// Truncation laws: the distribution of the random degree K at which a series is stopped.
//
// A law is known by its tail P(K >= n), n = 0 .. N. The series of terms c_n, stopped at K and weighted,
//
//     g = sum_{n=0..K} c_n / P(K >= n),
//
// is unbiased for the whole sum: E g = sum_{n=0..N} c_n, because term n is kept with probability P(K >= n).
// Source: McLeish 2011; Rhee, Glynn 2015 (coupled sum; their other one is in truncation/single_term.hpp).
//
// A law whose probabilities follow the terms as they become known is another type: truncation/sequential.hpp.
//
// Variance. A sum of N terms has a finite one for every law: weights are finite. But where the terms fall as (h /
// rho)^n, rho the radius of convergence, those of the variance, S_n^2 / P(K >= n), go as ((h / rho)^2 P(K >= n-1) / P(K
// >= n))^n: for a geometric law they fall only if
//
//     h / rho < sqrt(1 - p).
//
// Beyond, the variance is that of the last term, grows without bound with N, and is infinite for N = infinity; a law
// whose tail falls ever faster (Poisson) gets there for every h where the radius of convergence is finite: see
// largest_ratio().

#include <span>
#include <string>
#include <vector>

namespace jetlag {

/// Which weights make the stopped sum unbiased.
enum class Weighting {
  coupled_sum,  // every term up to K:   w_n = 1 / P(K >= n)
  single_term,  // the sum up to min_degree, and of what is beyond term K alone:   w_K = 1 / P(K = K)
};

class TruncationLaw {
 public:
  /// tail[n] = P(K >= n) for n = 0 .. N: starts at 1, does not rise, stays > 0 with finite weights; with single_term
  /// no degree above min_degree may have probability 0.
  /// Throws std::invalid_argument.
  TruncationLaw(std::string name, std::vector<double> tail, Weighting weighting = Weighting::coupled_sum);

  const std::string& name() const { return name_; }
  Weighting weighting() const { return weighting_; }

  /// P(K >= n); 0 beyond the largest degree.
  double at_least(int n) const { return n < static_cast<int>(tail_.size()) ? tail_[n] : 0.0; }

  /// P(K = n).
  double exactly(int n) const { return at_least(n) - at_least(n + 1); }

  /// Weight of term n in a coupled sum: 1 / P(K >= n), n <= max_degree().
  double weight(int n) const { return 1.0 / tail_[n]; }

  /// Weight of term n in the sum that is stopped at `degree`, n <= degree <= max_degree().
  double weight(int n, int degree) const;

  int min_degree() const { return min_; }                                // K >= min_degree surely
  int max_degree() const { return static_cast<int>(tail_.size()) - 1; }  // K <= max_degree surely
  bool is_fixed() const { return min_degree() == max_degree(); }

  /// E K = sum_{n>=1} P(K >= n).
  double mean() const;

  /// The ratio h / rho of step and radius of convergence below which the terms of the variance fall from each to the
  /// next: the smallest sqrt(P(K >= n) / P(K >= n-1)). sqrt(1-p) for a geometric law; 1 for a fixed degree.
  double largest_ratio() const;

  /// K by inversion: the largest n with u <= P(K >= n), for u uniform on (0, 1].
  int draw(double u) const;

 private:
  std::string name_;
  std::vector<double> tail_;
  Weighting weighting_;
  int min_;
};

/// K = degree. degree >= 1.
TruncationLaw fixed_degree(int degree);

/// K = min(N, m + G), P(G = i) = p (1-p)^i:  P(K >= n) = (1-p)^(n-m) for m < n <= N.         Source: the paper,
/// corrected. 1 <= m = min_degree <= N = max_degree; 0 < p < 1 (p = 0 or m = N: K = N; p = 1 is refused unless m = N:
/// the terms above m would never be drawn).   Throws std::invalid_argument.
TruncationLaw geometric(int min_degree, int max_degree, double p);

/// The expected cost of a sum, sum_{n=1..N} t_n P(K >= n), where order n costs t_n more than order n-1 did.
/// increments: t_0 (not read) .. t_N. Throws std::invalid_argument for fewer.
double expected_cost(const TruncationLaw& law, std::span<const double> increments);

/// Increments t_0 .. t_N of a cost that counts orders (t_n = 1: the expected cost is E K), and of one that counts the
/// products of the recurrences (t_n = n: the expected cost is E K (K+1) / 2).
std::vector<double> linear_cost(int degree);
std::vector<double> quadratic_cost(int degree);

// ---- what randomness adds to second moments ---------------------------------------------------------------
//
// For any quadratic form Q, g the random sum, T its mean and S_n = sum_{j=n..N} c_j, in O(N) and from the terms alone:
//
//     E Q(g) = Q(T) + sum_{n=m+1..N} (w_n - w_{n-1}) Q(S_n)             coupled sum,  w_n = 1 / P(K >= n),
//     E Q(g) = Q(T) + sum_{n=m+1..N} Q(c_n) / P(K = n) - Q(S_{m+1})     single term.
//
// With Q(x) = x^2 that is the variance; with the energy of a state, the energy that randomness adds in a step.
// The second is E c_K^2 / P(K)^2 - S_{m+1}^2, the variance of the estimate of S_{m+1}.

/// E Q(g) - Q(T), see above.
/// term(n): c_n, a number or a vector of Eigen, n = m+1 .. N; zero: the zero of their kind and shape; form(x): Q(x).
template <class X, class Term, class Form>
double random_part(const TruncationLaw& law, const X& zero, const Term& term, const Form& form) {
  X tail = zero;
  double sum = 0;
  const bool coupled = law.weighting() == Weighting::coupled_sum;
  for (int n = law.max_degree(); n > law.min_degree(); --n) {
    const X c = term(n);
    tail += c;
    sum += coupled ? (law.weight(n) - law.weight(n - 1)) * form(tail) : form(c) / law.exactly(n);
  }
  return coupled ? sum : sum - form(tail);
}

/// Var g and Cov(g, f) for the terms of one or two series stopped by the same draw. The terms are c_n h^n: the step is
/// part of them. At least max_degree() + 1 terms; throws std::invalid_argument for fewer.
double variance(const TruncationLaw& law, std::span<const double> terms);
double covariance(const TruncationLaw& law, std::span<const double> g, std::span<const double> f);

}  // namespace jetlag
