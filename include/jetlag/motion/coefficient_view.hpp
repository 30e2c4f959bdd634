// SPDX-License-Identifier: MIT
#pragma once
// For those who look at the series of a motion and do not grow it: no more than the name of it.

#include "jetlag/model/system.hpp"

namespace jetlag {

template <class T = double>
class Expansion;  // motion/expansion.hpp

/// Coefficient k of all positions or velocities. Shape (particles, dimension).
template <class T>
using CoefficientView = Eigen::Map<const Coordinates<T>, Eigen::Unaligned, Eigen::OuterStride<>>;

}  // namespace jetlag
