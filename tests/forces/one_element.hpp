// SPDX-License-Identifier: MIT
#pragma once
// The series of one element, in any number type, and digits to which they are held.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "jetlag/motion/expansion.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"
#include "support/engine_of_numbers.hpp"

namespace jetlag::testing {

/// Tenths, exact in every number type: shape (P, 3).
template <int P>
using Tenths = std::array<std::array<int, 3>, P>;
template <int P>
struct Motion {
  Tenths<P> rest, place, speed;  // [m], [m], [m/s]
};

/// Of a law of fewer participants, or in the plane, the first rows and columns.
template <class T, class Rows>
Coordinates<T> rows_of(const Rows& tenths, int participants, int dimension) {
  Coordinates<T> x(participants, dimension);
  for (int i = 0; i < participants; ++i)
    for (int c = 0; c < dimension; ++c) x(i, c) = T(tenths[i][c]) / T(10);
  return x;
}

/// The series of one participant of a system of one element, of masses 1, 2, 3, ... [kg].
template <class L, class T, int P, class Add>
std::vector<Vector<T, L::dimensions[0]>> series_of_system(const Motion<P>& motion, int degree,
                                                          int participant, Add add) {
  constexpr int d = L::dimensions[0], n = L::participants;
  std::vector<T> mass;
  std::array<int, n> all;
  for (int i = 0; i < n; ++i) {
    all[i] = i;
    mass.emplace_back(i + 1);
  }
  System<T> system(d, mass);
  add(system, all);
  Expansion<T> series(system, degree);
  series.start({T(0), rows_of<T>(motion.place, n, d), rows_of<T>(motion.speed, n, d)});
  series.grow_to(degree);
  std::vector<Vector<T, d>> found(degree + 1);
  for (int k = 0; k <= degree; ++k)
    for (int c = 0; c < d; ++c) found[k][c] = series.position(k)(participant, c);
  return found;
}

/// With the parameters of its rest shape.
template <class L, class T, int P>
auto series_of_one(const Motion<P>& motion, const std::array<T, L::material.size()>& material, int degree,
                   int participant) {
  return series_of_system<L, T>(motion, degree, participant, [&](System<T>& system, const auto& all) {
    system.template add_at_rest<L>({all}, rows_of<T>(motion.rest, L::participants, L::dimensions[0]),
                                   {material});
  });
}

/// Given digits are right to half of their last: 5e-20 of the largest and less. Sums of up to some 50 products for each of 20
/// orders round by 2^-53 of terms that may be 10 times the sum: 1e-13 at order 5, and 1e-12.
template <class Exact, class Rounded>
void expect_digits_of(const Exact& exact, const Rounded& rounded, int k,
                      const std::vector<const char*>& digits) {
  std::vector<Digits50> expected;
  for (const char* text : digits) expected.emplace_back(text);
  EXPECT_THAT(exact, IsCloseTo(expected, within(1e-19)));
  EXPECT_THAT(rounded, IsCloseTo(expected, within(k == 5 ? 1e-13 : 1e-12)));
}

}  // namespace jetlag::testing
