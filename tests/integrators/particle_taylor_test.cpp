// SPDX-License-Identifier: MIT
// Particles in any number type, against closed forms: Kepler's ellipse, a chain of springs; how runs end.
#include "jetlag/integrators/particle_taylor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "integrators/changes/singular_laws.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/forces/spring.hpp"
#include "support/digits50.hpp"
#include "support/engine_of_numbers.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {
namespace {

/// A planet of eccentricity 1/2 at its perihelion, the sun held at the focus: a = 1, G M = 1.
template <class T>
System<T> sun_and_planet() {
  System<T> system(2, {T(1), T(1)});
  system.fix(0);
  system.template add<Gravity>({{0, 1}}, {{T(1)}});
  return system;
}
template <class T>
State<T> at_perihelion() {
  using std::sqrt;
  State<T> state{T(0), Coordinates<T>::Constant(2, 2, T(0)), Coordinates<T>::Constant(2, 2, T(0))};
  state.position(1, 0) = T(1) / T(2);
  state.velocity(1, 1) = sqrt(T(3));
  return state;
}

/// Where the planet is at a time:   M = E - sin(E) / 2,  x = cos E - 1/2,  y = sqrt(3/4) sin E, by Newton's method.
template <class T>
std::array<T, 2> on_ellipse(const T& mean_anomaly) {
  using std::cos, std::sin, std::sqrt;
  T e = mean_anomaly;
  for (int i = 0; i < 60; ++i) e -= (e - sin(e) / 2 - mean_anomaly) / (1 - cos(e) / 2);
  return {T(cos(e) - T(1) / 2), T(sqrt(T(3) / 4) * sin(e))};
}

template <class T>
T distance(const Coordinates<T>& a, const Coordinates<T>& b) {
  using std::abs;
  T most(0);
  for (Eigen::Index i = 0; i < a.size(); ++i)
    if (const T d = abs(T(a.data()[i] - b.data()[i])); most < d) most = d;
  return most;
}

TEST(ParticleTaylor, ReturnsToThePerihelionIn50Digits) {
  // Rounding is 5e-51 of numbers below 2. An error of the energy of that size in each of some 30 steps delays the planet by
  // 3 pi a for each period, at a speed of 1.7: 30 x 9.4 x 1.7 x 1e-50 = 5e-48; the terms left out are as small.
  ParticleTaylor<Digits50> method(sun_and_planet<Digits50>());
  State<Digits50> state = at_perihelion<Digits50>();
  const State<Digits50> start = state;
  const Digits50 period = boost::math::constants::two_pi<Digits50>();
  ASSERT_EQ(method.run(state, period).outcome, Outcome::success);
  EXPECT_EQ(state.time, period);
  EXPECT_LT(distance(state.position, start.position), Digits50("1e-47"));
  EXPECT_LT(distance(state.velocity, start.velocity), Digits50("1e-47"));
  EXPECT_LT(method.work().steps, 60u);
}

TEST(ParticleTaylor, IsOnTheEllipseAtAnyTimeIn50Digits) {
  ParticleTaylor<Digits50> method(sun_and_planet<Digits50>());
  State<Digits50> state = at_perihelion<Digits50>();
  Digits50 worst = 0;
  ASSERT_EQ(method
                .run(state, Digits50(4),
                     {.max_steps = 100,
                      .after_step =
                          [&](const auto& view) {
                            const Digits50 t = (view.begin + 2 * view.state.time) / 3;
                            const State<Digits50> within = view.integrator.at(t);
                            const auto [x, y] = on_ellipse(t);
                            worst = std::max({worst, Digits50(abs(Digits50(within.position(1, 0) - x))),
                                              Digits50(abs(Digits50(within.position(1, 1) - y)))});
                            return true;
                          }})
                .outcome,
            Outcome::success);
  EXPECT_LT(worst, Digits50("1e-47"));  // as above
}

/// How far the planet is from the ellipse after ten revolutions, at a time that every type has.
template <class T>
double error_after_ten_revolutions() {
  constexpr double until = 62.83185307179586;
  ParticleTaylor<T> method(sun_and_planet<T>());
  State<T> state = at_perihelion<T>();
  EXPECT_EQ(method.run(state, T(until)).outcome, Outcome::success);
  const auto [x, y] = on_ellipse(Digits50(until));
  const Digits50 dx = Digits50(state.position(1, 0)) - x, dy = Digits50(state.position(1, 1)) - y;
  return static_cast<double>(sqrt(Digits50(dx * dx + dy * dy)));
}

TEST(ParticleTaylor,
     IsBetterByTheRatioOfTheRoundings) {  // 2^-11 of 80 bits; walks of rounding differ by some 8
  const double in_double = error_after_ten_revolutions<double>(),
               in_80_bits = error_after_ten_revolutions<long double>();
  // sqrt(300) roundings of the energy of eps / 2, each a delay of 3 pi for every revolution to come, at a speed of 1.7.
  EXPECT_LT(in_double, 10 * std::sqrt(300.0) * 1.1e-16 * 3 * 3.15 * 10 * 1.7);
  EXPECT_LT(in_80_bits, 8 * 0x1p-11 * in_double);
}

/// n masses of 1 on a line between two walls, springs of stiffness 1 at rest: u_j = sin(k pi j / (n + 1)) cos(w_k t) with
/// w_k = 2 sin(k pi / (2 (n + 1))) are its modes. The sum of the first and the third one, of size 1/8: springs do not
/// collapse, and are linear.
template <class T>
struct ChainOfSprings {
  static constexpr int n = 5;
  System<T> system{1, std::vector<T>(n + 2, T(1))};

