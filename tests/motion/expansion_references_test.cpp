// SPDX-License-Identifier: MIT
// Motions with published or independently computed series, in 50 digits.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/motion/expansion.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"
#include "support/engine_of_numbers.hpp"
#include "support/random.hpp"

namespace jetlag::testing::expansion_references_test {
namespace {

using Vector3 = std::array<Digits50, 3>;

Coordinates<Digits50> row(const Vector3& x) {
  Coordinates<Digits50> m(1, 3);
  for (int c = 0; c < 3; ++c) m(0, c) = x[c];
  return m;
}

/// A particle of mass 1 at r with velocity v, attracted with G M = 1 by a fixed one at the origin.
Expansion<Digits50> orbit(const Vector3& r, const Vector3& v, int order) {
  System<Digits50> system(3, {1, 1});
  system.fix(0);
  system.add<Gravity>({{0, 1}}, {{Digits50(1)}});
  Coordinates<Digits50> x = Coordinates<Digits50>::Constant(2, 3, Digits50(0)), w = x;
  x.row(1) = row(r);
  w.row(1) = row(v);
  Expansion<Digits50> series(system, order);
  series.start({0, x, w});
  series.grow_to(order);
  return series;
}

TEST(Expansion, OfTwoBodiesIsTheFAndGSeries) {
  // x = f r + g v to order 5, with u = 1/r^3, p = r.v/r^2, q = v^2/r^2 - u.   Source: the classical f and g
  // series.
  Uniform draw(17);
  for (int i = 0; i < 5; ++i) {
    Vector3 r, v;
    for (int c = 0; c < 3; ++c) {
      r[c] = draw(0.5, 1.5);
      v[c] = draw(-1, 1);
    }
    const Digits50 rr = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
    const Digits50 u = 1 / (rr * sqrt(rr));
    const Digits50 p = (r[0] * v[0] + r[1] * v[1] + r[2] * v[2]) / rr;
    const Digits50 q = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / rr - u;
    const Digits50 f[] = {
        1, 0, -u / 2, u * p / 2, u * (3 * q - 15 * p * p + u) / 24, u * p * (7 * p * p - 3 * q - u) / 8};
    const Digits50 g[] = {0, 1, 0, -u / 6, u * p / 4, u * (9 * q - 45 * p * p + u) / 120};
    const auto series = orbit(r, v, 5);
    for (int k = 0; k <= 5; ++k) {
      Vector3 expected;
      for (int c = 0; c < 3; ++c) expected[c] = f[k] * r[c] + g[k] * v[c];
      const Vector3 actual{series.position(k)(1, 0), series.position(k)(1, 1), series.position(k)(1, 2)};
      EXPECT_THAT(actual, IsCloseTo(expected, within(1e-45)))
          << "order " << k;  // some operations of 1e-50 each
    }
  }
}

TEST(Expansion, OfAKeplerOrbitHasItsReferenceJet) {
  // all digits that are given; the 36 terms match the closed-form orbit at t = 0.3 to 4e-35
  const auto series = orbit({Digits50(1), Digits50("0.1"), Digits50("0.05")},
                            {Digits50(0), Digits50("0.9"), Digits50("0.2")}, 36);
  const auto expect = [&](int k, int axis, const char* reference) {
    EXPECT_THAT(series.position(k)(1, axis), IsCloseTo(Digits50(reference), within(1e-18)))
        << k;  // 19 or 20 digits
  };
  expect(5, 0, "-0.0059032737889392270398");
  expect(10, 0, "-2.3472610585291152903e-5");
  expect(20, 0, "1.940921566515064147e-9");
  expect(30, 0, "5.7180880396111271442e-13");
  expect(36, 0, "-2.9224530633670837311e-15");
  expect(20, 1, "-3.8409099125121947031e-9");
  expect(20, 2, "-7.9962104815506926326e-10");
}

/// A spring from the origin with a damper along it: F = -(k (|x| - L) + c x.v/|x|) x/|x|.
struct DampedSpring {
  static constexpr const char* name = "damped_spring";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"stiffness", "rest_length", "damping"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& stiffness, const T& rest_length,
                            const T& damping) {
    const Vector<T, D>& x = p.position[0];
    const T length = x.norm();
    const T rate = x.dot(p.velocity[0]) / length;
    return T(-(stiffness * (length - rest_length) + damping * rate) / length) * x;
  }
};

TEST(Expansion, OfADampedSpringHasItsReferenceJet) {  // 18 digits from a 60-digit recursion
  System<Digits50> system(3, {1});
  system.add<DampedSpring>({{0}}, {{Digits50(50), Digits50(1), Digits50("0.3")}});
  Expansion<Digits50> series(system);
  series.start({0, row({Digits50("1.2"), Digits50("0.3"), Digits50("-0.1")}),
                row({Digits50("0.1"), Digits50("-0.4"), Digits50("0.2")})});
  series.grow_to(20);
  const auto expect = [&](int k, const std::array<const char*, 3>& reference) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_THAT(series.position(k)(0, axis), IsCloseTo(Digits50(reference[axis]), within(1e-17)))
          << "order " << k << ", axis " << axis;
  };
  expect(2, {"-5.82297341690092871", "-1.45574335422523218", "0.485247784741744059"});
  expect(5, {"-2.01778911963187712", "-4.92444296926827465", "2.33481364691064925"});
  expect(10, {"-19.8275672817113628", "-4.26135003639162586", "1.31134541855623375"});
  expect(20, {"-428.091303909894842", "217.499129133842279", "-123.405114434624444"});
}

}  // namespace
}  // namespace jetlag::testing::expansion_references_test
