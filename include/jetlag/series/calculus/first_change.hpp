// SPDX-License-Identifier: MIT
#pragma once
// Where a condition changes: a series whose sign has decided something at s = 0.

#include <optional>
#include <span>

namespace jetlag {

/// h, or a shorter length on which the last two terms of c are below rounding, or what degree N leaves out of a series whose
/// terms fall by e^2: farther off the polynomial is not the condition. Where c_0 is not finite it decides nothing, nor does a root
/// of zero without a series, which makes what depends on it not finite: h. Of degree 2 the last term counts alone.
template <class T>
T reach_of_condition(std::span<const T> c, T h);

/// The first s in (0, h] at which c(s) = sum_k c_k s^k has left the side of zero that it was taken to be on, by more than
/// its rounding: beyond it whoever computes c anew finds it on the other side. Nothing where it stays, or touches zero.
/// at_zero: the side that was taken where c_0 = 0; 0: the one to which c goes.
/// Coefficients from the first one on that is not finite, or whose term at h is above 1e250, are left out. Throws std::invalid_argument unless h > 0 and finite.
template <class T>
std::optional<T> first_change(std::span<const T> c, int at_zero, const T& h);

/// The first change among several conditions, one after another: where that of c comes before `most`, it becomes `most` and
/// `first`; where c does not reach so far, `most` becomes shorter and `first` nothing.
template <class T>
void find_first_change(std::span<const T> c, int at_zero, T& most, std::optional<T>& first);

/// As above for a root c of f: where f crosses zero, the series of c does not reach so far, and f tells.
template <class T>
void find_first_change_of_root(std::span<const T> f, std::span<const T> c, int at_zero, T& most,
                               std::optional<T>& first);

extern template std::optional<double> first_change(std::span<const double>, int, const double&);

}  // namespace jetlag

#include "jetlag/series/calculus/first_change_definitions.hpp"
