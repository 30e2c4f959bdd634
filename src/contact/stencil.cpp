// SPDX-License-Identifier: MIT
#include "jetlag/contact/stencil.hpp"

namespace jetlag {

std::string names_of(const Stencil& stencil) {
  const auto list = [&](int first, int end) {
    std::string text;
    for (int i = first; i < end; ++i) text += (i > first ? ", " : "") + std::to_string(stencil.vertices[i]);
    return text;
  };
  const auto feature = [&](int first, int end) {
    static constexpr const char* what[] = {"vertex ", "edge (", "triangle ("};
    return what[end - first - 1] + list(first, end) + (end - first > 1 ? ")" : "");
  };
  const int side = first_side(stencil.kind), end = vertices_of(stencil.kind);
  return feature(0, side) + " and " + feature(side, end);
}

}  // namespace jetlag
