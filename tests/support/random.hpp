// SPDX-License-Identifier: MIT
#pragma once
// Random numbers for tests: the same on every machine, from a seed that the test names.

#include <cstdint>
#include <random>

namespace jetlag::testing {

class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : bits_(seed) {}
  /// Uniform in [low, high); std::uniform_real_distribution may differ between libraries.
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace jetlag::testing
