// SPDX-License-Identifier: MIT
#include "jetlag/truncation/draws.hpp"
#include "truncation/philox.hpp"

namespace jetlag {

namespace {

/// A permutation of 0 .. n-1 by key: four rounds on two halves of the smallest 4^j >= n, repeated until the result is
/// below n. Source: Luby, Rackoff 1988 (the rounds); Black, Rogaway 2002 (cycle walking).
std::uint32_t permuted(std::uint32_t x, std::uint32_t n, std::uint64_t seed, std::uint64_t update) {
  int half = 1;
  while ((std::uint64_t{1} << (2 * half)) < n) ++half;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  std::uint64_t value = x;
  do {
    std::uint64_t left = value >> half, right = value & mask;
    for (std::uint32_t round = 0; round < 4; ++round) {
      const std::uint64_t mixed =
          left ^
          (random_bits(seed, static_cast<std::uint32_t>(right), update, Stream::place, round)[0] & mask);
      left = right;
      right = mixed;
    }
    value = (left << half) | right;
  } while (value >= n);
  return static_cast<std::uint32_t>(value);
}

}  // namespace

double stratified(std::uint64_t seed, std::uint32_t particle, std::uint64_t update, std::uint32_t particles) {
  const std::uint64_t shift = below(particles, random_bits(seed, 0, update, Stream::shift)[0]),
                      stratum = (permuted(particle, particles, seed, update) + shift) % particles;
  return (static_cast<double>(stratum) + uniform(seed, particle, update)) / particles;
}

}  // namespace jetlag
