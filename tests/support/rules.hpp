// SPDX-License-Identifier: MIT
#pragma once
// The register of rules as a list of types for tests that every rule inherits.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <type_traits>

#include "jetlag/series/functions.hpp"

namespace jetlag::testing {

template <class List>
struct AsTestTypes;
template <Rule... R>
struct AsTestTypes<RuleList<R...>> {
  using type = ::testing::Types<R...>;
};
using AllRules = AsTestTypes<Rules>::type;

struct NameOfRule {
  template <class R>
  static std::string GetName(int) {
    std::string name = R::name;
    std::ranges::replace(name, ' ', '_');
    return name;
  }
};

/// Where coefficient 0 of the operands is drawn from: within the range of the rule.
struct Interval {
  double low, high;
};
template <class R>
constexpr Interval domain() {
  if (std::is_same_v<R, Asin> || std::is_same_v<R, Acos> || std::is_same_v<R, Atanh>) return {0.125, 0.875};
  if (std::is_same_v<R, Acosh>) return {1.125, 2.0};
  if (std::is_same_v<R, FirstStretchInvariant> || std::is_same_v<R, SecondStretchInvariant>)
    return {20.0, 21.0};  // there is a root below sqrt(3 I): I^2 > II + 2 J sqrt(3 I)
  if (std::is_same_v<R, Sign> || std::is_same_v<R, Abs> || std::is_same_v<R, BySign>) return {-1.0, 1.0};
  return {0.5, 2.0};
}

}  // namespace jetlag::testing
