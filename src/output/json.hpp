// SPDX-License-Identifier: MIT
#pragma once
// JSON of values that are known beforehand: members in their order, numbers with all their digits.

#include <concepts>
#include <string>
#include <utility>
#include <vector>

namespace jetlag::json {

/// A number as JSON: with a point or an exponent, so that "-0" keeps its sign; null where it is not finite.
std::string value(double x);

template <std::integral I>
std::string value(I i) {
  return std::to_string(i);
}

/// A quoted string; what is not UTF-8 in it is replaced.
std::string value(const std::string& text);
inline std::string value(const char* text) { return value(std::string(text)); }

/// Names and values, which are JSON already.
using Members = std::vector<std::pair<std::string, std::string>>;

/// On one line; or, given the spaces before its closing brace, each member on a line with two spaces more.
std::string object(const Members& members);
std::string object(const Members& members, int indent);

/// The same of items, which are JSON already.
std::string list(const std::vector<std::string>& items);
std::string list(const std::vector<std::string>& items, int indent);

/// A list on one line of what can be iterated over.
template <class Values>
std::string list_of(const Values& values) {
  std::vector<std::string> items;
  for (const auto& x : values) items.push_back(value(x));
  return list(items);
}

}  // namespace jetlag::json
