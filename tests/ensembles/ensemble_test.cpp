// SPDX-License-Identifier: MIT
// An ensemble is many runs of Taylor's method at once: the same trajectories, each on its own.
#include "jetlag/ensembles/ensemble.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/integrators/taylor.hpp"

namespace jetlag::testing::ensemble_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Two bodies, the light one on an ellipse in the plane x, y.
System<double> two_bodies() {
  System<double> system(2, {1.0, 0.25});
  system.add<Gravity>({{0, 1}}, {{1.0}});
  return system;
}

/// Trajectory i starts at the distance 1 with a velocity of its own: eccentricities 0.02 ... 0.5.
std::vector<State<double>> orbits(int count) {
  std::vector<State<double>> states;
  for (int i = 0; i < count; ++i) {
    State<double> state{0.125 * (i % 3), Coordinates<double>::Zero(2, 2), Coordinates<double>::Zero(2, 2)};
    state.position(1, 0) = 1;
    state.velocity(1, 1) = 0.8 + 0.3 * i / count;
    states.push_back(state);
  }
  return states;
}

/// Everything at once: springs, drag, a field, a particle that is held.
System<double> chain() {
  System<double> system(3, {1.0, 0.5, 2.0, 1.5});
  system.add<Spring>({{0, 1}, {1, 2}, {3, 2}}, {{4.0, 0.9}, {3.0, 0.8}, {2.0, 1.1}});
  system.add<Drag>({{1}, {2}}, {{0.3}, {0.2}});
  system.add<UniformField>({{1}, {2}, {3}}, {{0.0, -1.0, 0.5}});
  system.fix(0);
  return system;
}
std::vector<State<double>> hanging(int count) {
  std::vector<State<double>> states;
  for (int i = 0; i < count; ++i) {
    State<double> state{0.0, Coordinates<double>::Zero(4, 3), Coordinates<double>::Zero(4, 3)};
    for (int p = 0; p < 4; ++p) state.position.row(p) << p, 0.1 * p * p, 0.01 * i;
    state.velocity(2, 1) = 0.01 * i;
    states.push_back(state);
  }
  return states;
}

/// The pull of a spring whose end goes round: reads the time through sin and cos, which are coupled.
struct Stirred {
  static constexpr const char* name = "stirred";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"frequency"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& frequency) {
    using std::cos, std::sin;
    Vector<T, D> f = T(-p.mass[0]) * p.position[0];
    f[0] = f[0] + cos(T(frequency * p.time));
    f[1] = f[1] + sin(T(frequency * p.time));
    return f;
  }
};

State<double> alone(const System<double>& system, int degree, State<double> state, double until,
                    double max_step = infinity) {
  const auto method = taylor(system, degree, std::make_unique<JorbaZou>(max_step));
  Report report;
  while (state.time < until) {
    const double limit = until - state.time, h = method->step(state, limit, report);
    if (h == 0) {
      ADD_FAILURE() << report.message;
      break;
    }
    state.time = h == limit ? until : state.time + h;
  }
  return state;
}

void expect_same_bits(const State<double>& a, const State<double>& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.velocity, b.velocity);
}

/// Both round differently in each of some 30 steps, by a few 1e-16 of numbers near 1; a difference d grows to at most
/// some 6 pi e d per unit of time on a Kepler orbit of period <= 10, one and a half periods here: 30 x 3e-16 x 60 < 1e-12.
void expect_taylor(const System<double>& system, const std::vector<State<double>>& states, double until,
                   double max_step = infinity) {
  Ensemble ensemble(system, 20, states, max_step);
  ensemble.advance_to(until);
  for (std::size_t i = 0; i < states.size(); i += 7) {
    const State<double> expected = alone(system, 20, states[i], until, max_step), state = ensemble.state(i);
    EXPECT_EQ(ensemble.outcome(i), Outcome::success);
    EXPECT_EQ(state.time, until);
    EXPECT_LT((state.position - expected.position).cwiseAbs().maxCoeff(), 1e-12) << i;
    EXPECT_LT((state.velocity - expected.velocity).cwiseAbs().maxCoeff(), 1e-12) << i;
  }
}

