// SPDX-License-Identifier: MIT
// The random degree: how errors grow, and what one draw for all particles conserves, one for each does not.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/forces/uniform_field.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/truncation/draws.hpp"
#include "support/eigenvalues.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::random_taylor_test {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

std::unique_ptr<RandomTaylor> integrator(const System<double>& system, const TruncationLaw& law, double step,
                                         RandomTaylor::Options options) {
  return std::make_unique<RandomTaylor>(system, law, std::make_unique<FixedStep>(step), options);
}

// ---- one step of an oscillator ----------------------------------------------------------------------------

/// The matrix of the first step (x, v) -> (x, v) of x'' = -x for every degree that can be drawn, by the
/// integrator: seeds are tried until each degree has come.
std::map<int, Eigen::Matrix2d> step_matrices(const TruncationLaw& law, VelocitySeries velocity, double h) {
  std::map<int, Eigen::Matrix2d> matrices;
  const std::size_t degrees = law.max_degree() - law.min_degree() + 1;
  for (std::uint64_t seed = 1; matrices.size() < degrees && seed < 10'000; ++seed) {
    Eigen::Matrix2d columns;
    int degree = 0;
    for (int c = 0; c < 2; ++c) {
      const Problem scene = oscillator(1.0, c == 0, c == 1);
      const auto one = integrator(scene.system, law, h, {seed, true, velocity});
      State<double> state = scene.start;
      Report report;
      EXPECT_EQ(one->step(state, 10.0, report), h);
      columns.col(c) << state.position(0, 0), state.velocity(0, 0);
      degree = static_cast<int>(one->work().degrees);
    }
    matrices[degree] = columns;
  }
  EXPECT_EQ(matrices.size(), degrees);
  return matrices;
}

/// E[R (x) R]: how second moments of (x, v) change in one step.
Eigen::Matrix4d second_moments(const TruncationLaw& law, VelocitySeries velocity, double h) {
  Eigen::Matrix4d mean = Eigen::Matrix4d::Zero();
  for (const auto& [k, r] : step_matrices(law, velocity, h))
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        mean.block<2, 2>(2 * i, 2 * j) += (law.at_least(k) - law.at_least(k + 1)) * r(i, j) * r;
  return mean;
}

double growth(const TruncationLaw& law, VelocitySeries velocity, double h) {
  return spectral_radius(second_moments(law, velocity, h)) - 1;
}

TEST(RandomTaylor, GrowsInMeanSquareAsPublished) {
  // Published to 5 digits; rounding of numbers near 1 is 1e-15, 5e-5 of the smaller growth.
  const TruncationLaw law = geometric(3, 6, 0.5);
  EXPECT_NEAR(growth(law, VelocitySeries::own_series, 0.1), 2.0838e-11, 1e-4 * 2.0838e-11);
  EXPECT_NEAR(growth(law, VelocitySeries::derivative, 0.1), 1.52952e-8, 1e-5 * 1.52952e-8);
}

TEST(RandomTaylor, GrowsInMeanSquareByTheTailsOfTheExponential) {
  // E|R|^2 = |T_N(iy)|^2 + sum (w_n - w_{n-1}) |S_n(iy)|^2; for (3, 4): 1 - y^6/72 + y^8/576 / (1 - p).
  for (double p : {0.25, 0.5, 0.75})
    for (double y : {0.5, 1.0, 2.0}) {
      const double truth = -std::pow(y, 6) / 72 + std::pow(y, 8) / 576 / (1 - p);
      EXPECT_NEAR(growth(geometric(3, 4, p), VelocitySeries::own_series, y), truth,
                  1e-14);  // of numbers near 1
    }
}

TEST(RandomTaylor, IsTaylorsMethodOfTheLargestDegreeInTheMean) {
  const TruncationLaw law = geometric(2, 7, 0.5);
  for (VelocitySeries velocity : {VelocitySeries::own_series, VelocitySeries::derivative}) {
    Eigen::Matrix2d mean = Eigen::Matrix2d::Zero();
    for (const auto& [k, r] : step_matrices(law, velocity, 0.75))
      mean += (law.at_least(k) - law.at_least(k + 1)) * r;
    const Eigen::Matrix2d fixed = step_matrices(fixed_degree(7), velocity, 0.75).at(7);
    EXPECT_LT((mean - fixed).cwiseAbs().maxCoeff(), 1e-15);  // six terms below 1
  }
}

// ---- energy -----------------------------------------------------------------------------------------------

