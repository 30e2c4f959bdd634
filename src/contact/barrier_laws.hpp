// SPDX-License-Identifier: MIT
#pragma once
// Which law of a barrier a region has, and of which particles.

#include <array>
#include <compare>
#include <vector>

#include "contact/region.hpp"
#include "jetlag/contact/stencil.hpp"
#include "jetlag/forces/force.hpp"

namespace jetlag {

/// In the order in which a system has them; from `first_nearly_parallel` on those of two edges that are nearly parallel.
std::vector<RecordedLaw> barrier_laws(int dimension);
constexpr int first_nearly_parallel = 4;

/// An element, the same for all pairs in whose region it is. Members beyond the last are -1.
struct BarrierElement {
  int law;
  std::array<int, 4> members;
  Stencil edges() const { return {StencilKind::edge_edge, members}; }
  friend auto operator<=>(const BarrierElement&, const BarrierElement&) = default;
};
BarrierElement barrier_element(const Stencil& stencil, Support support, bool nearly_parallel);

}  // namespace jetlag
