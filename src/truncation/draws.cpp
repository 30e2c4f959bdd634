// SPDX-License-Identifier: MIT
#include "jetlag/truncation/draws.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "jetlag/base/text.hpp"
#include "truncation/philox.hpp"

namespace jetlag {

double uniform(std::uint64_t seed, std::uint32_t particle, std::uint64_t update) {
  return to_unit(random_bits(seed, particle, update, Stream::uniform)[0]);
}

double standard_normal(std::uint64_t seed, std::uint32_t particle, std::uint64_t update) {
  const auto bits = random_bits(seed, particle, update, Stream::normal);
  return std::sqrt(-2.0 * std::log(to_unit(bits[0]))) * std::cos(2.0 * std::numbers::pi * to_unit(bits[1]));
}

double rotation(std::uint64_t seed, std::uint32_t particle, std::uint64_t update) {
  constexpr std::uint64_t phi = 0x9e3779b97f4a7c15;  // 2^64 (sqrt 5 - 1) / 2
  return to_unit(random_bits(seed, particle, 0, Stream::offset)[0] + update * phi);
}

double antithetic(std::uint64_t seed, std::uint32_t particle, std::uint64_t update) {
  const std::uint64_t bits = random_bits(seed, particle, update / 2, Stream::uniform)[0];
  return to_unit(update % 2 == 0 ? bits : ~bits);
}

Draws::Draws(Draw kind, const TruncationLaw* law, std::uint64_t seed, std::uint32_t particles)
    : kind_(kind), seed_(seed), particles_(particles) {
  if (law != nullptr && law->is_fixed()) return;
  if (kind == Draw::stratified && particles < 2)
    throw std::invalid_argument(
        "stratified: strata are over particles, and one draw is all there is; let each particle draw, or "
        "take "
        "other draws");
  if (kind != Draw::ruler && kind != Draw::scrambled_ruler) {
    if (law != nullptr &&
        law->at_least(law->max_degree()) < 0.99 * least_probability)  // which products of it may miss
      throw std::invalid_argument(law->name() + ": degree " + std::to_string(law->max_degree()) +
                                  " has a probability below " + shown(least_probability * 1e18) +
                                  "e-18 and would never be drawn; take a smaller max_degree");
    return;
  }
  if (law == nullptr)
    throw std::invalid_argument(
        "ruler: the probabilities of a sequential law are not known beforehand; take other draws");
  ruler_.emplace(*law, kind == Draw::scrambled_ruler);
}

double Draws::number(std::uint32_t particle, std::uint64_t update) const {
  switch (kind_) {
    case Draw::rotation: return rotation(seed_, particle, update);
    case Draw::stratified: return stratified(seed_, particle, update, particles_);
    case Draw::antithetic: return antithetic(seed_, particle, update);
    default: return uniform(seed_, particle, update);
  }
}

}  // namespace jetlag
