// SPDX-License-Identifier: MIT
// Long runs with the step of Jorba and Zou: how many steps, where they end, and how rounding adds up.
//
// `jetlag study kepler` and `jetlag study brouwer` are the same at full length.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/truncation/draws.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::long_runs_test {
namespace {

constexpr double period = 2 * std::numbers::pi;
constexpr double eps = std::numeric_limits<double>::epsilon();

Lockstep degree_20(const System<double>& system, bool compensated) {
  RandomTaylor::Options options;
  options.compensated = compensated;
  return Lockstep(taylor(system, 20, std::make_unique<JorbaZou>(), options));
}

/// The relative error of the energy -1/2 of the planet, 1000 times larger terms of which cancel near the sun:
/// in 80 bits.
double energy_error(const State<double>& state) {
  long double squares[2] = {0, 0};
  for (int c = 0; c < 2; ++c) {
    const bool rests = state.position_rest.size() > 0;
    const long double x = state.position(1, c) +
                          (rests ? static_cast<long double>(state.position_rest(1, c)) : 0),
                      v = state.velocity(1, c) +
                          (rests ? static_cast<long double>(state.velocity_rest(1, c)) : 0);
    squares[0] += x * x;
    squares[1] += v * v;
  }
  return static_cast<double>(-2 * (squares[1] / 2 - 1 / std::sqrt(squares[0])) - 1);
}

/// What the steps of a run allow its energy error to be. A step that rounds x and v by r_x and r_v changes the
/// energy by at most |a| r_x + |v| r_v, and a rounding is uniform up to half of a last place, eps |y| / 2 at
/// most: its deviation is eps |y| / sqrt(12), and that of a run the root of the sum of squares. Here 4 of them.
struct Roundings {
  double of_states = 0, of_increments = 0;  // sums of squares, with |y| and with |y_new - y|

  void add(const State<double>& before, const State<double>& after) {
    const auto x = before.position.row(1), v = before.velocity.row(1);
    const double a = 1 / x.squaredNorm(), speed = v.norm();
    const double states = a * x.norm() + speed * speed;
    const double increments =
        a * (after.position.row(1) - x).norm() + speed * (after.velocity.row(1) - v).norm();
    of_states += states * states;
    of_increments += increments * increments;
  }
  static double band(double squares) { return 4 * eps * std::sqrt(squares / 12) / 0.5; }
};

struct PlanetRun {
  double steps_per_period, error;
  Roundings roundings;
};
PlanetRun run_planet(double e, int periods, bool compensated) {
  const Problem scene = planet(e);
  State<double> state = scene.start, before = scene.start;
  PlanetRun run{};
  RunOptions options;
  options.observer.after_step = [&](const StepView& view) {
    run.roundings.add(before, view.state());
    before = view.state();
    return true;
  };
  Lockstep lockstep = degree_20(scene.system, compensated);
  EXPECT_EQ(lockstep.run(state, periods * period, options).outcome, Outcome::success);
  run.steps_per_period = static_cast<double>(lockstep.work().steps) / periods;
  run.error = energy_error(state) - energy_error(scene.start);
  return run;
}

TEST(Kepler, TakesNoMoreStepsAndNoMoreErrorThanRoundingGives) {
  // The error grows with the root of the number of periods: over 1000 the bands are 6 times wider than over these 25.
  struct Case {
    double e;
    int steps;  // a period
  };
  for (const Case& c : {Case{0.9, 74}, {0.99, 120}, {0.999, 166}})
    for (bool compensated : {false, true}) {
      const PlanetRun run = run_planet(c.e, 25, compensated);
      EXPECT_LE(run.steps_per_period, c.steps) << c.e;
      const double band =
          Roundings::band(compensated ? run.roundings.of_increments : run.roundings.of_states);
      EXPECT_LE(std::abs(run.error), band) << c.e << ", compensated: " << compensated;
    }
}

TEST(Kepler, EndsAtThePublishedPositions) {
  // In 75-digit arithmetic. An energy off by d shifts the phase by 3/2 d t.
  struct Case {
    double e, t, x, y, energy_error, tolerance;
  };
  for (const Case& c : {Case{.9, 20, -1.295266250987574367717139, 0.4003938963792321527297696, 2e-14, 0},
                        {.99, 10, -1.947930813572708947842054, -0.04048622324344129162115774, 1e-12, 0},
                        {.99, 100, -0.9388973273317407724449242, -0.1408830418653661464724342, 1e-12, 0},
                        {.99, 1000, -1.320695160352823732570402, 0.1331305755538241558829508, 1e-12, 1e-7},
                        {.999, 100, -0.9573122285019766715756194, -0.04467131067346636135677615, 4e-12, 0}}) {
    Problem scene = planet(c.e);
    const State<double> start = scene.start;
    ASSERT_EQ(degree_20(scene.system, true).run(scene.start, c.t, {}).outcome, Outcome::success);
    EXPECT_LE(std::abs(energy_error(scene.start) - energy_error(start)), c.energy_error)
        << c.e << ", t = " << c.t;
    const double error = (scene.start.position.row(1) - Eigen::RowVector2d(c.x, c.y)).norm();
    EXPECT_LE(error, 1.5 * c.energy_error * c.t * scene.start.velocity.row(1).norm())
        << c.e << ", t = " << c.t;
  }
}

TEST(Brouwer, EnergyErrorsInCompensatedSumsGrowWithTheRootOfTime) {
  // 32 planets, e = .5, from random phases, for 60 periods. An RMS of 32 errors is known to 1/sqrt(64), and the power
  // between 4 and 60 periods to sqrt(2)/8 / ln 15 = 0.07: 4 sigma are 0.3; errors of one sign would give the power 1.
  // Published: RMS below 1e-14 at 1000 periods, and so below 2.5e-15 at 60.
  double early = 0, late = 0;
  const int runs = 32;
  for (int run = 0; run < runs; ++run) {
    Problem scene = planet(0.5);
    const KeplerPoint point = kepler(0.5, period * uniform(1, 0, run));
    const Eigen::Rotation2Dd turn(period * uniform(1, 1, run));
    scene.start.position.row(1) = point.position * turn.toRotationMatrix();
    scene.start.velocity.row(1) = point.velocity * turn.toRotationMatrix();
    const double start = energy_error(scene.start);
    Lockstep lockstep = degree_20(scene.system, true);
    ASSERT_EQ(lockstep.run(scene.start, 4 * period, {}).outcome, Outcome::success);
    early += std::pow(energy_error(scene.start) - start, 2) / runs;
    ASSERT_EQ(lockstep.run(scene.start, 60 * period, {}).outcome, Outcome::success);
    late += std::pow(energy_error(scene.start) - start, 2) / runs;
  }
  EXPECT_NEAR(0.5 * std::log(late / early) / std::log(15.0), 0.5, 0.3) << "seed 1";
  EXPECT_LT(std::sqrt(late), 2.5e-15) << "seed 1";
}

TEST(Pendulum, SwingsBackToWhereItBegan) {
  const Problem swing = pendulum();
  State<double> state = swing.start;
  Lockstep lockstep = degree_20(swing.system, true);
  ASSERT_EQ(lockstep.run(state, 10.0, {}).outcome, Outcome::success);
  state.velocity *= -1;
  state.velocity_rest *= -1;
  ASSERT_EQ(lockstep.run(state, 20.0, {}).outcome, Outcome::success);
  EXPECT_NEAR(state.position(0, 0), 1.3, 1e-15);
  EXPECT_NEAR(state.velocity(0, 0), 0.0, 1e-15);
}

}  // namespace
}  // namespace jetlag::testing::long_runs_test
