// SPDX-License-Identifier: MIT
#pragma once
// Laws without their forces: what is left to the derivative of the energy, to compare with what was written by hand.

#include <algorithm>
#include <array>
#include <string_view>

#include "jetlag/forces/force.hpp"

namespace jetlag::problems {

/// The law L with its energy alone, and what bounds it; its forces are hidden.
template <ForceLaw L>
struct FromEnergy : L {
  static void force() = delete;
  static void forces() = delete;

  static constexpr auto text = [] {
    constexpr std::string_view name = L::name, end = "_from_energy";
    std::array<char, name.size() + end.size() + 1> all{};
    std::ranges::copy(end, std::ranges::copy(name, all.begin()).out);
    return all;
  }();
  static constexpr const char* name = text.data();
};

}  // namespace jetlag::problems
