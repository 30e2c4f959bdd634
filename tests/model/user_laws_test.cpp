// SPDX-License-Identifier: MIT
// Laws of users' own: components of different kinds, exponents that are parameters; states that do not fit.
#include <gtest/gtest.h>

#include <cmath>

#include "jetlag/forces/forces.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/motion/first_order.hpp"

namespace jetlag::testing {
namespace {

State<> state_of(const Coordinates<>& position, const Coordinates<>& velocity) {
  return {0.0, position, velocity};
}

/// F = (g, ..., -y), y the last coordinate: one component without a series beside one that has one.
struct Mixed {
  static constexpr const char* name = "mixed";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"g"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& g) {
    Vector<T, D> f = Vector<T, D>::Constant(g);
    f[D - 1] = -p.position[0][D - 1];
    return f;
  }
};

TEST(UserLaw, WithAConstantComponentFallsAlongItAndSwingsAlongTheOther) {  // x = g t^2 / 2, y = cos t
  System<> system(2, {1.0});
  system.add<Mixed>({{0}}, {{3.0}});
  for (const auto* table : available_kernels()) {
    Expansion<> series(system, 8, *table);
    series.start(state_of(Coordinates<>{{0.0, 1.0}}, Coordinates<>{{0.0, 0.0}}));
    series.grow_to(8);
    double factorial = 1;
    for (int k = 0; k <= 8; ++k) {
      if (k > 0) factorial *= k;
      EXPECT_EQ(series.position(k)(0, 0), k == 2 ? 1.5 : 0.0) << k;
      const double cosine = k % 2 == 1 ? 0.0 : (k % 4 == 0 ? 1.0 : -1.0) / factorial;
      EXPECT_NEAR(series.position(k)(0, 1), cosine, 8 * 0x1p-53 * std::abs(cosine))
          << k;  // a rounding an order
    }
  }
}

TEST(UserLaw,
     MayBeALambdaWithWhatItCaptures) {  // m x'' = -m w^2 x + F: x = a + (x_0 - a) cos(w t), a = F / (m w^2)
  const std::vector<double> mass{0.5, 2.0};
  for (const double w : {1.5, 0.75}) {  // what has been captured at one time does not come back at another
    const double pull = 3.0;
    System<> system(1, mass);
    system.add<1>("tether",
                  [=](const auto& p) {
                    auto f = p.position[0];
                    f[0] = pull - p.mass[0] * (w * w) * p.position[0][0];
                    return f;
                  },
                  {1, 0});
    EXPECT_EQ(system.elements().front().law.name, "tether");
    Expansion<> series(system, 10);
    series.start(state_of(Coordinates<>{{1.0}, {-0.25}}, Coordinates<>{{0.0}, {0.0}}));
    series.grow_to(10);
    for (int i = 0; i < 2; ++i) {
      const double a = pull / (mass[i] * w * w);
      double term = (i == 0 ? 1.0 : -0.25) - a;  // (x_0 - a) (-w^2)^n / (2n)!
      for (int k = 2; k <= 10; k += 2) {
        term *= -w * w / (k * (k - 1));
        EXPECT_NEAR(series.position(k)(i, 0), term, 4 * k * 0x1p-53 * std::abs(term))
            << k;  // some two roundings an order, and up to 1.6 of what cancels in x_0 - a
        EXPECT_EQ(series.position(k - 1)(i, 0), 0.0) << k;
      }
    }
  }
}

TEST(UserLaw, OfALambdaIsRefusedWhereItDoesNotFit) {
  System<> system(2, {1.0});
  const auto force = [](const auto& p) { return (-p.position[0]).eval(); };
  EXPECT_THROW(system.add<2>("push", force, {1}), std::invalid_argument);
  EXPECT_THROW(system.add<3>("push", force, {0}), std::invalid_argument) << "another dimension";
  EXPECT_TRUE(system.elements().empty());
}

TEST(UserLaw, OfFirstOrderMayHaveAConstantComponent) {  // y' = (2, y_1): 2 t and e^t
  FirstOrderExpansion<> series([](const auto& t, const auto& y) { return std::array{2.0 + 0.0 * t, y[1]}; },
                               2);
  series.start(0.0, {0.0, 1.0});
  series.grow_to(4);
  EXPECT_EQ(series[0], (std::vector<double>{0, 2, 0, 0, 0}));
  EXPECT_NEAR(series[1][4], 1.0 / 24, 0x1p-55);
}

/// F = -x |x|^(a-1) with the exponent as a parameter of the element.
struct PowerSpring {
  static constexpr const char* name = "power_spring";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"exponent"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& exponent) {
    using std::pow;
    return Vector<T, D>::Constant(-pow(p.position[0][0], exponent));
  }
};

TEST(
    UserLaw,
    MayHaveAParameterAsExponent) {  // x'' = -x^a from x = 1: x_2 = -1/2, x_4 = a/24, for each element's own a
  System<> system(1, {1.0, 1.0});
  system.add<PowerSpring>({{0}, {1}}, {{2.5}, {0.5}});
  Expansion<> series(system);
  series.start(state_of(Coordinates<>{{1.0}, {1.0}}, Coordinates<>{{0.0}, {0.0}}));
  series.grow_to(4);
  EXPECT_EQ(series.position(2)(0, 0), -0.5);
  EXPECT_NEAR(series.position(4)(0, 0), 2.5 / 24, 4 * 0x1p-56);
  EXPECT_NEAR(series.position(4)(1, 0), 0.5 / 24, 4 * 0x1p-58);
}

TEST(State, OfAnotherShapeIsRefused) {
  const System<> system(2, {1.0, 1.0});
  Expansion<> series(system);
  EnergyMeter energy(system);
  const State<> one = state_of(Coordinates<>{{0.0, 0.0}}, Coordinates<>{{0.0, 0.0}});
  EXPECT_THROW(series.start(one), std::invalid_argument);
  EXPECT_THROW(energy(one), std::invalid_argument);
}

TEST(State, OfAFixedParticleThatMovesIsRefused) {
  System<> system(1, {1.0});
  system.fix(0);
  Expansion<> series(system);
  EXPECT_THROW(series.start(state_of(Coordinates<>{{0.0}}, Coordinates<>{{2.0}})), std::invalid_argument);
  series.start(state_of(Coordinates<>{{0.0}}, Coordinates<>{{0.0}}));
}

TEST(State, OfFirstOrderComesBeforeItsSeries) {
  FirstOrderExpansion<> series([](const auto&, const auto& y) { return std::array{y[0]}; }, 1);
  EXPECT_THROW(series.grow(), std::logic_error);
}

TEST(System, RefusesAMassWithoutAReciprocal) { EXPECT_THROW(System<>(1, {1e-310}), std::invalid_argument); }

}  // namespace
}  // namespace jetlag::testing
