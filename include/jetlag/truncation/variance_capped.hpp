// SPDX-License-Identifier: MIT
#pragma once
// The cheapest law whose variance does not exceed a given one.

#include <span>

#include "jetlag/truncation/truncation.hpp"

namespace jetlag {

/// The tail P_n of least expected cost sum_{n=1..N} t_n P_n with Var g <= max_variance, for the terms c_0 .. c_N:
///
///     P_n = min(1, lambda sqrt(nu_n / t_n)),   nu_n = S_n^2 - S_{n+1}^2,
///
/// where that falls; where it would rise, neighbours are pooled, sqrt(sum nu / sum t), which are the slopes of the
/// upper hull of sum nu over sum t. lambda by bisection. It chooses min_degree itself. Orders that follow the last term
/// other than 0 are never drawn.
/// max_variance > 0; increments: t_0 (not read) .. t_N, > 0, all 1 where none are given.
/// Source: the hull is that of Kahale 2019, the pooling that of Ayer et al. 1955.
/// Throws std::invalid_argument.
TruncationLaw variance_capped(std::span<const double> terms, double max_variance,
                              std::span<const double> increments = {});

}  // namespace jetlag