TEST(Ensemble, IsTaylorsMethodOnEveryTrajectory) {
  expect_taylor(two_bodies(), orbits(1), 10.0);
  expect_taylor(two_bodies(), orbits(50), 10.0);
  expect_taylor(chain(), hanging(9), 5.0);
}

/// Three bodies in space, of which one is held. The inner one goes round 1.8 times, e = .22, and 30 steps of rounding grow
/// to some 30 x 3e-16 x 6 pi x 1.8 < 1e-12.
TEST(Ensemble, FollowsSeveralElementsOfOneLaw) {
  System<double> system(3, {2.0, 0.125, 0.0625});
  system.add<Gravity>({{1, 0}, {0, 2}, {2, 1}}, {{1.0}, {1.0}, {0.5}});
  system.fix(0);
  std::vector<State<double>> states;
  for (int i = 0; i < 19; ++i) {
    State<double> state{0.0, Coordinates<double>::Zero(3, 3), Coordinates<double>::Zero(3, 3)};
    state.position.row(1) << 1, 0, 0.01 * i;
    state.position.row(2) << 0, -2.5, 0.25;
    state.velocity.row(1) << 0, 1.25, 0.125;
    state.velocity.row(2) << 0.75, 0, 0.01 * i;
    states.push_back(state);
  }
  expect_taylor(system, states, 6.0);
}

TEST(Ensemble, FollowsLawsThatReadTheTime) {
  System<double> system(2, {2.0});
  system.add<Stirred>({{0}}, {{0.7}});
  std::vector<State<double>> states;
  for (int i = 0; i < 20; ++i)
    states.push_back({0.1 * i, Coordinates<double>::Constant(1, 2, 0.5), Coordinates<double>::Zero(1, 2)});
  expect_taylor(system, states, 5.0);
}

/// x(t) = g t^2 / 2 is a polynomial: one step of max_step each, and the last one shortened.
TEST(Ensemble, TakesTheLargestStepInFreeFall) {
  System<double> system(1, {2.0});
  system.add<UniformField>({{0}}, {{-2.0, 0.0, 0.0}});
  const State<double> rest{0.0, Coordinates<double>::Zero(1, 1), Coordinates<double>::Zero(1, 1)};
  Ensemble ensemble(system, 4, {rest, rest}, 0.75);
  ensemble.advance_to(2.0);
  EXPECT_EQ(ensemble.steps(0), 3u);
  EXPECT_EQ(ensemble.steps(), 6u);
  EXPECT_EQ(ensemble.element_coefficients(), 6u * 4u);
  EXPECT_EQ(ensemble.state(1).position(0, 0), -4.0);  // all numbers are short
  EXPECT_EQ(ensemble.state(1).velocity(0, 0), -4.0);
}

TEST(Ensemble, TakesTheStepsOfJorbaAndZou) {  // the step agrees to 1e-11, so the number of steps does
  const auto states = orbits(16);
  Ensemble ensemble(two_bodies(), 20, states);
  ensemble.advance_to(10.0);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto method = taylor(two_bodies(), 20, std::make_unique<JorbaZou>());
    State<double> state = states[i];
    Report report;
    while (state.time < 10.0) {
      const double h = method->step(state, 10.0 - state.time, report);
      ASSERT_GT(h, 0.0);
      state.time = h == 10.0 - state.time ? 10.0 : state.time + h;
    }
    EXPECT_EQ(ensemble.steps(i), method->work().steps) << i;
  }
}

/// Source: conservation. 60 steps of a few roundings of 1e-16 of an energy near 0.1 .. 0.3.
TEST(Ensemble, KeepsTheEnergyOfOrbits) {
  const auto system = two_bodies();
  const auto states = orbits(33);
  Ensemble ensemble(system, 20, states);
  ensemble.advance_to(30.0);
  const auto energy = [](const State<double>& s) {
    const double kinetic = 0.5 * (s.velocity.row(0).squaredNorm() + 0.25 * s.velocity.row(1).squaredNorm());
    return kinetic - 0.25 / (s.position.row(1) - s.position.row(0)).norm();
  };
  for (std::size_t i = 0; i < states.size(); ++i)
    EXPECT_NEAR(energy(ensemble.state(i)), energy(states[i]), 1e-14) << i;
}

