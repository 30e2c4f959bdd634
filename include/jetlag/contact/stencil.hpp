// SPDX-License-Identifier: MIT
#pragma once
// A stencil: two features of a surface between which a distance is kept.

#include <array>
#include <compare>
#include <span>
#include <string>

#include "jetlag/contact/closest.hpp"

namespace jetlag {

/// The particles in the order of its kind; beyond its vertices -1.
struct Stencil {
  StencilKind kind;
  std::array<int, 4> vertices{-1, -1, -1, -1};

  std::span<const int> particles() const {
    return {vertices.data(), static_cast<std::size_t>(vertices_of(kind))};
  }
  friend auto operator<=>(const Stencil&, const Stencil&) = default;
};

/// "vertex 12 and triangle (3, 9, 17)"
std::string names_of(const Stencil& stencil);

}  // namespace jetlag
