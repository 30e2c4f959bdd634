// SPDX-License-Identifier: MIT
// An expansion in jets carries the derivatives of the motion by its initial values and parameters.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "jetlag/forces/gravity.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/motion/first_order.hpp"
#include "support/close.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::sensitivity_test {
namespace {

constexpr int degree = 7;             // the bounds that numbers carry grow about tenfold with each order
using Number = RunningError<double>;  // what is proved of it holds for double, which has the same bits
using Sensitive = Jet<Number, 1>;     // a value and its derivative by one parameter

/// x and v in the plane, GM; in some number type.
template <class T>
struct Kepler {
  std::array<T, 2> x, v;
  T gm;
};
const Kepler<double> orbit{{0.5, 0.2}, {-0.4, 1.1}, 1.25};

/// The orbit and its derivative along a direction.
Kepler<Sensitive> seeded(const Kepler<double>& direction) {
  const auto seed = [](double value, double derivative) { return Sensitive::from({value, derivative}); };
  return {{seed(orbit.x[0], direction.x[0]), seed(orbit.x[1], direction.x[1])},
          {seed(orbit.v[0], direction.v[0]), seed(orbit.v[1], direction.v[1])},
          seed(orbit.gm, direction.gm)};
}

/// A body round a fixed sun of mass GM.
template <class T>
Expansion<T> expansion(const Kepler<T>& kepler) {
  System<T> system(2, {kepler.gm, T(1)});
  system.fix(0);
  system.template add<Gravity>({{0, 1}}, {{T(1)}});
  State<T> state{T(0), Coordinates<T>::Zero(2, 2), Coordinates<T>::Zero(2, 2)};
  for (int c = 0; c < 2; ++c) {
    state.position(1, c) = kepler.x[c];
    state.velocity(1, c) = kepler.v[c];
  }
  Expansion<T> series(system, degree);
  series.start(state);
  series.grow_to(degree);
  return series;
}

/// The variational equation, integrated as a first-order system beside the motion:
///   d'' = GM (3 (x . d) x / r^5 - d / r^3) - dGM x / r^3.     Components: x, v, d, d'.
FirstOrderExpansion<Number> variational_equation(const Kepler<double>& direction) {
  const auto f = [&](const auto&, const auto& y) {
    using S = std::decay_t<decltype(y[0])>;
    const S r2 = y[0] * y[0] + y[1] * y[1];
    const S a = pow(r2, -1.5), b = 3.0 * pow(r2, -2.5) * (y[0] * y[4] + y[1] * y[5]);
    std::vector<S> derivative{y[2], y[3]};
    for (int c = 0; c < 2; ++c) derivative.push_back(-orbit.gm * (a * y[c]));
    derivative.push_back(y[6]);
    derivative.push_back(y[7]);
    for (int c = 0; c < 2; ++c)
      derivative.push_back(orbit.gm * (b * y[c] - a * y[4 + c]) - direction.gm * (a * y[c]));
    return derivative;
  };
  FirstOrderExpansion<Number> series(f, 8);
  series.start(0.0, {orbit.x[0], orbit.x[1], orbit.v[0], orbit.v[1], direction.x[0], direction.x[1],
                     direction.v[0], direction.v[1]});
  series.grow_to(degree);
  return series;
}

void expect_variation(const Kepler<double>& direction) {
  const auto jets = expansion(seeded(direction));
  const auto variation = variational_equation(direction);
  for (int c = 0; c < 2; ++c)
    for (int k = 0; k <= degree; ++k) {
      const Sensitive x = jets.position(k)(1, c);
      EXPECT_THAT(x[0], IsCloseTo(variation[c][k])) << "order " << k;
      EXPECT_THAT(x[1], IsCloseTo(variation[4 + c][k])) << "derivative, order " << k;
    }
}

TEST(Sensitivity, ToAnInitialPositionSolvesTheVariationalEquation) { expect_variation({{1, 0}, {0, 0}, 0}); }
TEST(Sensitivity, ToAnInitialVelocitySolvesTheVariationalEquation) { expect_variation({{0, 0}, {0, 1}, 0}); }
TEST(Sensitivity, ToTheAttractionSolvesTheVariationalEquation) { expect_variation({{0, 0}, {0, 0}, 1}); }

TEST(Sensitivity, KnowsKeplersThirdLaw) {
  // x(b t) is the orbit of b v_0 and b^2 GM: by d/db at b = 1, (v_0 . d/dv_0 + 2 GM d/dGM) x_k = k x_k
  const auto series = expansion(seeded({{0, 0}, orbit.v, 2 * orbit.gm}));
  for (int k = 0; k <= degree; ++k)
    for (int c = 0; c < 2; ++c) {
      const Sensitive x = series.position(k)(1, c);
      EXPECT_THAT(x[1], IsCloseTo(k * x[0])) << "order " << k;
    }
}

TEST(Sensitivity, KnowsThatAnOrbitCanBeEnlarged) {
  // a x(t) is the orbit of a x_0, a v_0 and a^3 GM: (x_0 . d/dx_0 + v_0 . d/dv_0 + 3 GM d/dGM) x_k = x_k
  const auto series = expansion(seeded({orbit.x, orbit.v, 3 * orbit.gm}));
  for (int k = 0; k <= degree; ++k)
    for (int c = 0; c < 2; ++c) {
      const Sensitive x = series.position(k)(1, c);
      EXPECT_THAT(x[1], IsCloseTo(x[0])) << "order " << k;
    }
}

TEST(Sensitivity, OfAnOrbitTurnsWithIt) {  // the second derivative of a rotation by s: x'' = -x
  using Twice = Jet<double, 2>;            // value, derivative, half the second derivative
  const auto turned = [](double a, double b) { return Twice::from({a, -b, -a / 2}); };
  const Kepler<Twice> rotated{{turned(orbit.x[0], orbit.x[1]), turned(orbit.x[1], -orbit.x[0])},
                              {turned(orbit.v[0], orbit.v[1]), turned(orbit.v[1], -orbit.v[0])},
                              orbit.gm};
  const auto series = expansion(rotated);
  for (int k = 0; k <= degree; ++k) {
    const Twice x = series.position(k)(1, 0), y = series.position(k)(1, 1);
    // about 20 rounded operations of order k each, on numbers of the size of the coefficient: below 1e-13 of it
    const double allowed = 1e-13 * (std::abs(x[0]) + std::abs(y[0]));
    EXPECT_NEAR(x[1], -y[0], allowed);
    EXPECT_NEAR(y[1], x[0], allowed);
    EXPECT_NEAR(x[2], -x[0] / 2, allowed);
    EXPECT_NEAR(y[2], -y[0] / 2, allowed);
  }
}

}  // namespace
}  // namespace jetlag::testing::sensitivity_test
