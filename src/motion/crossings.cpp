// SPDX-License-Identifier: MIT
// Where an observable changes sign along its series.

#include <algorithm>
#include <cmath>
#include <limits>

#include "jetlag/base/rounded_time.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/motion/observable.hpp"
#include "jetlag/series/calculus/roots.hpp"
#include "motion/terms.hpp"

namespace jetlag {

namespace {
/// The sign of a polynomial right after 0.
int first_sign(const std::vector<double>& c) {
  const auto first = std::ranges::find_if(c, [](double x) { return x != 0; });
  return first == c.end() ? 0 : sign(*first);
}

/// Where two series join in one value: g comes there with the sign `side`, that after the last crossing. Returns the sign
/// that it has had before it became zero there. Where g is zero its last series crosses zero on the way beyond its end, or has
/// not yet done so: neither is a crossing, and what is found of it is taken back. Whether there is one, the signs before and
/// after tell.
int side_at_join(const LocalSeries& before, LocalSeries& after, int side, std::vector<Crossing>& found) {
  std::vector<double>& c = after.c;
  const double h = before.end - before.begin;
  if (sign(c[0]) != side && !before.to_change && c[0] != 0) {
    const double value = accurate_value(before.c, h);
    c[0] = sign(value) == side ? value : 0;
  }
  if (c[0] != 0 && (sign(c[0]) == side || !before.to_change)) return side;
  if (std::abs(c[0]) <= 0x1p-40 * Terms(c, after.end - after.begin).sum) c[0] = 0;
  const auto is_beyond = [&](double t) {  // between there and the end g is next to zero
    return std::abs(before.at(t + 0.5 * (before.end - t))) <= same_value * Terms(before.c, h).sum;
  };
  if (!found.empty() && found.back().time > before.begin && is_beyond(found.back().time)) {
    side = found.back().rising ? -1 : 1;
    found.pop_back();
  }
  return side;
}
}  // namespace

std::vector<Crossing> crossings(std::span<LocalSeries> series, int before) {
  std::vector<Crossing> found;
  int side = before;  // the last sign of g that was not zero; 0: none since it began, or since it jumped
  const LocalSeries* last = nullptr;
  for (LocalSeries& local : series) {
    double leaves = local.begin;  // when g has left zero, if it begins there
    if (!last) {
      leaves = std::min(std::nextafter(local.begin, std::numeric_limits<double>::infinity()), local.end);
      if (local.c[0] != 0) side = 0;
    } else if (local.join == LocalSeries::Join::jump) {
      side = 0;
    } else if (local.join == LocalSeries::Join::value) {
      side = side_at_join(*last, local, side, found);
    }
    last = &local;
    const int goes = first_sign(local.c);
    if (side * goes < 0) found.push_back({leaves, goes > 0});
    if (goes != 0) side = goes;
    const double h = time_between(local.begin, local.end);
    if (h > 0)
      for (const auto& [s, rising] : sign_changes(local.c, h)) {
        found.push_back({time_after(local.begin, s), rising});
        side = rising ? 1 : -1;
      }
  }
  return found;
}

std::vector<Crossing> crossings(const PieceView& piece, const Observable& g) {
  if (piece.position.empty()) throw std::invalid_argument("crossings: a piece without coefficients");
  const auto x = piece.position.front();
  g.require_fit("the observable", static_cast<int>(x.rows()), static_cast<int>(x.cols()));
  std::vector<LocalSeries> series = ObservableSeries(g).along(piece);
  for (const LocalSeries& part : series)
    if (!part.is_finite())
      throw std::invalid_argument("crossings: the observable has no series at t = " + shown(part.begin));
  return crossings(series);
}

}  // namespace jetlag
