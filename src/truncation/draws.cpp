// SPDX-License-Identifier: MIT
#include "jetlag/truncation/draws.hpp"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace jetlag {

namespace {

/// Two independent uniform numbers on (0, 1] for a key and a stream.
std::pair<double, double> two_uniforms(std::uint64_t seed, std::uint32_t particle, std::uint64_t update,
                                       std::uint32_t stream) {
  using Philox = r123::Philox4x32;
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  const Philox::ctr_type counter{{low(update), high(update), particle, stream}};
  const Philox::key_type key{{low(seed), high(seed)}};
  const auto bits = Philox()(counter, key);
  const auto to_unit = [](std::uint64_t a, std::uint64_t b) {
    return static_cast<double>((((a << 32) | b) >> 11) + 1) * 0x1p-53;
  };
  return {to_unit(bits[0], bits[1]), to_unit(bits[2], bits[3])};
}

}  // namespace

double uniform(std::uint64_t seed, std::uint32_t particle, std::uint64_t update) {
  return two_uniforms(seed, particle, update, 0).first;
}

double standard_normal(std::uint64_t seed, std::uint32_t particle, std::uint64_t update) {
  const auto [u, v] = two_uniforms(seed, particle, update, 1);
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

}  // namespace jetlag
