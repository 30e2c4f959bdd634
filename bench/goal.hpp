// SPDX-License-Identifier: MIT
#pragma once
// A goal set for a measured number.

#include <string>

namespace jetlag::bench {

struct Goal {
  enum class Kind { at_least, at_most, none } kind;
  double value = 0.0;

  std::string text() const {
    if (kind == Kind::none) return "";
    std::string number = std::to_string(value);
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
    return (kind == Kind::at_least ? ">= " : "<= ") + number;
  }
  const char* verdict(double x) const {
    if (kind == Kind::none) return "";
    return (kind == Kind::at_least ? x >= value : x <= value) ? "met" : "missed";
  }
};

}  // namespace jetlag::bench
