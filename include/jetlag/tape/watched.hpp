// SPDX-License-Identifier: MIT
#pragma once
// The conditions of a program as series: where one changes.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "jetlag/series/calculus/first_change.hpp"
#include "jetlag/tape/program.hpp"

namespace jetlag {

/// The first change among several conditions, one after another; see find_first_change. at(place, k): coefficient k in the
/// lane that is meant, k < orders. of_known: coefficients from the first one on that is not finite say nothing.
template <class T, class At>
void find_first_change(const Program::Watched& condition, const At& at, int orders, bool of_known, T& most,
                       std::optional<T>& first) {
  using std::isfinite;
  const auto series = [&](Place place) {
    std::vector<T> c(orders);
    for (int k = 0; k < orders; ++k) c[k] = at(place, k);
    if (of_known) c.erase(std::ranges::find_if_not(c, [](const T& x) { return isfinite(x); }), c.end());
    return c;
  };
  const std::vector<T> c = series(condition.place);
  if (condition.argument)
    find_first_change_of_root<T>(series(*condition.argument), c, condition.at_zero, most, first);
  else
    find_first_change<T>(c, condition.at_zero, most, first);
}

}  // namespace jetlag
