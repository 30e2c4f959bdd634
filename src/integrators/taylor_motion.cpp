// SPDX-License-Identifier: MIT
// The motion within a step of RandomTaylor.
#include "jetlag/integrators/taylor.hpp"

namespace jetlag {

Piece RandomTaylor::piece() const {
  if (!known_.empty()) return piece_of_known();
  Piece piece{expansion().time(), expansion().time() + last_step_, {}, {}, expansion().time_unit()};
  const bool derivative = options_.velocity == VelocitySeries::derivative;
  const int top = stops().largest_degree();
  if (stops().shared() && !derivative) {
    expansion().weighted_series(top, series_.weights(0), piece.position, piece.velocity);
    return piece;
  }
  // Term n of each particle with the weight of its draw, none beyond its degree.
  const auto weighted = [&](int n, Coordinates<double> c) {
    if (stops().shared()) return Coordinates<double>(series_.weights(0)[n] * c);
    for (int i = 0; i < expansion().particles(); ++i)
      c.row(i) *= n > stops().degree(i) ? 0.0 : series_.weights(i)[n];
    return c;
  };
  for (int n = 0; n <= top; ++n) {
    Coordinates<double> x = weighted(n, expansion().position(n));
    if (!derivative)
      piece.velocity.push_back(weighted(n, expansion().velocity(n)));
    else if (n > 0)
      piece.velocity.push_back(n / expansion().time_unit() * x);
    piece.position.push_back(x);
  }
  if (piece.velocity.empty())
    piece.velocity.push_back(0.0 * expansion().velocity(0));  // K = 0 and `derivative`
  return piece;
}

/// Where all weights are 1 and velocities have a series of their own the coefficients are those of the expansion.
PieceView RandomTaylor::motion() const {
  const bool derivative = options_.velocity == VelocitySeries::derivative;
  if (!known_.empty() || !stops().law().is_fixed() || derivative) return Integrator::motion();
  const int top = stops().law().max_degree();
  return {expansion().time(), expansion().time() + last_step_, expansion().position_series(top),
          expansion().velocity_series(top), expansion().time_unit()};
}

}  // namespace jetlag
