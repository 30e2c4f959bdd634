// SPDX-License-Identifier: MIT
// Trajectories in lanes follow the choices of their forces, and take no step that the forces at its end contradict.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "integrators/changes/singular_laws.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/ensembles/ensemble.hpp"
#include "jetlag/ensembles/random_ensemble.hpp"
#include "jetlag/forces/forces.hpp"

namespace jetlag::testing::ensemble_checks_test {
namespace {

using singular_laws::Push, singular_laws::QuadraticDrag, singular_laws::Sawtooth, singular_laws::ToALine;

/// A rope of length 1 to the origin, which pulls back what is beyond.
struct Rope {
  static constexpr const char* name = "rope";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"stiffness"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& stiffness) {
    Vector<T, D> f = Vector<T, D>::Constant(T(0.0));
    const T& x = p.position[0][0];
    f[0] = select(x > T(1.0), T(stiffness * (T(1.0) - x)), T(0.0));
    return f;
  }
};

template <class Law, class... Parameters>
System<double> of_one(Parameters... parameters) {
  System<double> system(1, {1.0});
  system.add<Law>({{0}}, {std::array<double, sizeof...(Parameters)>{parameters...}});
  return system;
}
State<double> at(double x, double v, double time = 0) {
  State<double> state{time, Coordinates<double>::Zero(1, 1), Coordinates<double>::Zero(1, 1)};
  state.position << x;
  state.velocity << v;
  return state;
}

// Free up to x = 1, half a period of the spring, and back as fast: closed, w = sqrt(k).
TEST(EnsembleChecks, RopesTightenAndLetGo) {
  std::vector<State<double>> states;
  for (int i = 0; i < 37; ++i) states.push_back(at(0.1 + 0.02 * i, 1));
  for (const KernelTable<double>* table : available_kernels()) {
    Ensemble ropes(of_one<Rope>(100.0), 20, states, std::numeric_limits<double>::infinity(), Workers(1),
                   *table);
    ropes.advance_to(1);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const double tight = 1 - states[i].position(0, 0), pulled = 1 - tight, w = 10;
      const bool is_free = pulled > M_PI / w;
      const double x = is_free ? 1 - (pulled - M_PI / w) : 1 + std::sin(w * pulled) / w,
                   v = is_free ? -1 : std::cos(w * pulled);
      ASSERT_EQ(ropes.outcome(i), Outcome::success);
      EXPECT_NEAR(ropes.state(i).position(0, 0), x, 1e-13);  // some hundred roundings of 1
      EXPECT_NEAR(ropes.state(i).velocity(0, 0), v, 1e-12);  // those of the time of the change, w^2 times
      EXPECT_GT(ropes.lone_steps(i), 0u);
    }
  }
}

/// The forces at both ends of a step of 17 s are none.
TEST(EnsembleChecks, PushesWithinAStepAreFelt) {
  Ensemble pushed(of_one<Push>(), 20, {at(0, 0), at(1, 0, 1.5)});
  pushed.advance_to(17);
  EXPECT_NEAR(pushed.state(0).position(0, 0), 15.5, 1e-13);  // 1/2 at 2 s, at 1 m/s; some tens of roundings
  EXPECT_NEAR(pushed.state(0).velocity(0, 0), 1, 1e-14);
  EXPECT_NEAR(pushed.state(1).position(0, 0), 1 + 0.125 + 7.5, 1e-13);
}

/// Lanes of steps that are given would pass over it.
TEST(EnsembleChecks, RandomMembersWithChoicesGoByThemselves) {
  const SeriesMethod method{geometric(3, 8, 0.5), {}, std::make_shared<FixedStep>(0.7)};
  RandomEnsemble::Options options;
  RandomEnsemble pushed(of_one<Push>(), method, std::vector<State<double>>(40, at(0, 0)), options);
  EXPECT_FALSE(pushed.in_lanes());
  pushed.advance_to(17);
  EXPECT_NEAR(pushed.state(3).position(0, 0), 15.5, 1e-13);
  options.layout = RandomEnsemble::Layout::in_lanes;
  EXPECT_THROW(RandomEnsemble(of_one<Push>(), method, {at(0, 0)}, options), std::invalid_argument);
}

