// SPDX-License-Identifier: MIT
#include "jetlag/motion/piece.hpp"

namespace jetlag {

namespace {

Coordinates<double> horner(const std::vector<Coordinates<double>>& c, double s) {
  Coordinates<double> sum = c.back();
  for (std::size_t k = c.size() - 1; k-- > 0;) sum = sum * s + c[k];
  return sum;
}

}  // namespace

State<double> Piece::at(double t) const {
  const double s = (t - begin) / unit;
  return {t, horner(position, s), horner(velocity, s)};
}

Piece Piece::about(double t) const {
  Piece moved{t, end, position, velocity, unit};
  taylor_shift(moved.position, (t - begin) / unit);
  taylor_shift(moved.velocity, (t - begin) / unit);
  return moved;
}

std::vector<std::vector<double>> polynomials(const Piece& piece, int particle) {
  std::vector<std::vector<double>> rows(piece.position.front().cols());
  for (const auto& coefficient : piece.position)
    for (std::size_t c = 0; c < rows.size(); ++c)
      rows[c].push_back(coefficient(particle, static_cast<int>(c)));
  return rows;
}

}  // namespace jetlag
