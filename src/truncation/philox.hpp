// SPDX-License-Identifier: MIT
#pragma once
// Random bits by key.         Source: Philox4x32-10, Salmon et al. 2011 (Random123).

#include <Random123/philox.h>

#include <array>
#include <cstdint>

namespace jetlag {

/// The streams: keys of different streams have nothing to do with each other.
enum class Stream : std::uint32_t { uniform, normal, offset, shift, digit, place };

/// Two independent whole numbers of 64 bits. `stream` may carry a number of its own beyond the low 8 bits.
inline std::array<std::uint64_t, 2> random_bits(std::uint64_t seed, std::uint32_t particle,
                                                std::uint64_t update, Stream stream,
                                                std::uint32_t number = 0) {
  using Philox = r123::Philox4x32;
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  const std::uint32_t fourth = static_cast<std::uint32_t>(stream) | (number << 8);
  const auto bits = Philox()({{low(update), high(update), particle, fourth}}, {{low(seed), high(seed)}});
  return {(static_cast<std::uint64_t>(bits[0]) << 32) | bits[1],
          (static_cast<std::uint64_t>(bits[2]) << 32) | bits[3]};
}

/// From 64 bits to (0, 1]: a multiple of 2^-64, rounded to a double, so that small numbers have all their digits.
inline double to_unit(std::uint64_t bits) { return (static_cast<double>(bits) + 1.0) * 0x1p-64; }

/// From 64 bits to 0 .. n-1, each with a probability of 1/n to 2^-64.         Source: Lemire 2019, without rejection.
inline std::uint64_t below(std::uint64_t n, std::uint64_t bits) {
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::uint64_t>((static_cast<Wide>(bits) * n) >> 64);
}

}  // namespace jetlag