/// Root mean square over 64 seeds of the energy error of a planet, e = .3, after so many periods of 118.3719
/// steps.
double energy_error(const TruncationLaw& law, int periods, int seeds) {
  const Problem scene = planet(0.3);
  EnergyMeter energy(scene.system);
  double squares = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const RandomTaylor::Options options{static_cast<std::uint64_t>(seed), true, VelocitySeries::derivative};
    State<double> state = scene.start;
    EXPECT_EQ(Lockstep(integrator(scene.system, law, two_pi / 118.3719, options))
                  .run(state, periods * two_pi, {})
                  .outcome,
              Outcome::success);
    squares += std::pow(energy(state).total() + 0.5, 2);
  }
  return std::sqrt(squares / seeds);
}

TEST(RandomTaylor, LetsTheEnergyErrorWalkWhereAFixedDegreeLetsItRun) {
  // Degree 6 gains the same energy every period: twice the time, twice the error. What it gains changes with
  // the orbit by some 1e-5, and hardly with where the 118 steps fall.
  EXPECT_NEAR(energy_error(fixed_degree(6), 40, 1) / energy_error(fixed_degree(6), 20, 1), 2.0, 0.02);
  // (6, 16, .5): independent kicks, and the error walks. Runs of 20 periods are the first halves of those of
  // 40: with error a after the first half and a + b after both, the ratio squared is mean (a+b)^2 / mean a^2;
  // its logarithm has variance (2 + 2 - 2)/64 for Gaussian a and b, that of the ratio half the deviation,
  // 0.088: 3 sigma are a factor 1.3, which tells sqrt 2 from 2.
  const TruncationLaw law = geometric(6, 16, 0.5);
  const double ratio = energy_error(law, 40, 64) / energy_error(law, 20, 64);
  EXPECT_GT(ratio, std::numbers::sqrt2 / 1.3) << "seeds 1 .. 64";
  EXPECT_LT(ratio, std::numbers::sqrt2 * 1.3) << "seeds 1 .. 64";
}

// ---- momentum ---------------------------------------------------------------------------------------------

TEST(RandomTaylor, KeepsMomentumWithOneDrawForAll) {
  // Every coefficient of the forces between particles sums to zero. A field acts from outside: M g t.
  Problem scene = spring_cube(1);
  const Eigen::RowVector3d field(1e-3, -2e-3, 5e-4);
  scene.system.add<UniformField>({{0}, {1}, {2}, {3}, {4}, {5}, {6}, {7}}, {{field[0], field[1], field[2]}});
  double total_mass = 0;
  for (double m : scene.system.mass()) total_mass += m;
  State<double> state = scene.start;
  const double step = 0.0625;
  ASSERT_EQ(
      Lockstep(integrator(scene.system, geometric(3, 4, 0.5), step, {})).run(state, 1e5 * step, {}).outcome,
      Outcome::success);
  const Eigen::VectorXd expected =
      momentum(scene.system, scene.start) + total_mass * state.time * field.transpose();
  EXPECT_LT((momentum(scene.system, state) - expected).norm(), 1e-12 * expected.norm()) << "seeds 1, 1";
}

/// sum_i m_i^2 Var(v_i), added over the components: how far the momentum is scattered by the next step, from
/// the terms of the velocities in this state.
double momentum_variance(const Problem& scene, const TruncationLaw& law, double step,
                         Expansion<double>& series, const State<double>& state) {
  const int n = law.max_degree();
  series.start(state);
  series.grow_to(n + 1);
  double sum = 0;
  std::vector<double> terms(n + 1);
  for (int i = 0; i < series.particles(); ++i)
    for (int c = 0; c < series.dimension(); ++c) {
      for (int k = 0; k <= n; ++k) terms[k] = series.velocity(k)(i, c) * std::pow(step, k);
      sum += std::pow(scene.system.mass()[i], 2) * variance(law, terms);
    }
  return sum;
}

TEST(RandomTaylor, LetsMomentumWalkAsPredictedWithADrawForEachParticle) {
  // The momentum is a martingale: its mean square after n steps is the sum of the variances of the steps.
  const Problem scene = spring_cube(1);
  const TruncationLaw law = geometric(3, 6, 0.5);
  const double step = 0.25;
  const int seeds = 200, steps = 160;
  const Eigen::VectorXd start = momentum(scene.system, scene.start);
  Expansion<double> series(scene.system, law.max_degree() + 1);
  double squares = 0, early_squares = 0, predicted = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto walk = integrator(scene.system, law, step, {static_cast<std::uint64_t>(seed), false});
    State<double> state = scene.start;
    Report report;
    for (int i = 0; i < steps; ++i) {
      predicted += momentum_variance(scene, law, step, series, state);
      ASSERT_EQ(walk->step(state, 1.0, report), step);
      state.time += step;
      if (i + 1 == steps / 4) early_squares += (momentum(scene.system, state) - start).squaredNorm();
    }
    squares += (momentum(scene.system, state) - start).squaredNorm();
  }
  // 600 squares of Gaussians, 3 components of 200 walks: relative deviation sqrt(2/600) = 0.058; 4 sigma.
  EXPECT_NEAR(squares / predicted, 1.0, 4 * 0.058) << "seeds 1 .. 200";
  // Four times the steps, twice the distance. Both mean squares scatter by 0.058 (and go together, if at
  // all), their ratio by less than 0.082, its root by half of that; 4 sigma.
  EXPECT_NEAR(std::log(std::sqrt(squares / early_squares) / 2), 0.0, 4 * 0.041) << "seeds 1 .. 200";
}

