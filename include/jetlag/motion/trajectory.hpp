// SPDX-License-Identifier: MIT
#pragma once
// A trajectory: the pieces of a run in order, and with them the state at any time of it (dense output).
//
//   Trajectory motion;
//   record(schedule, state, 10.0, motion);               // schedule/record.hpp; or add() a piece after each step
//   State<double> then = motion.at(3.7);
//
// How exact it is. Within a step the polynomial is the method's own: at(t) equals a step of length t - begin, bit for
// bit where the clock is exact. `begin` is the time of a compensated clock rounded to a double, so that at(t) is the
// motion at a time at most ulp(t) away: an error of |v| ulp(t) in a position, and as much a jump between two pieces,
// beside the rounding of Horner's rule. ulp(t) = 2^-52 t: 1.2e-7 s at 1e9 s; count the time from a nearer origin there.

#include <cstddef>
#include <vector>

#include "jetlag/motion/piece.hpp"

namespace jetlag {

class Trajectory {
 public:
  /// One more piece. It begins where the last one ends, and has as many particles.
  /// Throws std::invalid_argument where it does not, and where it ends before it begins.
  void add(Piece piece);

  bool empty() const { return pieces_.empty(); }
  const std::vector<Piece>& pieces() const { return pieces_; }

  /// The interval that is known [s]. Throws std::invalid_argument while there is no piece.
  double begin() const;
  double end() const;

  /// The piece that holds t: where two meet the later one, so that after an impact the state is the new one.
  /// O(log pieces). Throws std::invalid_argument unless begin() <= t <= end().
  const Piece& piece_at(double t) const;

  /// The state at t, begin() <= t <= end(), of all particles or of one. Throws std::invalid_argument outside, and for
  /// a particle that does not exist.
  State<double> at(double t) const { return piece_at(t).at(t); }
  Eigen::RowVectorXd position(int particle, double t) const;  // [m], shape (dimension)
  Eigen::RowVectorXd velocity(int particle, double t) const;  // [m/s]

  /// Memory held, in bytes: 16 for each particle, component and coefficient, and some 200 for each piece.
  std::size_t bytes() const;

 private:
  std::vector<Piece> pieces_;
};

}  // namespace jetlag
