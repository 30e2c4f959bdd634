// SPDX-License-Identifier: MIT
#pragma once
// A number as text, for messages.

#include <sstream>
#include <string>

namespace jetlag {

namespace detail {
template <class T>
std::string shown(const T& x) {
  std::ostringstream text;
  if constexpr (requires { text << x; })
    text << x;
  else
    text << "another number";
  return text.str();
}
}  // namespace detail

}  // namespace jetlag