  ChainOfSprings() {
    std::vector<std::array<int, 2>> pairs;
    for (int j = 0; j <= n; ++j) pairs.push_back({j, j + 1});
    system.fix(0);
    system.fix(n + 1);
    system.template add<Spring>(pairs, {{T(1), T(1)}});
  }
  State<T> at(const T& t) const {
    using std::cos, std::sin;
    State<T> state{t, Coordinates<T>::Constant(n + 2, 1, T(0)), Coordinates<T>::Constant(n + 2, 1, T(0))};
    const T pi = boost::math::constants::pi<T>();
    for (int j = 0; j <= n + 1; ++j) {
      state.position(j, 0) = T(j);
      if (j == 0 || j == n + 1) continue;
      for (int k : {1, 3}) {
        const T w = 2 * sin(T(k * pi / (2 * (n + 1)))), shape = sin(T(k * j * pi / (n + 1))) / 8;
        state.position(j, 0) += shape * cos(T(w * t));
        state.velocity(j, 0) -= shape * w * sin(T(w * t));
      }
    }
    return state;
  }
};

template <class T>
T error_of_chain(double until) {
  const ChainOfSprings<T> chain;
  ParticleTaylor<T> method(chain.system);
  State<T> state = chain.at(T(0));
  EXPECT_EQ(method.run(state, T(until)).outcome, Outcome::success);
  const State<T> expected = chain.at(T(until));
  return std::max(distance(state.position, expected.position), distance(state.velocity, expected.velocity));
}

TEST(ParticleTaylor, SwingsAsTheModesOfAChainOfSprings) {
  // Positions up to 6 are rounded by 3 eps at the start, forces are differences of them: some eps for each second.
  EXPECT_LT(error_of_chain<double>(10.0), 10 * 10 * 2.3e-16);
  EXPECT_LT(error_of_chain<long double>(10.0), 10 * 10 * 1.1e-19L);
  EXPECT_LT(error_of_chain<Digits50>(10.0), Digits50("1e-48"));
}

TEST(ParticleTaylor, RunsBackwards) {
  ParticleTaylor<> method(sun_and_planet<double>());
  const State<double> start = at_perihelion<double>();
  State<double> state = start;
  EXPECT_EQ(method.run(state, 3.0).outcome, Outcome::success);
  EXPECT_EQ(method.run(state, 0.0).outcome, Outcome::success);
  EXPECT_EQ(state.time, 0.0);
  EXPECT_LT(distance(state.position, start.position), 1e-14);
}

TEST(ParticleTaylor, TakesStepsOfAGivenLength) {
  ParticleTaylor<> method(sun_and_planet<double>(), {.degree = 12, .step = 0x1p-6});
  State<double> state = at_perihelion<double>();
  EXPECT_EQ(method.run(state, 1.0).outcome, Outcome::success);
  EXPECT_EQ(method.work().steps, 64u);
  EXPECT_EQ(method.work().coefficients, 64u * 12);  // order 13 for the velocities, of one planet
  EXPECT_EQ(method.work().degrees, 64u * 12);
}

TEST(ParticleTaylor, LosesLessToRoundingWithItsStateCompensated) {
  // Some 8192 roundings of 1, or of the increments of 1/100; what they add up to is chance, so that runs of eight lengths of steps
  // are taken together.
  const auto [x, y] = on_ellipse(Digits50(64));
  const auto error = [x = static_cast<double>(x), y = static_cast<double>(y)](bool compensated) {
    double squares = 0;
    for (int j = 0; j < 8; ++j) {
      ParticleTaylor<> method(sun_and_planet<double>(),
                              {.compensated = compensated, .step = 1.0 / (128 + j)});
      State<double> state = at_perihelion<double>();
      EXPECT_EQ(method.run(state, 64.0).outcome, Outcome::success);
      squares += std::pow(state.position(1, 0) - x, 2) + std::pow(state.position(1, 1) - y, 2);
    }
    return std::sqrt(squares / 8);
  };
  EXPECT_LT(error(true), error(false) / 4);
}

TEST(ParticleTaylor, SaysWhichParticleIsAtASingularPoint) {
  ParticleTaylor<> method(sun_and_planet<double>());
  State<double> state = at_perihelion<double>();
  state.position(1, 0) = 0;  // in the sun
  const State<double> before = state;
  const Report report = method.run(state, 1.0);
  EXPECT_EQ(report.outcome, Outcome::non_finite);
  EXPECT_EQ(report.particle, 0);  // the first one whose force is not a number
  EXPECT_EQ(state.position, before.position);
}

TEST(ParticleTaylor, GoesOnFromWhereItFailedBySoManyOrdersAsAreKnown) {
  // A step of 2^-10 s does not change the time 2^60 s, nothing is grown for it: the series has orders 0 and 1.
  ParticleTaylor<long double> method(sun_and_planet<long double>(), {.step = 0x1p-10});
  State<long double> state = at_perihelion<long double>();
  state.time = 0x1p60L;
  EXPECT_EQ(method.run(state, 0x1p61L).outcome, Outcome::step_underflow);
  EXPECT_EQ(method.at(0x1p60L).position, state.position);
  EXPECT_EQ(method.at(0x1p60L).velocity, state.velocity);
}

TEST(ParticleTaylor, RefusesWhatItCannotDo) {
  const auto system = sun_and_planet<double>();
  EXPECT_THROW(ParticleTaylor<>(system, {.degree = 1}), std::invalid_argument);
  EXPECT_THROW(ParticleTaylor<>(system, {.max_step = 0.0}), std::invalid_argument);
  EXPECT_THROW(ParticleTaylor<>(system, {.step = -1.0}), std::invalid_argument);
  ParticleTaylor<> method(system);
  State<double> state = at_perihelion<double>();
  EXPECT_THROW(method.run(state, std::numeric_limits<double>::infinity()), std::invalid_argument);
}

// ---- the forces at the end of a step -------------------------------------------------------------------------

template <class T>
void expect_no_jump_passed_over() {
  System<T> system(1, {T(1)});
  system.template add<singular_laws::Sawtooth>({{0}}, {std::array<T, 0>{}});
  for (const double until : {3.3, 5.0}) {
    ParticleTaylor<T> method(system);
    State<T> state{T(0), Coordinates<T>::Constant(1, 1, T(0)), Coordinates<T>::Constant(1, 1, T(0))};
    ASSERT_EQ(method.run(state, T(until)).outcome, Outcome::success);
    // Steps that are short enough to pass over the jump depart by 2^16 eps of x, and move v by as much of itself.
    const double past = until - M_PI, v = M_PI * M_PI / 2 + past * past / 2 - M_PI * past;
    EXPECT_NEAR(static_cast<double>(state.velocity(0, 0)), v, 1e-8) << until;
    EXPECT_GT(method.work().rejected, 0u);
  }
}
TEST(ParticleTaylor, PassesOverNoJumpOfWhichTheTapeKnowsNothing) {
  expect_no_jump_passed_over<double>();
  expect_no_jump_passed_over<long double>();
}

TEST(ParticleTaylor, LetsNoMassesFallThroughEachOther) {  // at rest 2 m apart: they meet after pi / sqrt 2
  for (const bool backwards : {false, true}) {
    System<> system(1, {1.0, 1.0});
    system.add<Gravity>({{0, 1}}, {{1.0}});
    State<> state{0.0, Coordinates<>{{-1}, {1}}, Coordinates<>{{0}, {0}}};
    ParticleTaylor<> method(system);
    EXPECT_NE(method.run(state, backwards ? -3 : 3).outcome, Outcome::success);
    EXPECT_NEAR(std::abs(state.time), M_PI / std::sqrt(2.0), 1e-3);
  }
}

template <class T>
void expect_none_rejected() {
  for (const int degree : {6, 12, degree_of_precision<T>()})
    for (const bool compensated : {false, true}) {
      ParticleTaylor<T> method(sun_and_planet<T>(), {.degree = degree, .compensated = compensated});
      State<T> state = at_perihelion<T>();
      ASSERT_EQ(method.run(state, T(20)).outcome, Outcome::success);
      EXPECT_EQ(method.work().rejected, 0u) << degree;
      // A look at the end of a step is the start of the next one.
      EXPECT_EQ(method.work().element_coefficients, method.work().steps * degree) << degree;
    }
}
TEST(ParticleTaylor, RejectsNoSmoothStepAndComputesNothingTwice) {
  expect_none_rejected<double>();
  expect_none_rejected<long double>();
  expect_none_rejected<Digits50>();
}

}  // namespace
}  // namespace jetlag::testing
