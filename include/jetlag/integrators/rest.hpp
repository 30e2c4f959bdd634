// SPDX-License-Identifier: MIT
#pragma once
// Rest that lasts: particles that neither move nor are pushed where the force has no series, as of a force |v| v without a field.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "jetlag/model/system.hpp"

namespace jetlag {

/// Of particles that rest, those that stay at rest: the others may leave at any time, because beside where they rest forces lead
/// farther off and grow there less than the distance does, as that of x'' = sqrt(x). Where they grow like it, as in x'' = x, or
/// lead back, rest is the only motion. accelerations(state): rows in any unit.
template <class T, class Accelerations>
std::vector<bool> that_stay(const State<T>& state, const std::vector<bool>& resting,
                            const Accelerations& accelerations) {
  using std::abs;
  std::vector<bool> stay = resting;
  if (std::ranges::none_of(resting, [](bool rests) { return rests; })) return stay;
  const auto beside = [&](Coordinates<T> State<T>::* which, int c, const T& off) {
    State<T> other = state;
    for (std::size_t i = 0; i < resting.size();
         ++i)  // not all by as much: what depends on differences is seen
      if (resting[i]) (other.*which)(i, c) += off * T(1 + i % 7 / 8.0);
    return Coordinates<T>(accelerations(other));
  };
  for (const auto which : std::array{&State<T>::position, &State<T>::velocity})
    for (int c = 0; c < state.position.cols(); ++c)
      for (const int side : {1, -1}) {
        const T size = std::max(T(1), T((state.*which).cwiseAbs().maxCoeff()));
        const T off = T(side * 0x1p-20) * size;
        const Coordinates<T> far = beside(which, c, off), near = beside(which, c, T(off * T(0x1p-10)));
        for (std::size_t i = 0; i < stay.size(); ++i) {
          const T outwards = T(side) * near(i, c);
          if (outwards > T(0) && !(T(T(side) * far(i, c)) >= T(1000) * outwards)) stay[i] = false;
          for (int k = 0; k < state.position.cols(); ++k)  // to the side
            if (const T aside = abs(near(i, k)); k != c && !(abs(far(i, k)) >= T(1000) * aside))
              stay[i] = false;
        }
      }
  return stay;
}

}  // namespace jetlag
