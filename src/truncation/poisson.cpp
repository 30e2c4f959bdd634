// SPDX-License-Identifier: MIT
#include "jetlag/truncation/poisson.hpp"

#include <cmath>
#include <stdexcept>

#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

/// P(G >= i) = sum_{j>=i} e^-mu mu^j / j!, i >= 1: of the smaller side, so that small tails keep their digits.
double poisson_tail(double mean, int i) {
  const auto probability = [&](int j) { return std::exp(j * std::log(mean) - mean - std::lgamma(j + 1.0)); };
  double term = probability(i), sum = 0;
  if (i > mean) {
    for (int j = i; term > 1e-17 * sum; term *= mean / ++j) sum += term;
    return sum;
  }
  for (int j = i - 1; j >= 0; --j) sum += probability(j);
  return 1.0 - sum;
}

}  // namespace

TruncationLaw poisson(int min_degree, int max_degree, double mean) {
  if (min_degree < 1)
    throw std::invalid_argument("poisson: min_degree must be at least 1, got " + std::to_string(min_degree));
  if (max_degree < min_degree)
    throw std::invalid_argument("poisson: max_degree must be at least min_degree = " +
                                std::to_string(min_degree) + ", got " + std::to_string(max_degree));
  if (!(mean > 0.0) || !std::isfinite(mean))
    throw std::invalid_argument("poisson: mean must be > 0 and finite, got " + shown(mean));
  std::vector<double> tail(max_degree + 1, 1.0);
  for (int n = min_degree + 1; n <= max_degree; ++n) tail[n] = poisson_tail(mean, n - min_degree);
  return {"poisson", std::move(tail)};
}

}  // namespace jetlag
