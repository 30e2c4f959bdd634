// SPDX-License-Identifier: MIT
// A look at the next state: the series that begins there is the one that a start from there would find, and how its first forces
// depart from the series at hand is in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "jetlag/forces/drag.hpp"
#include "jetlag/motion/expansion.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::look_ahead_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Springs, friction, a force that depends on the time.
Problem shaken() {
  Problem scene = spring_cube(3);
  for (int i = 0; i < 8; ++i) {
    scene.system.add<Drag>({{i}}, {{0.25}});
    scene.system.add<problems::Shaker>({{i}}, {{3.0}});
  }
  return scene;
}
State<double> moved(State<double> state, double by) {
  state.time += by;
  state.position += by * state.velocity;
  state.velocity *= 1 - by;
  return state;
}
void expect_same_bits(const Expansion<double>& a, const Expansion<double>& b) {
  ASSERT_EQ(a.order(), b.order());
  for (int k = 0; k <= a.order(); ++k) EXPECT_EQ(a.position(k), b.position(k)) << "order " << k;
  for (int k = 0; k < a.order(); ++k) EXPECT_EQ(a.velocity(k), b.velocity(k)) << "order " << k;
}

TEST(LookAhead, IsAStartFromThere) {
  for (const Problem& scene : {shaken(), spring_cube(3)})
    for (int order : {2, 3}) {
      const State<double> next = moved(scene.start, 0.01);
      Expansion<double> series(scene.system), fresh(scene.system);
      series.start(scene.start);
      series.grow_to(8);
      series.look_ahead(next, order);
      series.start(next);
      EXPECT_EQ(series.order(), order);
      series.grow_to(12);
      fresh.start(next);
      fresh.grow_to(12);
      expect_same_bits(series, fresh);
    }
}

TEST(LookAhead, LeavesTheSeriesAtHand) {
  const Problem scene = shaken();
  Expansion<double> series(scene.system), fresh(scene.system);
  for (Expansion<double>* each : {&series, &fresh}) {
    each->start(scene.start);
    each->grow_to(8);
  }
  series.look_ahead(moved(scene.start, 0.01), 3);
  expect_same_bits(series, fresh);
  series.grow_to(8);                                  // nothing to do
  EXPECT_THROW(series.grow_to(9), std::logic_error);  // the elements are ahead
}

TEST(LookAhead, IsForgottenByAStartFromElsewhere) {
  const Problem scene = shaken();
  const State<double> next = moved(scene.start, 0.01);
  std::vector<State<double>> others(4, next);
  others[0].time += 1e-9;  // the shaker depends on it
  others[1].position(3, 1) += 1e-9;
  others[2].velocity(7, 2) += 1e-9;
  others[3].position_rest = 1e-20 * Coordinates<double>::Ones(8, 3);
  for (const State<double>& other : others) {
    Expansion<double> series(scene.system), fresh(scene.system);
    series.start(scene.start);
    series.look_ahead(next, 3);
    series.start(other);
    EXPECT_EQ(series.order(), 1);
    series.grow_to(6);
    fresh.start(other);
    fresh.grow_to(6);
    expect_same_bits(series, fresh);
  }
  Expansion<double> series(scene.system);
  series.start(scene.start);
  series.look_ahead(next, 3);
  series.start(next, 0.5);  // in another unit of time
  EXPECT_EQ(series.order(), 1);
}

TEST(LookAhead, IsNeitherUsedNorCountedAfterItIsForgotten) {
  const Problem scene = shaken();
  const State<double> next = moved(scene.start, 0.01);
  Expansion<double> series(scene.system);
  series.start(scene.start);
  series.grow_to(8);
  const std::size_t before = series.element_coefficients();
  series.look_ahead(next, 3);
  series.forget_ahead();
  EXPECT_THROW(series.grow_to(9), std::logic_error);  // the elements are ahead all the same
  series.start(next);
  EXPECT_EQ(series.order(), 1);
  EXPECT_EQ(series.element_coefficients(), before);
}

TEST(LookAhead, IsForgottenByAnotherEpoch) {  // without its one spring nobody is pulled
  const Problem scene = dumbbell(1.0, 1.0, 1.0);
  State<double> next = scene.start;
  next.position *= 1.5;
  const Model<double> bound(scene.system), free = bound.with(0, {}, {});
  Expansion<double> series(bound);
  series.start(scene.start);
  series.look_ahead(next, 3);
  series.move_to(free);
  series.start(next);
  series.grow_to(3);
  EXPECT_TRUE(series.position(2).isZero(0.0));
}

