// SPDX-License-Identifier: MIT
#pragma once
// The register of rules as a list of types for tests that every rule inherits.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

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

}  // namespace jetlag::testing
