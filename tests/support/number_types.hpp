// SPDX-License-Identifier: MIT
#pragma once
// The number types that every function serves, for typed tests.

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

#include "support/digits50.hpp"

namespace jetlag::testing {

using NumberTypes = ::testing::Types<float, double, long double, Digits50>;

struct NameOfNumberType {
  template <class T>
  static std::string GetName(int) {
    return std::is_same_v<T, float>         ? "float"
           : std::is_same_v<T, double>      ? "double"
           : std::is_same_v<T, long double> ? "long_double"
                                            : "digits50";
  }
};

}  // namespace jetlag::testing
