// SPDX-License-Identifier: MIT
// Methods that perturb another: the moments of their ensembles in closed form.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "jetlag/forces/drag.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/explicit/rk4.hpp"
#include "jetlag/integrators/perturbed/conrad.hpp"
#include "jetlag/integrators/perturbed/exponential_step.hpp"
#include "jetlag/integrators/perturbed/random_step.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {
namespace {

constexpr double any_length = 1e300;

/// y' = -y as the velocity of particles with drag, three of them in each.
Problem decays(int particles) {
  System<double> system(3, std::vector<double>(particles, 1.0));
  std::vector<std::array<int, 1>> all;
  for (int i = 0; i < particles; ++i) all.push_back({i});
  system.add<Drag>(all, {{1.0}});
  return {std::move(system),
          {0.0, Coordinates<double>::Zero(particles, 3), Coordinates<double>::Ones(particles, 3)}};
}

TEST(Conrad, TheVarianceOfADecayIsThatOfItsAutoregression) {
  // Euler with noise: y_{n+1} = (1 - h) y_n + xi, Var y_n = sigma^2 h^3 (1 - R^2n) / (1 - R^2), R = 1 - h:
  // 5.2632e-3 for h = .1, n = 100. Of 36000 paths the variance is off by sqrt(2 / 36000) = 0.75 %, the mean by 4e-4.
  const Problem scene = decays(12000);
  Conrad method(scene.system, std::make_unique<RungeKutta>(scene.system, euler(), any_length),
                {.step = 0.1, .order = 1});
  State<double> state = scene.start;
  Report report;
  for (int n = 0; n < 100; ++n) ASSERT_EQ(method.step(state, 1.0, report), 0.1);
  const double mean = state.velocity.mean(), count = static_cast<double>(state.velocity.size());
  EXPECT_NEAR(mean, std::pow(0.9, 100), 5 * 4e-4) << "seed 1";
  EXPECT_NEAR((state.velocity.array() - mean).square().sum() / (count - 1), 5.2632e-3, 0.02 * 5.2632e-3)
      << "seed 1";
}

TEST(Conrad, NoiseOfPositionsAndVelocitiesIsIndependent) {
  // One step of free particles: x = h v_0 + xi, v = v_0 + eta, deviation sigma h^(p+1/2) each.
  const int particles = 20000;
  System<double> system(1, std::vector<double>(particles, 1.0));
  Conrad method(system, std::make_unique<RungeKutta>(system, rk4(), any_length),
                {.step = 0.5, .order = 4, .sigma = 3.0});
  State<double> state{0.0, Coordinates<double>::Zero(particles, 1), Coordinates<double>::Zero(particles, 1)};
  Report report;
  method.step(state, 1.0, report);
  const double variance = 9 * std::pow(0.5, 9), sigmas = 5 / std::sqrt(particles);
  EXPECT_NEAR(state.position.squaredNorm() / particles / variance, 1, sigmas * std::sqrt(2)) << "seed 1";
  EXPECT_NEAR(state.velocity.squaredNorm() / particles / variance, 1, sigmas * std::sqrt(2)) << "seed 1";
  EXPECT_NEAR(state.position.cwiseProduct(state.velocity).sum() / particles / variance, 0, sigmas)
      << "seed 1";
}

TEST(RandomStep, LengthsHaveTheirMeanAndVariance) {
  const System<double> system(1, {1.0});
  const int n = 100000;
  for (StepDistribution distribution : {StepDistribution::uniform, StepDistribution::lognormal}) {
    const double h = 0.25, p = 1.5, c = distribution == StepDistribution::uniform ? 1.0 / 3 : 1.0;
    const RandomStep method(std::make_unique<Leapfrog>(system, any_length),
                            {.step = h, .order = p, .distribution = distribution});
    double sum = 0, squares = 0;
    for (int k = 0; k < n; ++k) {
      const double length = method.length(h, k);
      ASSERT_GT(length, 0);
      sum += length - h;
      squares += (length - h) * (length - h);
    }
    const double variance = c * std::pow(h, 2 * p + 1);
    EXPECT_NEAR(sum / n, 0, 5 * std::sqrt(variance / n)) << "seed 1";
    EXPECT_NEAR(squares / n / variance, 1, 5 * std::sqrt(3.0 / n))
        << "seed 1";  // fourth moment below 4 variance^2
  }
}

TEST(RandomStep, TheSecondMomentOfADecayIsInClosedForm) {
  // Euler, uniform: y_1 = (1 - H) y_0, E |R|^2 = (1 - h)^2 + h^(2p+1) / 3, from 20000 seeds of one step.
  const double h = 0.5, p = 1, exact = (1 - h) * (1 - h) + std::pow(h, 2 * p + 1) / 3;
  const Problem scene = decays(1);
  double sum = 0, squares = 0;
  const int seeds = 20000;
  for (int seed = 1; seed <= seeds; ++seed) {
    RandomStep method(std::make_unique<RungeKutta>(scene.system, euler(), any_length),
                      {.step = h, .order = p, .seed = static_cast<std::uint64_t>(seed)});
    State<double> state = scene.start;
    Report report;
    method.step(state, 1.0, report);
    const double r = state.velocity(0, 0) * state.velocity(0, 0);
    sum += r;
    squares += r * r;
  }
  const double mean = sum / seeds, deviation = std::sqrt((squares / seeds - mean * mean) / seeds);
  EXPECT_NEAR(mean, exact, 5 * deviation);
}

TEST(RandomStep, ForcesAreTakenAtTheTimeOfTheLabel) {
  const Problem scene = oscillator();
  RandomStep method(std::make_unique<Leapfrog>(scene.system, any_length), {.step = 0.25, .order = 1});
  State<double> state = scene.start;
  Report report;
  EXPECT_EQ(method.step(state, 1.0, report), 0.25);
  EXPECT_EQ(method.piece().end, 0.25);
}

TEST(ExponentialStep, TheSecondMomentOfADecayIsInClosedForm) {
  // E |R|^2 = 1 - 2h + 2h^2: .905 at h = .95 and 1.105 at h = 1.05, from 40000 seeds of one step.
  const Problem scene = decays(1);
  for (const auto& [h, factor] : {std::pair(0.95, 0.905), std::pair(1.05, 1.105)}) {
    double sum = 0, first = 0, squares = 0;
    const int seeds = 40000;
    for (int seed = 1; seed <= seeds; ++seed) {
      ExponentialStep method(scene.system, h, seed);
      State<double> state = scene.start;
      Report report;
      method.step(state, 1e9, report);
      const double r = state.velocity(0, 0);
      first += r;
      sum += r * r;
      squares += r * r * r * r;
    }
    const double mean = sum / seeds;
    EXPECT_NEAR(first / seeds, 1 - h, 5 * h / std::sqrt(seeds));
    EXPECT_NEAR(mean, factor, 5 * std::sqrt((squares / seeds - mean * mean) / seeds));
  }
}

TEST(ExponentialStep, EndsWhereTheRunEnds) {
  const Problem scene = decays(1);
  State<double> state = scene.start;
  Lockstep run(std::make_unique<ExponentialStep>(scene.system, 0.01, 1));
  ASSERT_EQ(run.run(state, 10.0, {}).outcome, Outcome::success);
  EXPECT_EQ(state.time, 10.0);
  EXPECT_NEAR(static_cast<double>(run.work().steps), 1000, 5 * std::sqrt(1000)) << "seed 1";  // Poisson
}

TEST(Perturbed, RefuseWhatTheyCannotUse) {
  const System<double> system(1, {1.0});
  const auto inner = [&] { return std::make_unique<Leapfrog>(system, any_length); };
  EXPECT_THROW(Conrad(system, inner(), {.step = 0.0, .order = 1}), std::invalid_argument);
  EXPECT_THROW(Conrad(system, inner(), {.step = 0.1, .order = -1}), std::invalid_argument);
  EXPECT_THROW(Conrad(system, inner(), {.step = 0.1, .order = 1, .sigma = -1}), std::invalid_argument);
  EXPECT_THROW(RandomStep(inner(), {.step = 1.0, .order = 1}), std::invalid_argument);
  EXPECT_THROW(RandomStep(inner(), {.step = 0.1, .order = 0.5}), std::invalid_argument);
  EXPECT_THROW(ExponentialStep(system, -1.0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing
