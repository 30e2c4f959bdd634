// SPDX-License-Identifier: MIT
#pragma once
// Poisson truncation: for series of entire functions, whose terms fall as x^n / n!.

#include "jetlag/truncation/truncation.hpp"

namespace jetlag {

/// K = min(N, m + G), P(G = i) = e^-mu mu^i / i!.   Mean of K: m + mu, less what is cut at N.
/// 1 <= m = min_degree <= N = max_degree; mu = mean > 0, finite, and so large that the last weight does not overflow.
/// The ratio of P(K >= n) to the one before falls as mu / (n - m): where the radius of convergence is finite, take a
/// small N or a geometric law, or the last term rules the variance.   Throws std::invalid_argument.
TruncationLaw poisson(int min_degree, int max_degree, double mean);

}  // namespace jetlag
