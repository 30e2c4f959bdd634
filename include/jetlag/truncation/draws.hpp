// SPDX-License-Identifier: MIT
#pragma once
// Random numbers keyed by (seed, particle, update): the same key, the same number, whatever the order of execution.

#include <cstdint>

namespace jetlag {

/// The key of a draw that all particles of an update share.
inline constexpr std::uint32_t shared_by_all = 0xffffffffu;

/// A uniform number on (0, 1], 53 bits. Source: Philox4x32-10, Salmon et al. 2011 (Random123).
double uniform(std::uint64_t seed, std::uint32_t particle, std::uint64_t update);

/// A normal number of mean 0 and variance 1, of another stream than `uniform`. Source: Box, Muller 1958.
double standard_normal(std::uint64_t seed, std::uint32_t particle, std::uint64_t update);

}  // namespace jetlag