TEST(LookAhead, DepartsWithoutEndWhereTheForceIsNone) {  // the ends of a spring in one place
  const Problem scene = dumbbell(1.0, 1.0, 1.0);
  State<double> meeting = scene.start;
  meeting.position.setZero();
  const std::vector<double> ones(3, 1.0);
  Expansion<double> series(scene.system);
  series.start(scene.start);
  series.grow_to(3);
  series.look_ahead(meeting, 2);
  Expansion<double>::Departure departure;
  series.take_departure(2, ones.data(), 0.1, 0, 2, departure);
  EXPECT_EQ(departure.force, std::numeric_limits<double>::infinity());
}

TEST(LookAhead,
     IsWorkOfTheNextStart) {  // elements x orders, as if the series had been started one after the other
  const Problem scene = shaken();
  Expansion<double> series(scene.system), fresh(scene.system);
  const State<double> next = moved(scene.start, 0.01);
  series.start(scene.start);
  series.grow_to(8);
  const std::size_t before = series.element_coefficients();
  series.look_ahead(next, 3);
  EXPECT_EQ(series.element_coefficients(), before);
  series.start(next);
  series.grow_to(8);
  fresh.start(scene.start);
  fresh.grow_to(8);
  fresh.start(next);
  fresh.grow_to(8);
  EXPECT_EQ(series.element_coefficients(), fresh.element_coefficients());
}

/// Of x'' = -x from x = 1, v = 0, stopped after x_N s^N:  a - x'' = -sum_{n<=N} x_n s^n - sum_{2<=n<=N} n (n-1) x_n s^(n-2), where
/// n (n-1) x_n = -x_(n-2): what is left is  -x_(N-1) s^(N-1) - x_N s^N.
TEST(LookAhead, DepartsByTheTermsThatAreLeftOut) {
  const Problem scene = oscillator();
  for (double unit : {1.0, 0.25})
    for (int degree : {3, 6, 9}) {
      const double h = 0.75, s = h / unit;
      Expansion<double> series(scene.system);
      series.start(scene.start, unit);
      series.grow_to(degree + 1);
      const std::vector<double> ones(degree + 1, 1.0);
      State<double> end = scene.start;
      end.time = h;
      series.position_sum(0, degree, ones.data(), s, end.position);
      series.velocity_sum(0, degree, ones.data(), s, end.velocity);
      series.look_ahead(end, 2);
      Expansion<double>::Departure departure;
      series.take_departure(degree, ones.data(), s, 0, 1, departure);
      const int even = degree % 2 == 0 ? degree : degree - 1;  // the other one vanishes
      EXPECT_NEAR(departure.force, unit * unit * std::pow(h, even) / std::tgamma(even + 1), 16 * eps);
      EXPECT_EQ(departure.position, 1.0);
      EXPECT_EQ(departure.velocity[0], 0.0);
      EXPECT_NEAR(departure.velocity[1], unit * std::abs(end.velocity(0, 0)), eps);
      EXPECT_NEAR(departure.acceleration[0], unit * unit, eps);
      EXPECT_NEAR(departure.acceleration[1], unit * unit * end.position(0, 0), eps);
    }
}

/// The sums of a step, taken at once, are those taken one by one, and so is the departure from the forces at its end: bits. 25
/// particles in space fill more than one batch of rows, an oscillator is a number.
TEST(LookAhead, DepartsFromSumsTakenAtOnceAsFromEachAlone) {
  const int degree = 6;
  const std::vector<double> weights{1, 1, 1, 1.5, 2, 4, 8};
  for (const Problem& scene : {problems::cloth(5), oscillator(1.0, 0.5, 0.5)}) {
    const double s = 0.01;
    Expansion<double> series(scene.system);
    series.start(scene.start);
    series.grow_to(degree + 1);
    State<double> end = scene.start;
    Coordinates<double> position, velocity;
    AlignedVector<double> leads_to;
    EXPECT_TRUE(series.motion_sum(degree, weights.data(), s, end.position, end.velocity, leads_to));
    series.position_sum(0, degree, weights.data(), s, position);
    series.velocity_sum(0, degree, weights.data(), s, velocity);
    EXPECT_EQ(end.position, position);
    EXPECT_EQ(end.velocity, velocity);
    series.look_ahead(end, 2);
    const int particles = scene.system.particles();
    for (const auto& [first, last] : {std::pair(0, particles), std::pair(particles - 1, particles)}) {
      Expansion<double>::Departure together, alone;
      series.take_departure(leads_to, first, last, together);
      series.take_departure(degree, weights.data(), s, first, last, alone);
      EXPECT_EQ(together.force, alone.force);
      EXPECT_EQ(together.position, alone.position);
      EXPECT_EQ(together.velocity[1], alone.velocity[1]);
      EXPECT_EQ(together.acceleration[0], alone.acceleration[0]);
    }
  }
}

}  // namespace
}  // namespace jetlag::testing::look_ahead_test
