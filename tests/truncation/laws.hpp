// SPDX-License-Identifier: MIT
#pragma once
// The truncation laws that the tests of the family run over: add yours.

#include <cmath>
#include <string>
#include <vector>

#include "jetlag/truncation/poisson.hpp"
#include "jetlag/truncation/sequential.hpp"
#include "jetlag/truncation/single_term.hpp"
#include "jetlag/truncation/truncation.hpp"
#include "jetlag/truncation/variance_capped.hpp"

namespace jetlag::testing {

/// x^n / n!, n = 0 .. N.
inline std::vector<double> exponential_terms(int n, double x = 1.0) {
  std::vector<double> c(n + 1, 1.0);
  for (int k = 1; k <= n; ++k) c[k] = c[k - 1] * x / k;
  return c;
}

inline double sum(const std::vector<double>& terms) {
  double total = 0;
  for (double c : terms) total += c;
  return total;
}

/// p_n = x / n: every weighted term of e^x is 1, and g = K + 1.         Source: Bhanot, Kennedy 1985.
inline SequentialLaw bhanot_kennedy(double x, int max_degree) {
  return {"bhanot_kennedy", 0, max_degree, 1e-6,
          [x](int n, std::span<const double>, double) { return x / n; }};
}

struct LawAndTerms {
  TruncationLaw law;
  std::vector<double> terms;
};

/// Every law, with terms to be summed; a sequential one is the law that it is for them.
inline std::vector<LawAndTerms> laws() {
  const auto e = exponential_terms(16), small = exponential_terms(16, 0.5);
  return {{fixed_degree(5), e},
          {geometric(3, 6, 0.5), e},
          {geometric(4, 16, 0.25), e},
          {poisson(2, 12, 1.5), e},
          {TruncationLaw("tail", {1, 1, 0.9, 0.9, 0.3, 0.2, 0.01}), e},
          {variance_capped(e, 1e-3), e},
          {sequential(2, 16, 0.05).given(e), e},
          {bhanot_kennedy(0.5, 15).given(small), small},
          {single_term(geometric(3, 8, 0.5)), e},
          {single_term(poisson(2, 8, 2.0)), e}};
}

/// The sum that stops at `degree`.
inline double stopped(const TruncationLaw& law, const std::vector<double>& terms, int degree) {
  double g = 0;
  for (int n = 0; n <= degree; ++n) g += law.weight(n, degree) * terms[n];
  return g;
}

/// All of them, by degree.
inline std::vector<double> outcomes(const TruncationLaw& law, const std::vector<double>& terms) {
  std::vector<double> g;
  for (int k = 0; k <= law.max_degree(); ++k) g.push_back(stopped(law, terms, k));
  return g;
}

}  // namespace jetlag::testing
