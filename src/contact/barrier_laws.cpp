// SPDX-License-Identifier: MIT
#include "contact/barrier_laws.hpp"

#include <algorithm>
#include <utility>

#include "jetlag/forces/contact/nearly_parallel.hpp"

namespace jetlag {

std::vector<RecordedLaw> barrier_laws(int dimension) {
  std::vector<RecordedLaw> laws{record_law<BarrierVertexVertex>(dimension)};
  if (dimension >= 2) laws.push_back(record_law<BarrierVertexEdge>(dimension));
  if (dimension >= 3) {
    laws.push_back(record_law<BarrierVertexFace>(dimension));
    laws.push_back(record_law<BarrierEdgeEdge>(dimension));
    laws.push_back(record_law<BarrierMollifiedVertexVertex>(dimension));
    laws.push_back(record_law<BarrierMollifiedVertexEdge>(dimension));
    laws.push_back(record_law<BarrierMollifiedEdgeEdge>(dimension));
  }
  return laws;
}

/// Features in one order, so that pairs that share a region share its element.
BarrierElement barrier_element(const Stencil& stencil, Support support, bool nearly_parallel) {
  const Sides sides = sides_of(stencil.kind, support);
  const auto& v = stencil.vertices;
  if (nearly_parallel) {  // those that carry the distance come first on their side, and a single one before two
    std::array<int, 2> a{v[0], v[1]}, b{v[2], v[3]};
    if (sides.count_a == 1 && sides.a[0] == 1) std::swap(a[0], a[1]);
    if (sides.count_b == 1 && sides.b[0] == 3) std::swap(b[0], b[1]);
    if (sides.count_a == 2 && sides.count_b == 1) std::swap(a, b);
    return {first_nearly_parallel + sides.count_a + sides.count_b - 2, {a[0], a[1], b[0], b[1]}};
  }
  std::vector<int> a, b;
  for (int i = 0; i < sides.count_a; ++i) a.push_back(v[sides.a[i]]);
  for (int i = 0; i < sides.count_b; ++i) b.push_back(v[sides.b[i]]);
  std::ranges::sort(a);
  std::ranges::sort(b);
  if (a.size() > b.size() || (a.size() == b.size() && b < a)) std::swap(a, b);
  BarrierElement element{0, {-1, -1, -1, -1}};
  std::ranges::copy(b, std::ranges::copy(a, element.members.begin()).out);
  element.law = a.size() == 2 ? 3 : static_cast<int>(b.size()) - 1;
  return element;
}

}  // namespace jetlag
