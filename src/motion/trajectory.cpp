// SPDX-License-Identifier: MIT
#include "jetlag/motion/trajectory.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

[[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument("Trajectory: " + why); }

/// One row of a polynomial, by Horner's rule.
Eigen::RowVectorXd horner(const Coefficients& c, int row, double s) {
  Eigen::RowVectorXd sum = c.back().row(row);
  for (std::size_t k = c.size() - 1; k-- > 0;) {
    const double* next = c.data(k) + static_cast<std::size_t>(row) * c.dimension();
    for (int i = 0; i < c.dimension(); ++i) sum[i] = sum[i] * s + next[i];
  }
  return sum;
}

const Piece& with_particle(const Piece& piece, int particle) {
  if (particle < 0 || particle >= piece.position.front().rows())
    refuse("particle " + std::to_string(particle) + " does not exist, there are " +
           std::to_string(piece.position.front().rows()));
  return piece;
}

}  // namespace

void Trajectory::add(Piece piece) {
  if (piece.position.empty() || piece.velocity.empty()) refuse("a piece without coefficients");
  if (!(piece.begin <= piece.end))
    refuse("a piece from " + number(piece.begin) + " to " + number(piece.end) + " ends before it begins");
  if (!empty()) {
    const auto known = pieces_.back().position.front(), x = piece.position.front();
    if (piece.begin != end())
      refuse("a piece begins at " + number(piece.begin) + ", the last one ends at " + number(end()));
    if (x.rows() != known.rows() || x.cols() != known.cols())
      refuse("a piece of shape (" + std::to_string(x.rows()) + ", " + std::to_string(x.cols()) + "), not (" +
             std::to_string(known.rows()) + ", " + std::to_string(known.cols()) + ")");
  }
  pieces_.push_back(std::move(piece));
}

double Trajectory::begin() const {
  if (empty()) refuse("there is no piece yet");
  return pieces_.front().begin;
}

double Trajectory::end() const {
  if (empty()) refuse("there is no piece yet");
  return pieces_.back().end;
}

const Piece& Trajectory::piece_at(double t) const {
  if (!(begin() <= t && t <= end()))
    refuse("t = " + number(t) + " lies outside of [" + number(begin()) + ", " + number(end()) + "]");
  return *std::prev(std::ranges::upper_bound(pieces_, t, {}, &Piece::begin));
}

Eigen::RowVectorXd Trajectory::position(int particle, double t) const {
  const Piece& piece = with_particle(piece_at(t), particle);
  return horner(piece.position, particle, (t - piece.begin) / piece.unit);
}

Eigen::RowVectorXd Trajectory::velocity(int particle, double t) const {
  const Piece& piece = with_particle(piece_at(t), particle);
  return horner(piece.velocity, particle, (t - piece.begin) / piece.unit);
}

std::size_t Trajectory::bytes() const {
  std::size_t total = pieces_.capacity() * sizeof(Piece);
  for (const Piece& piece : pieces_) total += piece.position.bytes() + piece.velocity.bytes();
  return total;
}

}  // namespace jetlag
