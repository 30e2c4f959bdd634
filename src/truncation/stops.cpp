// SPDX-License-Identifier: MIT
#include "jetlag/truncation/stops.hpp"

#include <utility>

namespace jetlag {

namespace {

std::optional<SequentialLaw> sequential_part(const Truncation& law) {
  const auto* sequential = std::get_if<SequentialLaw>(&law);
  return sequential != nullptr ? std::optional(*sequential) : std::nullopt;
}

}  // namespace

Stops::Stops(const Truncation& law, Draw draws, std::uint64_t seed) : Stops(law, draws, seed, true, {}) {}

Stops::Stops(const Truncation& law, Draw draws, std::uint64_t seed, const std::vector<bool>& fixed)
    : Stops(law, draws, seed, known_beforehand(law).is_fixed(), fixed) {}

Stops::Stops(const Truncation& law, Draw draws, std::uint64_t seed, bool shared, std::vector<bool> fixed)
    : law_(known_beforehand(law)),
      sequential_(sequential_part(law)),
      shared_(shared),
      fixed_(std::move(fixed)),
      draws_(draws, sequential_ ? nullptr : &law_, seed,
             shared_ ? 1 : static_cast<std::uint32_t>(fixed_.size())),
      weights_differ_(sequential_ || law_.weighting() == Weighting::single_term),
      degree_(shared_ ? 1 : fixed_.size(), law_.max_degree()),
      weights_(terms() * (weights_differ_ ? degree_.size() : 1), 0.0) {
  if (!weights_differ_)
    for (int n = 0; n <= law_.max_degree(); ++n) weights_[n] = law_.weight(n);
  if (law_.is_fixed()) weights_.back() = 1.0;
}

void Stops::draw(std::uint64_t update) {
  if (law_.is_fixed() && !weights_differ_) return;  // the degree is that of the beginning
  for (std::size_t i = 0; i < draws(); ++i) {
    degree_[i] = is_drawn(i) ? drawn(key(i), update) : law_.min_degree();
    if (weights_differ_)
      for (int n = 0; n <= degree_[i]; ++n) weights_of(i)[n] = law_.weight(n, degree_[i]);
  }
}

}  // namespace jetlag
