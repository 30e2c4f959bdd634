// SPDX-License-Identifier: MIT
#include "jetlag/motion/piece.hpp"

#include <algorithm>

#include "jetlag/series/calculus/row_sums.hpp"

namespace jetlag {

namespace {

/// Numbers of a state up to which sums at several times go beside each other: those of more are beside each other themselves.
constexpr std::size_t few = 3;

/// The sums at the times s, each in the coordinates of the state that `of` picks.
void sum_side_by_side(const CoefficientsView& c, const double (&s)[detail::times_beside],
                      std::span<State<double>> into, Coordinates<double> State<double>::* of) {
  for (State<double>& state : into) (state.*of).resize(c.particles(), c.dimension());
  for (int i = 0; i < c.particles(); ++i)
    for (int d = 0; d < c.dimension(); ++d) {
      double sums[detail::times_beside];
      detail::sum_at_times(c.row(0, i) + d, c.numbers_of_each(), static_cast<int>(c.size()) - 1, s, sums);
      for (std::size_t j = 0; j < into.size(); ++j) (into[j].*of)(i, d) = sums[j];
    }
}

}  // namespace

void PieceView::at(double t, State<double>& into) const {
  const double s = (t - begin) / unit;
  into.time = t;
  position.sum(s, into.position);
  velocity.sum(s, into.velocity);
  into.drop_rests();
}

void PieceView::at(std::span<const double> times, std::span<State<double>> into) const {
  if (times.size() < 2 || position.numbers_of_each() > few) {
    for (std::size_t j = 0; j < times.size(); ++j) at(times[j], into[j]);
    return;
  }
  constexpr std::size_t together = detail::times_beside;
  for (std::size_t first = 0; first < times.size(); first += together) {
    const std::size_t count = std::min(together, times.size() - first);
    double s[together] = {};
    for (std::size_t j = 0; j < count; ++j) {
      State<double>& state = into[first + j];
      state.time = times[first + j];
      state.drop_rests();
      s[j] = (state.time - begin) / unit;
    }
    sum_side_by_side(position, s, into.subspan(first, count), &State<double>::position);
    sum_side_by_side(velocity, s, into.subspan(first, count), &State<double>::velocity);
  }
}

State<double> PieceView::at(double t) const {
  State<double> state;
  at(t, state);
  return state;
}

void Piece::at(double t, State<double>& into) const { PieceView(*this).at(t, into); }

State<double> Piece::at(double t) const { return PieceView(*this).at(t); }

Piece Piece::about(double t) const {
  Piece moved{t, end, position, velocity, unit};
  taylor_shift(moved.position, (t - begin) / unit);
  taylor_shift(moved.velocity, (t - begin) / unit);
  return moved;
}

std::vector<std::vector<double>> polynomials(const PieceView& piece, int particle) {
  std::vector<std::vector<double>> rows(piece.position.dimension());
  for (std::size_t c = 0; c < rows.size(); ++c)
    for (std::size_t k = 0; k < piece.position.size(); ++k)
      rows[c].push_back(piece.position(k, particle, static_cast<int>(c)));
  return rows;
}

}  // namespace jetlag
