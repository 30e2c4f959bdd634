// SPDX-License-Identifier: MIT
// The series of single particles: under laws of the user, under none, and where a force does not exist.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "jetlag/forces/spring.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/motion/first_order.hpp"
#include "problems/laws.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"
#include "support/engine_of_numbers.hpp"

namespace jetlag::testing::expansion_of_laws_test {
namespace {

/// A push that depends on the time only: F = cos(t) along every axis.
struct Shaker {
  static constexpr const char* name = "shaker";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    using std::cos;
    return Vector<T, D>::Constant(cos(p.time));
  }
};

TEST(Expansion, OfSecondOrderIsTheFirstOrderSystem) {
  // x'' = -sin x against (x, v)' = (v, -sin x): the same recurrence, divided in another order
  using Number = RunningError<double>;
  System<Number> system(1, {1.0});
  system.add<problems::SineOfAngle>({{0}}, {});
  Expansion<Number> second(system);
  second.start({0.0, Coordinates<Number>::Constant(1, 1, 1.3), Coordinates<Number>::Constant(1, 1, -0.4)});
  second.grow_to(20);
  FirstOrderExpansion<Number> first([](const auto&, const auto& y) { return std::array{y[1], -sin(y[0])}; },
                                    2);
  first.start(0.0, {1.3, -0.4});
  first.grow_to(20);
  EXPECT_THAT(first[0], HasCoefficients([&](int k) { return second.position(k)(0, 0); }));
}

TEST(Expansion, KnowsTheTimeAtWhichItStarts) {  // x'' = cos t from t = 0.7:  x = -cos t + ..., by derivatives
  using Number = RunningError<double>;
  System<Number> system(2, {1.0});
  system.add<Shaker>({{0}}, {});
  Expansion<Number> series(system);
  series.start({0.7, Coordinates<Number>::Constant(1, 2, 0.0), Coordinates<Number>::Constant(1, 2, 0.0)});
  series.grow_to(14);
  std::vector<Number> x;
  for (int k = 0; k <= 14; ++k) x.push_back(series.position(k)(0, 1));
  Digits50 factorial = 1;
  EXPECT_THAT(x, HasCoefficients([&](int k) {
                factorial *= std::max(k, 1);
                const Digits50 t = 0.7;
                const Digits50 derivatives[] = {-cos(t), sin(t), cos(t), -sin(t)};  // of -cos t
                return k < 2 ? Digits50(0) : Digits50(derivatives[k % 4] / factorial);
              }));
}

TEST(Expansion, OfNothingIsFreeMotion) {
  System<> system(2, {1.0, 1.0});
  State<> state{0.0, Coordinates<>::Constant(2, 2, 3.0), Coordinates<>::Constant(2, 2, -2.0)};
  Expansion<> series(system);
  series.start(state);
  series.grow_to(5);
  EXPECT_EQ(series.element_coefficients(), 0u);
  EXPECT_TRUE(series.position(1) == state.velocity);
  for (int k = 2; k <= 5; ++k) EXPECT_TRUE(series.position(k).isZero(0));
}

TEST(Expansion, IsNotFiniteWhereParticlesCoincide) {
  System<> system(2, {1.0, 1.0, 1.0});
  system.add<Spring>({{0, 1}}, {{1.0, 1.0}});
  State<> state{0.0, Coordinates<>::Zero(3, 2), Coordinates<>::Zero(3, 2)};
  state.position(2, 0) = 1.0;
  Expansion<> series(system);
  series.start(state);
  series.grow_to(3);
  EXPECT_FALSE(series.position(2).row(0).allFinite());
  EXPECT_TRUE(series.position(3).row(2).isZero(0));  // the third is not concerned
}

}  // namespace
}  // namespace jetlag::testing::expansion_of_laws_test
