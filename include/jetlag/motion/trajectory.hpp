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
//
// All coefficients stand one after another in blocks of memory, which do not move: a view of a piece lasts as long as its
// trajectory. Many threads may read at once.

#include <cstddef>
#include <vector>

#include "jetlag/base/pages.hpp"
#include "jetlag/motion/piece.hpp"

namespace jetlag {

class Trajectory {
 public:
  /// One more piece, copied. It begins where the last one ends, and has as many particles.
  /// Throws std::invalid_argument where it does not, where it ends before it begins, and for more than 3 components.
  void add(const PieceView& piece);
  void add(const Piece& piece) { add(PieceView(piece)); }

  bool empty() const { return size_ == 0; }
  /// How many pieces there are, and each of them in order of time, p < size().
  std::size_t size() const { return size_; }
  PieceView piece(std::size_t p) const;

  /// The interval that is known [s]. Throws std::invalid_argument while there is no piece.
  double begin() const;
  double end() const;

  /// The piece that holds t: where two meet the later one, so that after an impact the state is the new one.
  /// O(log pieces). Throws std::invalid_argument unless begin() <= t <= end().
  PieceView piece_at(double t) const;

  /// The state at t, begin() <= t <= end(), of all particles or of one. Throws std::invalid_argument outside, and for
  /// a particle that does not exist.
  State<double> at(double t) const { return piece_at(t).at(t); }
  /// The same into a state whose storage is kept where it fits.
  void at(double t, State<double>& into) const { piece_at(t).at(t, into); }
  using Row = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 3>;  // allocates nothing
  Row position(int particle, double t) const;                                   // [m], shape (dimension)
  Row velocity(int particle, double t) const;                                   // [m/s]

  /// Memory held, in bytes: 8 for each particle, component and coefficient of position and velocity and 32 for each piece; for
  /// pieces to come an eighth of that, from 4 MiB on up to 2 MiB.
  std::size_t bytes() const;

 private:
  /// Coefficients from the front, those of the positions first; from the back, piece by piece, where they stand.
  struct Block {
    PageVector numbers;
    std::size_t first;       // the number of its first piece
    double begin;            // of that piece
    std::size_t pieces = 0;  // how many
    std::size_t used = 0;    // numbers at the front
  };
  struct Place;
  static std::size_t at_back(const Block& block, std::size_t piece);
  PieceView piece_in(std::size_t block, std::size_t piece) const;
  Block& block_for(std::size_t numbers, double begin);

  std::vector<Block> blocks_;
  std::size_t size_ = 0;
  double end_ = 0;
  int particles_ = 0, dimension_ = 0;
};

}  // namespace jetlag
