// SPDX-License-Identifier: MIT
#include "jetlag/motion/piece.hpp"

namespace jetlag {

namespace {

void horner(const Coefficients& c, double s, Coordinates<double>& sum) {
  sum = c.back();
  for (std::size_t k = c.size() - 1; k-- > 0;) {
    const double* next = c.data(k);
    for (Eigen::Index i = 0; i < sum.size(); ++i) sum.data()[i] = sum.data()[i] * s + next[i];
  }
}

}  // namespace

void Piece::at(double t, State<double>& into) const {
  const double s = (t - begin) / unit;
  into.time = t;
  horner(position, s, into.position);
  horner(velocity, s, into.velocity);
  into.drop_rests();
}

State<double> Piece::at(double t) const {
  State<double> state;
  at(t, state);
  return state;
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