TEST(Ensemble, HasTheSameBitsForAnyNumberOfThreads) {
  const auto states = orbits(150);
  Ensemble one(two_bodies(), 20, states);
  one.advance_to(6.0);
  for (const int threads : {2, 4}) {
    Ensemble several(two_bodies(), 20, states, infinity, Workers(threads));
    several.advance_to(6.0);
    for (std::size_t i = 0; i < states.size(); ++i) expect_same_bits(several.state(i), one.state(i));
  }
}

TEST(Ensemble, HasTheSameBitsInAnyCompany) {
  for (const KernelTable<double>* table : available_kernels()) {
    const auto states = orbits(40);
    Ensemble all(two_bodies(), 20, states, infinity, Workers(1), *table);
    all.advance_to(6.0);
    for (const std::size_t i : {0, 17, 39}) {
      Ensemble one(two_bodies(), 20, {states[i]}, infinity, Workers(1), *table);
      one.advance_to(6.0);
      expect_same_bits(one.state(0), all.state(i));
    }
  }
}

/// Released at rest the bodies meet at the distance 0; from the distance 0 there is no series at all.
TEST(Ensemble, LeavesOthersAloneWhereOneCollides) {
  auto states = orbits(40);
  Ensemble whole(two_bodies(), 20, states);
  whole.advance_to(6.0);
  states[3].velocity.setZero();
  states[20].position.setZero();
  Ensemble ensemble(two_bodies(), 20, states);
  ensemble.advance_to(6.0);
  ensemble.advance_to(7.0);
  Ensemble again(two_bodies(), 20, states);
  again.advance_to(6.0);
  for (std::size_t i = 0; i < states.size(); ++i)
    if (i != 3 && i != 20) {
      EXPECT_EQ(again.outcome(i), Outcome::success);
      expect_same_bits(again.state(i), whole.state(i));
    }
  EXPECT_EQ(ensemble.outcome(20), Outcome::non_finite);
  expect_same_bits(ensemble.state(20), states[20]);
  EXPECT_EQ(ensemble.steps(20), 0u);
  EXPECT_NE(ensemble.outcome(3), Outcome::success);
  EXPECT_TRUE(ensemble.state(3).position.allFinite());
  // Free fall from rest at the distance 1 with total mass 1.25 takes pi / (2 sqrt(2 x 1.25)) from t = 0.
  EXPECT_NEAR(ensemble.state(3).time, std::acos(-1.0) / (2 * std::sqrt(2.5)), 1e-6);
}

TEST(Ensemble, RefusesWhatMakesNoSense) {
  const auto states = orbits(2);
  EXPECT_THROW(Ensemble(two_bodies(), 0, states), std::invalid_argument);
  EXPECT_THROW(Ensemble(two_bodies(), 20, states, 0.0), std::invalid_argument);
  EXPECT_THROW(Ensemble(chain(), 20, states), std::invalid_argument);
  System<double> on_a_floor = two_bodies();
  on_a_floor.add<Floor>({{0}}, {{1.0, 0.0, 0.0, 1.0, 0.0}});
  EXPECT_THROW(Ensemble(on_a_floor, 20, states), std::invalid_argument);
  auto held = hanging(1);
  held[0].velocity(0, 0) = 1;
  EXPECT_THROW(Ensemble(chain(), 20, held), std::invalid_argument);
  Ensemble ensemble(two_bodies(), 20, states);
  EXPECT_THROW(ensemble.advance_to(std::nan("")), std::invalid_argument);
  EXPECT_THROW(ensemble.state(2), std::invalid_argument);
  Ensemble none(two_bodies(), 20, {});
  none.advance_to(1.0);
  EXPECT_EQ(none.steps(), 0u);
}

}  // namespace
}  // namespace jetlag::testing::ensemble_test