// ---- draws ------------------------------------------------------------------------------------------------

/// `n` oscillators that do not see each other, all from the same state.
Problem equal_oscillators(int n) {
  System<double> system(1, std::vector<double>(n, 1.0));
  std::vector<std::array<int, 1>> all;
  for (int i = 0; i < n; ++i) all.push_back({i});
  system.add<Tether>(all, {{1.0}});
  return {std::move(system), {0.0, Coordinates<double>::Ones(n, 1), Coordinates<double>::Zero(n, 1)}};
}

State<double> after(const Problem& scene, RandomTaylor::Options options, double until) {
  State<double> state = scene.start;
  EXPECT_EQ(
      Lockstep(integrator(scene.system, geometric(3, 8, 0.5), 0.25, options)).run(state, until, {}).outcome,
      Outcome::success);
  return state;
}

TEST(RandomTaylor, MovesEqualParticlesAlikeWithOneDrawForAll) {
  const State<double> end = after(equal_oscillators(5), {1, true}, 5.0);
  for (int i = 1; i < 5; ++i) {
    EXPECT_EQ(end.position.row(i), end.position.row(0));
    EXPECT_EQ(end.velocity.row(i), end.velocity.row(0));
  }
}

TEST(RandomTaylor, MovesEqualParticlesApartWithADrawForEach) {
  const State<double> end = after(equal_oscillators(5), {1, false}, 5.0);
  for (int i = 1; i < 5; ++i) EXPECT_NE(end.position.row(i), end.position.row(0)) << "seed 1";
}

TEST(RandomTaylor, DrawsForAParticleWhateverElseThereIs) {
  const State<double> few = after(equal_oscillators(2), {1, false}, 5.0);
  const State<double> many = after(equal_oscillators(40), {1, false}, 5.0);
  EXPECT_EQ(few.position, many.position.topRows(2)) << "seed 1";
  EXPECT_EQ(few.velocity, many.velocity.topRows(2)) << "seed 1";
}

TEST(RandomTaylor, TakesTheDegreesOfTheDraws) {
  // From rest at x = 1 the terms of cos and sin, weighted, stopped where `uniform` says.
  const TruncationLaw law = geometric(3, 8, 0.5);
  const Problem scene = equal_oscillators(50);
  const double h = 0.25;
  State<double> state = scene.start;
  Report report;
  ASSERT_EQ(integrator(scene.system, law, h, {3, false})->step(state, 1.0, report), h);
  for (int i = 0; i < 50; ++i) {
    const int degree = law.draw(uniform(3, i, 0));
    double x = 0, v = 0, term = 1;  // h^n / n!
    for (int n = 0; n <= degree; ++n) {
      const double sign = n % 4 < 2 ? 1 : -1;  // cos: + 0 - 0, -sin: 0 - 0 +
      const double weight = n <= 3 ? 1 : std::pow(2.0, n - 3);
      if (n % 2 == 0) x += sign * weight * term;
      if (n % 2 == 1) v -= sign * weight * term;
      term *= h / (n + 1);
    }
    EXPECT_NEAR(state.position(i, 0), x, 1e-15) << "seed 3";  // a few roundings of numbers below 1
    EXPECT_NEAR(state.velocity(i, 0), v, 1e-15) << "seed 3";
  }
}

TEST(RandomTaylor, MayStopBeforeTheFirstTerm) {
  // m = 0 and velocities by the derivative: K = 0 leaves x and gives v = 0; the piece says the same.
  const TruncationLaw law("half", {1.0, 0.5});
  int stopped = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Problem scene = oscillator(1.0, 1.0, 0.5);
    const auto one = integrator(scene.system, law, 0.25, {seed, true, VelocitySeries::derivative});
    State<double> state = scene.start;
    Report report;
    ASSERT_EQ(one->step(state, 1.0, report), 0.25);
    const State<double> end = one->piece().at(0.25);
    EXPECT_EQ(end.position, state.position);
    EXPECT_EQ(end.velocity, state.velocity);
    if (one->work().degrees > 0) continue;
    ++stopped;
    EXPECT_EQ(state.position(0, 0), 1.0);
    EXPECT_EQ(state.velocity(0, 0), 0.0);
  }
  EXPECT_GT(stopped, 0) << "seeds 1 .. 20";
}

}  // namespace
}  // namespace jetlag::testing::random_taylor_test
