// SPDX-License-Identifier: MIT
#pragma once
// Fusion: what a law says in several operations, computed in one.
//
//   x_1 - x_0                      a separation, an input of its own: the difference is taken where rows are gathered
//   u u + v v + w w                one squared norm     (Eigen's squaredNorm and dot record chains of sums)
//   u a + v b + w c                one dot product
//   u a - v b                      one difference of products
//   a + b + c + d                  one sum
//   v + c u - d w                  one linear combination, where c and d are numbers of the law or of an element
//
// Values that something else reads as well are left as they are.

#include "jetlag/tape/tape.hpp"

namespace jetlag {

/// The same outputs from fewer operations. Sums are added in another order: results agree to rounding.
Tape fused(const Tape& tape);

/// The same with differences of the positions of two participants as inputs: elements know how to take them.
Tape with_separations(const Tape& tape);

}  // namespace jetlag
