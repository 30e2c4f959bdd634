// SPDX-License-Identifier: MIT
#pragma once
// The single-term estimator: of all terms beyond min_degree, one, at random.
//
//     g = sum_{n<=m} c_n + c_K / P(K = K)   where K > m,      g = sum_{n<=m} c_n   where K = m.
//
// E g = sum_{n<=N} c_n, since term n is taken with probability P(K = n).         Source: Rhee, Glynn 2015 (Z = c_K /
// P(K)). Its variance, sum_{n>m} c_n^2 / P(K = n) - S_{m+1}^2, is larger than that of the coupled sum where the terms
// fall fast, and the recurrences compute all orders below K anyway: it is here to be compared with.

#include "jetlag/truncation/truncation.hpp"

namespace jetlag {

/// The same degrees as `law`, drawn for one term each. Every degree above min_degree must have a probability; throws
/// std::invalid_argument.
TruncationLaw single_term(const TruncationLaw& law);

}  // namespace jetlag
