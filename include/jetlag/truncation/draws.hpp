// SPDX-License-Identifier: MIT
#pragma once
// Draws: the uniform numbers by which truncation laws are drawn, u on (0, 1] for a particle's update.
//
// Invariants, tested for every member of the family:
//   - a draw depends on (seed, particle, update) alone: the same key, the same number, whatever the order of execution;
//   - over seeds, every single draw is uniform on the 2^64 multiples of 2^-64 (rounded to doubles), so every update is
//     unbiased, to a relative 2^-64 / P(K >= n) of term n: laws with P(K >= n) < least_probability are refused.
// They differ in how the draws of different updates or particles go together. Equidistributed ones make the debts and
// gifts of successive updates, w_n - 1 for term n, cancel: what a fixed degree loses every step, and independent draws
// let walk, stays bounded. But a regular draw may resonate with the motion: see ruler().

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "jetlag/truncation/truncation.hpp"

namespace jetlag {

/// The key of a draw that all particles of an update share.
inline constexpr std::uint32_t shared_by_all = 0xffffffffu;

/// The smallest P(K >= n) that is drawn from uniform numbers: its error is then below 1 %. Rulers know no such limit.
inline constexpr double least_probability = 0x1p-57;

/// A uniform number on (0, 1]: a multiple of 2^-64, rounded. Source: Philox4x32-10, Salmon et al. 2011 (Random123).
double uniform(std::uint64_t seed, std::uint32_t particle, std::uint64_t update);

/// A normal number of mean 0 and variance 1, of another stream than `uniform`. Source: Box, Muller 1958.
double standard_normal(std::uint64_t seed, std::uint32_t particle, std::uint64_t update);

/// Rotation: u_n = frac(u_0 + n phi), phi = (sqrt 5 - 1) / 2, one random u_0 a particle.
/// In whole numbers modulo 2^64: phi is off by less than 2^-64 and nothing drifts.
/// Geometric laws with 1-p = phi^2 or phi^4 have bounded sums of w_n - 1.   Source: Kesten 1966 (bounded remainder).
double rotation(std::uint64_t seed, std::uint32_t particle, std::uint64_t update);

/// Antithetic pairs: updates 2n and 2n+1 use u and its mirror image in (0, 1], 1 - u + 2^-64.
double antithetic(std::uint64_t seed, std::uint32_t particle, std::uint64_t update);

/// Stratified over particles: within an update each of the `particles` draws from another of as many equal intervals,
/// u_i = (s_i + v_i) / particles, s a random permutation, v_i uniform. particle < particles.
double stratified(std::uint64_t seed, std::uint32_t particle, std::uint64_t update, std::uint32_t particles);

/// Ruler: van der Corput's sequence in the base of the law, by its digits. With P(K >= n-1) / P(K >= n) = b_n, whole
/// numbers for all n > m, K = m + the number of trailing zeros of (update - offset), a number with digits of base
/// b_{m+1}, b_{m+2} .., one random offset a particle. So every b_{m+1}-th update reaches m+1, of these every b_{m+2}-th
/// m+2, and so on.
///
/// Each term is an impulse applied b^i times stronger every b^i updates, and as those of subcycling, impulses resonate
/// with motions whose period is a whole number, or nearly, of b^i updates: then errors grow as those of a fixed degree
/// do. `scrambled` does not: in each block of b_{m+1} updates, the one that goes on stands at a random place, and so in
/// each block of such blocks. Counts over whole blocks stay exact, but errors walk at random again: of the planet of
/// `study ruler`, at 120 steps a period, base 2: 2.3e-6 after 1000 periods, independent draws 8e-6, the resonating
/// ruler 2.6e-7. A base that does not divide the steps of a period is the better remedy (3: 1.9e-8).
/// Source: van der Corput 1935; Owen 1995 (nested scrambling).
class Ruler {
 public:
  /// Throws std::invalid_argument for a law whose tail does not fall by whole numbers, naming the first probability at
  /// fault.
  explicit Ruler(const TruncationLaw& law, bool scrambled = false);

  /// K, exactly distributed as the law for a random seed.
  int degree(std::uint64_t seed, std::uint32_t particle, std::uint64_t update) const;

 private:
  int min_;
  std::vector<std::uint64_t> bases_;  // b_{m+1} .. b_N
  bool scrambled_;
};

enum class Draw { independent, rotation, ruler, scrambled_ruler, stratified, antithetic };

/// Their names, in the order of the enumeration.
inline const std::vector<std::string> names_of_draws = {"independent",     "rotation",   "ruler",
                                                        "scrambled_ruler", "stratified", "antithetic"};

/// A kind of draw for the particles of a system.
class Draws {
 public:
  /// law: what is drawn from; of a fixed degree nothing is drawn, and any kind will do. particles: how many draw; stratified
  /// draws need two at least.
  /// Throws std::invalid_argument: see Ruler; a ruler for a law that is not known beforehand; strata of one.
  Draws(Draw kind, const TruncationLaw* law, std::uint64_t seed, std::uint32_t particles);

  /// Goes on with the draws of another seed.
  void reseed(std::uint64_t seed) { seed_ = seed; }

  /// u on (0, 1]. Not for rulers.
  double number(std::uint32_t particle, std::uint64_t update) const;

  /// The degree at which this update stops, drawn from the law.
  int degree(const TruncationLaw& law, std::uint32_t particle, std::uint64_t update) const {
    if (law.is_fixed()) return law.max_degree();
    return ruler_ ? ruler_->degree(seed_, particle, update) : law.draw(number(particle, update));
  }

 private:
  Draw kind_;
  std::uint64_t seed_;
  std::uint32_t particles_;
  std::optional<Ruler> ruler_;
};

}  // namespace jetlag
