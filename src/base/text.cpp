// SPDX-License-Identifier: MIT
#include "jetlag/base/text.hpp"

#include <cmath>

namespace jetlag {

std::string number(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string field(double value) { return std::isfinite(value) ? number(value) : ""; }

}  // namespace jetlag
