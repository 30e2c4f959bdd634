// SPDX-License-Identifier: MIT
// Motions that are known in closed form: the series of each law, in 1, 2 and 3 dimensions.
#include <gtest/gtest.h>

#include <boost/math/special_functions/factorials.hpp>
#include <string>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/motion/expansion.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"
#include "support/engine_of_numbers.hpp"

namespace jetlag::testing {
namespace {

using boost::math::factorial;
using Number = RunningError<double>;  // the whole engine on numbers that know their error
constexpr int degree = 16;

/// Coefficients 0 .. degree of one component of one particle.
std::vector<Number> series_of(const Expansion<Number>& motion, int particle, int axis) {
  std::vector<Number> c;
  for (int k = 0; k <= motion.order(); ++k) c.push_back(motion.position(k)(particle, axis));
  return c;
}

Coordinates<Number> rows(const std::vector<std::vector<double>>& x) {
  Coordinates<Number> m(x.size(), x[0].size());
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t c = 0; c < x[i].size(); ++c) m(i, c) = x[i][c];
  return m;
}

Expansion<Number> expand(const System<Number>& system, const std::vector<std::vector<double>>& position,
                         const std::vector<std::vector<double>>& velocity) {
  Expansion<Number> motion(system, degree);
  motion.start({0.0, rows(position), rows(velocity)});
  motion.grow_to(degree);
  return motion;
}

/// cos(w t) and sin(w t).
Digits50 cos_coefficient(double w, int k) {
  return k % 2 ? Digits50(0) : (k / 2 % 2 ? -1 : 1) * pow(Digits50(w), k) / factorial<Digits50>(k);
}
Digits50 sin_coefficient(double w, int k) {
  return k % 2 ? (k / 2 % 2 ? -1 : 1) * pow(Digits50(w), k) / factorial<Digits50>(k) : Digits50(0);
}

class InDimension : public ::testing::TestWithParam<int> {
 protected:
  const int d = GetParam();
  /// The first d components.
  std::vector<double> cut(std::vector<double> x) const {
    x.resize(d);
    return x;
  }
};
INSTANTIATE_TEST_SUITE_P(ClosedForm, InDimension, ::testing::Values(1, 2, 3),
                         [](const auto& info) { return std::to_string(info.param); });

TEST_P(InDimension, UniformFieldGivesAParabola) {  // x = x_0 + v t + g t^2 / 2, whatever the mass
  System<Number> system(d, {3.0});
  system.add<UniformField>({{0}}, {{0.75, -9.8125, 2.0}});
  const auto motion = expand(system, {cut({1, 2, 3})}, {cut({4, 5, 6})});
  const double g[] = {0.75, -9.8125, 2.0};
  for (int axis = 0; axis < d; ++axis) {
    const double parabola[] = {1.0 + axis, 4.0 + axis, g[axis] / 2};
    EXPECT_THAT(series_of(motion, 0, axis),
                HasCoefficients([&](int k) { return k <= 2 ? parabola[k] : 0.0; }));
  }
}

/// x'' = a sin(w t + phi): coefficient k is a w^(k-2) sin(phi + (k - 2) pi/2) / k!, whatever the mass.
TEST_P(InDimension, OscillatingFieldGivesAWave) {
  System<Number> system(d, {3.0});
  system.add<OscillatingField>({{0}}, {{0.75, -9.8125, 2.0, 1.5, 0.25}});
  const auto motion = expand(system, {cut({1, 2, 3})}, {cut({4, 5, 6})});
  const double a[] = {0.75, -9.8125, 2.0};
  const Digits50 phi(0.25);
  const Digits50 turned[] = {sin(phi), cos(phi), -sin(phi), -cos(phi)};
  for (int axis = 0; axis < d; ++axis)
    EXPECT_THAT(series_of(motion, 0, axis), HasCoefficients([&](int k) {
                  if (k < 2) return Digits50(k == 0 ? 1 + axis : 4 + axis);
                  return a[axis] * pow(Digits50(1.5), k - 2) * turned[(k - 2) % 4] / factorial<Digits50>(k);
                }));
}

TEST_P(InDimension, DragStopsExponentially) {  // v = v_0 exp(-c t / m), c/m = 5/2
  System<Number> system(d, {0.5});
  system.add<Drag>({{0}}, {{1.25}});
  const auto motion = expand(system, {cut({1, 1, 1})}, {cut({4, -5, 6})});
  const double v[] = {4, -5, 6};
  for (int axis = 0; axis < d; ++axis)
    EXPECT_THAT(series_of(motion, 0, axis), HasCoefficients([&](int k) {
                  return k == 0 ? Digits50(1)
                                : -v[axis] / Digits50(2.5) * pow(Digits50(-2.5), k) / factorial<Digits50>(k);
                }));
}

TEST_P(InDimension,
       SpringOscillatesAlongItsLength) {  // d = L + (A cos wt + B sin wt), w^2 = k (1/m_0 + 1/m_1)
  System<Number> system(d, {1.0, 3.0});
  system.add<Spring>({{0, 1}}, {{3.0, 2.0}});  // w = 2, L = 2
  const auto motion = expand(system, {cut({0, 0, 0}), cut({2.5, 0, 0})}, {cut({0, 0, 0}), cut({0.25, 0, 0})});
  // d(0) = 2.5, so A = 1/2; d'(0) = 1/4, so B = 1/8. Centre of mass at 3/4 (2.5 + t/4).
  const auto oscillation = [](int k) {
    return Digits50(k == 0 ? 2 : 0) + cos_coefficient(2, k) / 2 + sin_coefficient(2, k) / 8;
  };
  const auto centre = [](int k) { return Digits50(k == 0 ? 1.875 : k == 1 ? 0.1875 : 0); };
  EXPECT_THAT(series_of(motion, 0, 0),
              HasCoefficients([&](int k) { return centre(k) - 0.75 * oscillation(k); }));
  EXPECT_THAT(series_of(motion, 1, 0),
              HasCoefficients([&](int k) { return centre(k) + 0.25 * oscillation(k); }));
}

/// Two particles on circles about their centre of mass, angular velocity 2, distance 2, adrift along the last
/// axis.
void expect_circles(const System<Number>& system, int d) {
  const double m0 = system.mass()[0].value, m1 = system.mass()[1].value;
  const double r0 = -2 * m1 / (m0 + m1), r1 = 2 * m0 / (m0 + m1);
  std::vector<double> x0(d), x1(d), v0(d), v1(d);
  x0[0] = r0, x1[0] = r1, v0[1] = 2 * r0, v1[1] = 2 * r1;
  v0[d - 1] += 0.5, v1[d - 1] += 0.5;
  const auto motion = expand(system, {x0, x1}, {v0, v1});
  const double radius[] = {r0, r1};
  for (int i = 0; i < 2; ++i)
    for (int axis = 0; axis < d; ++axis)
      EXPECT_THAT(series_of(motion, i, axis), HasCoefficients([&](int k) {
                    const Digits50 circle = axis == 0   ? cos_coefficient(2, k)
                                            : axis == 1 ? sin_coefficient(2, k)
                                                        : Digits50(0);
                    return radius[i] * circle + (axis == d - 1 && k == 1 ? 0.5 : 0.0);
                  }))
          << "particle " << i << ", axis " << axis << " of " << d;
}

TEST(ClosedForm, SpringTurnsOnACircle) {  // mu w^2 r = k (r - L): 3/4 * 4 * 2 = 6 (2 - 1)
  for (const int d : {2, 3}) {
    System<Number> system(d, {1.0, 3.0});
    system.add<Spring>({{0, 1}}, {{6.0, 1.0}});
    expect_circles(system, d);
  }
}

TEST(ClosedForm, GravityTurnsOnACircle) {  // w^2 r^3 = G (m_0 + m_1): 4 * 8 = 16 (0.5 + 1.5)
  for (const int d : {2, 3}) {
    System<Number> system(d, {0.5, 1.5});
    system.add<Gravity>({{0, 1}}, {{16.0}});
    expect_circles(system, d);
  }
}

TEST_P(InDimension,
       ZeroLengthSpringOscillatesThroughItsEnds) {  // d = A sin wt, w^2 = k (1/m_0 + 1/m_1), in every axis
  System<Number> system(d, {1.0, 3.0});
  system.add<ZeroLengthSpring>({{0, 1}}, {{3.0}});  // w = 2
  const auto motion = expand(system, {cut({1, 1, 1}), cut({1, 1, 1})}, {cut({0, 0, 0}), cut({1, -2, 3})});
  const double v[] = {1, -2, 3};  // A = v/2; the centre of mass goes with 3/4 v
  for (int axis = 0; axis < d; ++axis) {
    const auto centre = [&](int k) { return Digits50(k == 0 ? 1 : k == 1 ? 0.75 * v[axis] : 0); };
    EXPECT_THAT(series_of(motion, 0, axis), HasCoefficients([&](int k) {
                  return centre(k) - 0.75 * v[axis] / 2 * sin_coefficient(2, k);
                }));
    EXPECT_THAT(series_of(motion, 1, axis), HasCoefficients([&](int k) {
                  return centre(k) + 0.25 * v[axis] / 2 * sin_coefficient(2, k);
                }));
  }
}

TEST(ClosedForm,
     SoftenedGravityTurnsOnACircle) {  // w^2 (r^2 + e^2)^{3/2} = G (m_0 + m_1): 4 * (4 + 9/4)^{3/2} = 62.5
  for (const int d : {2, 3}) {
    System<Number> system(d, {0.5, 1.5});
    system.add<SoftenedGravity>({{0, 1}}, {{31.25, 1.5}});
    expect_circles(system, d);
  }
}

TEST(ClosedForm, GravityOnALineLetsEscapeWithEnergyZero) {
  // x'^2 = 2 G M / x, so x = (x_0^{3/2} + 3/2 sqrt(2 G M) t)^{2/3};  here x = (1 + 3t/2)^{2/3}, from a fixed
  // mass
  System<Number> system(1, {2.0, 1.0});
  system.fix(0);
  system.add<Gravity>({{0, 1}}, {{0.25}});
  const auto motion = expand(system, {{0.0}, {1.0}}, {{0.0}, {1.0}});
  EXPECT_THAT(series_of(motion, 1, 0), HasCoefficients([](int k) {
                Digits50 c = 1;
                for (int j = 0; j < k; ++j) c *= (Digits50(2) / 3 - j) / (j + 1) * Digits50(1.5);
                return c;
              }));
}

// ---- forces at a point ------------------------------------------------------------------------------------

template <int D>
Participants<double, D, 2> at_distance(const Vector<double, D>& d) {
  Participants<double, D, 2> p;
  p.position = {Vector<double, D>::Constant(0.5), Vector<double, D>::Constant(0.5) + d};
  p.velocity = {Vector<double, D>::Zero(), Vector<double, D>::Zero()};
  p.mass = {2.0, 3.0};
  p.time = 0.0;
  return p;
}

TEST(ClosedForm, SpringPullsWithStiffnessTimesExtension) {  // |d| = 5, 5, 7
  using V1 = Vector<double, 1>;
  using V2 = Vector<double, 2>;
  using V3 = Vector<double, 3>;
  EXPECT_THAT(Spring::force(at_distance<1>(V1(-5)), 4.0, 3.0), IsCloseTo(V1(-8), ulps(4)));
  EXPECT_THAT(Spring::force(at_distance<2>(V2(3, 4)), 5.0, 6.0), IsCloseTo(V2(-3, -4), ulps(4)));
  EXPECT_THAT(Spring::force(at_distance<3>(V3(2, 3, 6)), 3.5, 5.0), IsCloseTo(V3(2, 3, 6), ulps(4)));
  EXPECT_THAT(Spring::energy(at_distance<3>(V3(2, 3, 6)), 3.5, 5.0), IsCloseTo(7.0, ulps(4)));
}

TEST(ClosedForm, GravityFallsWithTheSquareOfTheDistance) {  // G m_0 m_1 = 6 G
  using V1 = Vector<double, 1>;
  using V2 = Vector<double, 2>;
  using V3 = Vector<double, 3>;
  EXPECT_THAT(Gravity::force(at_distance<1>(V1(-2)), 2.0), IsCloseTo(V1(-3), ulps(4)));
  EXPECT_THAT(Gravity::force(at_distance<2>(V2(3, 4)), 125.0), IsCloseTo(V2(18, 24), ulps(4)));
  EXPECT_THAT(Gravity::force(at_distance<3>(V3(2, 3, 6)), 343.0), IsCloseTo(V3(12, 18, 36), ulps(4)));
  EXPECT_THAT(Gravity::energy(at_distance<3>(V3(2, 3, 6)), 343.0), IsCloseTo(-294.0, ulps(4)));
}

TEST(ClosedForm, SoftenedGravityIsThatOfADistanceInOneMoreDimension) {  // 6 G d / (|d|^2 + e^2)^{3/2}
  using V2 = Vector<double, 2>;
  using V3 = Vector<double, 3>;
  EXPECT_THAT(SoftenedGravity::force(at_distance<2>(V2(3, 4)), 2197.0, 12.0), IsCloseTo(V2(18, 24), ulps(4)));
  EXPECT_THAT(SoftenedGravity::energy(at_distance<2>(V2(3, 4)), 13.0, 12.0), IsCloseTo(-6.0, ulps(4)));
  EXPECT_EQ(SoftenedGravity::force(at_distance<3>(V3(0, 0, 0)), 2.0, 1e-100), V3(0, 0, 0));
  EXPECT_THAT(SoftenedGravity::energy(at_distance<3>(V3(0, 0, 0)), 2.0, 3.0), IsCloseTo(-4.0, ulps(4)));
}

TEST(ClosedForm, ZeroLengthSpringPullsWithStiffnessTimesDistance) {
  using V3 = Vector<double, 3>;
  EXPECT_EQ(ZeroLengthSpring::force(at_distance<3>(V3(2, 3, 6)), 0.5), V3(1, 1.5, 3));
  EXPECT_EQ(ZeroLengthSpring::force(at_distance<3>(V3(0, 0, 0)), 0.5), V3(0, 0, 0));
  EXPECT_THAT(ZeroLengthSpring::energy(at_distance<3>(V3(2, 3, 6)), 4.0), IsCloseTo(98.0, ulps(4)));
}

}  // namespace
}  // namespace jetlag::testing