TEST(EnsembleChecks, FindAJumpOfWhichTheTapeKnowsNothing) {
  constexpr double end = 5, pi = M_PI;
  std::vector<State<double>> states;
  for (int i = 0; i < 11; ++i) states.push_back(at(i, 0));
  Ensemble driven(of_one<Sawtooth>(), 20, states);
  driven.advance_to(end);
  const double past = end - pi, v = pi * pi / 2 + past * past / 2 - pi * past,
               x = pi * pi * pi / 6 + pi * pi / 2 * past + past * past * past / 6 - pi * past * past / 2;
  for (std::size_t i = 0; i < states.size(); ++i) {
    ASSERT_EQ(driven.outcome(i), Outcome::success);
    // A step that passes over the jump by s departs by 2 pi s^2 / 2: allowed up to 2^16 eps |x| of the 20 m, s = 1e-5, only
    // where the step is that short, and then v by 2 pi s. What halving finds is far nearer.
    EXPECT_NEAR(driven.state(i).position(0, 0), static_cast<double>(i) + x, 1e-8) << i;
    EXPECT_NEAR(driven.state(i).velocity(0, 0), v, 1e-8) << i;
  }
}

/// The end of the last step is looked at before it is handed out: a step over the jump to where the series ends.
TEST(EnsembleChecks, LookAtTheLastEndToo) {
  Ensemble driven(of_one<Sawtooth>(), 20, {at(0, 0, 3.0)});
  driven.advance_to(3.3);
  const double past = 3.3 - M_PI, v = (M_PI * M_PI - 9) / 2 + past * past / 2 - M_PI * past;
  EXPECT_NEAR(driven.state(0).velocity(0, 0), v, 1e-9);
}

TEST(EnsembleChecks, FallsFromRestStart) {  // against drag: v = tanh t
  System<double> system = of_one<QuadraticDrag>(1.0);
  system.add<UniformField>({{0}}, {{1.0, 0.0, 0.0}});
  Ensemble falling(system, 20, {at(0, 0), at(3, 0), at(0, 0.5)});
  falling.advance_to(2);
  for (const std::size_t i : {0, 1}) {
    ASSERT_EQ(falling.outcome(i), Outcome::success);
    EXPECT_NEAR(falling.state(i).velocity(0, 0), std::tanh(2.0), 1e-13);  // some hundred roundings
  }
  EXPECT_NEAR(falling.state(2).velocity(0, 0), std::tanh(2 + std::atanh(0.5)), 1e-13);
}

TEST(EnsembleChecks, SlidingMotionsEnd) {
  Ensemble sliding(of_one<ToALine>(), 20, {at(0.5, 0), at(1e3, 0)});
  sliding.advance_to(5);
  EXPECT_EQ(sliding.outcome(0), Outcome::step_underflow);
  EXPECT_LT(sliding.state(0).time, 5);
  EXPECT_EQ(sliding.outcome(1), Outcome::success);  // does not get there
  EXPECT_NEAR(sliding.state(1).position(0, 0), 1e3 - 12.5, 1e-12);
}

TEST(EnsembleChecks, SmoothMotionsStayInTheirLanes) {
  System<double> system(2, {1.0, 0.25});
  system.add<Gravity>({{0, 1}}, {{1.0}});
  for (const int degree : {6, 12, 20, 30}) {
    std::vector<State<double>> states;
    for (int i = 0; i < 20; ++i) {
      State<double> state{0.0, Coordinates<double>::Zero(2, 2), Coordinates<double>::Zero(2, 2)};
      state.position(1, 0) = 1;
      state.velocity(1, 1) = 0.4 + 0.04 * i;
      states.push_back(state);
    }
    Ensemble orbits(system, degree, states);
    for (const double until : {1.0, 7.0, 50.0}) orbits.advance_to(until);
    for (std::size_t i = 0; i < states.size(); ++i)
      EXPECT_EQ(orbits.lone_steps(i), 0u) << degree << ", " << i << " of " << orbits.steps(i);
  }
}

TEST(EnsembleChecks, LoneStepsHaveTheSameBitsInAnyCompany) {
  std::vector<State<double>> states;
  for (int i = 0; i < 37; ++i) states.push_back(at(0.1 + 0.02 * i, 1));
  const auto& table = *available_kernels().back();
  const double infinite = std::numeric_limits<double>::infinity();
  Ensemble together(of_one<Rope>(100.0), 20, states, infinite, Workers(2), table);
  together.advance_to(3);
  for (std::size_t i = 0; i < states.size(); i += 5) {
    Ensemble single(of_one<Rope>(100.0), 20, {states[i]}, infinite, Workers(1), table);
    single.advance_to(3);
    EXPECT_EQ(single.state(0).position(0, 0), together.state(i).position(0, 0));
    EXPECT_EQ(single.steps(0), together.steps(i));
    EXPECT_EQ(single.lone_steps(0), together.lone_steps(i));
  }
}

}  // namespace
}  // namespace jetlag::testing::ensemble_checks_test
