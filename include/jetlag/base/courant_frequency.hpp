// SPDX-License-Identifier: MIT
#pragma once
// What a Courant limit in use stands on.

#include <cstdint>

namespace jetlag {

struct CourantFrequency {
  double bound = 0;  // of the frequencies of the scene [rad/s]; that of a state is the last one taken
  std::uint64_t refreshed = 0;  // how often it was taken anew
};

}  // namespace jetlag
