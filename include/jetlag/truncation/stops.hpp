// SPDX-License-Identifier: MIT
#pragma once
// Stops: at which degree the series of an update end, and with what weights. Whoever stops a series draws here: methods
// with one clock, clocks of particles, first-order systems and lanes of ensembles have the same draws.
//
//   Stops stops(geometric(3, 6, 0.5), Draw::independent, seed);
//   stops.draw(update);
//   sum_{n <= stops.degree()} stops.weights()[n] c_n

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "jetlag/truncation/draws.hpp"
#include "jetlag/truncation/sequential.hpp"
#include "jetlag/truncation/truncation.hpp"

namespace jetlag {

class Stops {
 public:
  /// One draw for all series of an update; particles with clocks of their own ask for `drawn`. Throws std::invalid_argument for draws that do not go with the law, see Draws.
  Stops(const Truncation& law, Draw draws, std::uint64_t seed);
  /// One draw for each particle that is not fixed: shape (particles). A fixed particle ends at the least degree. Where the
  /// degree is fixed nothing is drawn, and all share it.
  Stops(const Truncation& law, Draw draws, std::uint64_t seed, const std::vector<bool>& fixed);

  /// Of a sequential law its lower bound.
  const TruncationLaw& law() const { return law_; }
  /// Whether the degrees are drawn in view of the terms: by `draw_in_view`, not by `draw`.
  bool wait_for_terms() const { return sequential_.has_value(); }
  /// Whether all series have one degree and its weights.
  bool shared() const { return shared_; }
  std::size_t draws() const { return degree_.size(); }

  /// Goes on with the draws of another seed.
  void reseed(std::uint64_t seed) { draws_.reseed(seed); }

  /// The degree that an update of a particle draws from a law known beforehand; particle: shared_by_all for all.
  int drawn(std::uint32_t particle, std::uint64_t update) const {
    return draws_.degree(law_, particle, update);
  }

  /// Degrees and weights of an update, for a law known beforehand.
  void draw(std::uint64_t update);

  /// The same for a sequential law, order by order: each draw goes on to order n while u <= P(K >= n) = p_{m+1} .. p_n.
  /// grow(n): before terms up to n are looked at or summed. size(draw, n): how large term n is, asked for n below the
  /// degree and at it.
  template <class Size, class Grow>
  void draw_in_view(std::uint64_t update, const Size& size, const Grow& grow);

  /// Of the last update.
  int degree(std::size_t draw = 0) const { return degree_[draw]; }
  int largest_degree() const { return *std::ranges::max_element(degree_); }
  /// Weights of the terms 0 .. degree(draw), and of a law of coupled sums those of all terms up to the largest degree.
  /// One entry more is that of the term after them: 1 for a fixed degree, which is no random number, 0 for others.
  const double* weights(std::size_t draw = 0) const {
    return weights_.data() + (weights_differ_ ? draw * terms() : 0);
  }
  std::size_t terms() const { return static_cast<std::size_t>(law_.max_degree()) + 2; }

 private:
  Stops(const Truncation& law, Draw draws, std::uint64_t seed, bool shared, std::vector<bool> fixed);
  std::uint32_t key(std::size_t draw) const {
    return shared_ ? shared_by_all : static_cast<std::uint32_t>(draw);
  }
  bool is_drawn(std::size_t draw) const { return shared_ || !fixed_[draw]; }
  double* weights_of(std::size_t draw) { return weights_.data() + (weights_differ_ ? draw * terms() : 0); }

  TruncationLaw law_;
  std::optional<SequentialLaw> sequential_;
  bool shared_;
  std::vector<bool> fixed_;
  Draws draws_;
  bool weights_differ_;  // from draw to draw; else there is one row for all
  std::vector<int> degree_;
  std::vector<double> weights_;  // [draw][term]
};

template <class Size, class Grow>
void Stops::draw_in_view(std::uint64_t update, const Size& size, const Grow& grow) {
  const int m = sequential_->min_degree();
  grow(m);
  std::vector<std::size_t> going;
  std::vector<double> u(draws()), tail(draws(), 1.0);
  std::vector<std::vector<double>> sizes(draws());
  for (std::size_t i = 0; i < draws(); ++i) {
    degree_[i] = m;
    std::fill_n(weights_of(i), m + 1, 1.0);
    if (!is_drawn(i)) continue;
    going.push_back(i);
    u[i] = draws_.number(key(i), update);
    for (int n = 0; n < m; ++n) sizes[i].push_back(size(i, n));
  }
  for (int n = m + 1; n <= sequential_->max_degree() && !going.empty(); ++n) {
    std::erase_if(going, [&](std::size_t i) {
      sizes[i].push_back(size(i, n - 1));
      tail[i] *= sequential_->go_on(n, sizes[i], 1.0 / tail[i]);
      if (u[i] > tail[i]) return true;
      degree_[i] = n;
      weights_of(i)[n] = 1.0 / tail[i];
      return false;
    });
    if (!going.empty()) grow(n);
  }
}

}  // namespace jetlag
