// SPDX-License-Identifier: MIT
// Whoever stops a series draws the same: methods with one clock in any number type, clocks of particles, first-order
// systems. And a series that over- or underflows is counted in another unit of time.
#include "jetlag/integrators/stopped_series.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/integrators/first_order_taylor.hpp"
#include "jetlag/integrators/particle_taylor.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/block.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {
namespace {

constexpr std::uint64_t seed = 7;
constexpr double step = 0.25;
constexpr int steps = 40;

/// The degrees that a law draws, one for all particles of an update.
std::vector<int> degrees(const TruncationLaw& law) {
  std::vector<int> all;
  for (int n = 0; n < steps; ++n) all.push_back(law.draw(uniform(seed, shared_by_all, n)));
  return all;
}

constexpr auto circle = [](const auto&, const auto& u) { return std::array{u[1], -u[0]}; };

TEST(Stops, DrawWhatTheLawSays) {
  const TruncationLaw law = geometric(2, 9, 0.5);
  Stops stops(law, Draw::independent, seed);
  const std::vector<int> expected = degrees(law);
  for (int n = 0; n < steps; ++n) {
    stops.draw(n);
    EXPECT_EQ(stops.degree(), expected[n]);
    EXPECT_EQ(stops.drawn(shared_by_all, n), expected[n]);
    for (int k = 0; k <= stops.degree(); ++k) EXPECT_EQ(stops.weights()[k], law.weight(k));
  }
}

TEST(Stops, OfEachParticleAreTheirOwn) {
  const TruncationLaw law = geometric(2, 9, 0.5);
  Stops stops(law, Draw::independent, seed, {false, true, false});
  for (int n = 0; n < steps; ++n) {
    stops.draw(n);
    EXPECT_EQ(stops.degree(0), law.draw(uniform(seed, 0, n)));
    EXPECT_EQ(stops.degree(1), 2);  // it is fixed
    EXPECT_EQ(stops.degree(2), law.draw(uniform(seed, 2, n)));
    EXPECT_EQ(stops.largest_degree(), std::max(stops.degree(0), stops.degree(2)));
  }
}

TEST(Stops, OfAFixedDegreeAreSharedAndNotDrawn) {
  Stops stops(fixed_degree(5), Draw::stratified, seed, {false, false});
  stops.draw(3);
  EXPECT_TRUE(stops.shared());
  EXPECT_EQ(stops.draws(), 1u);
  EXPECT_EQ(stops.degree(), 5);
  for (int k = 0; k <= 6; ++k) EXPECT_EQ(stops.weights()[k], 1.0);
}

TEST(Stops, InViewOfTermsAreThoseOfTheLawGivenTheTerms) {
  const SequentialLaw law = sequential(1, 8, 1e-2);
  std::vector<double> terms;
  for (int n = 0; n <= 8; ++n) terms.push_back(std::pow(0.4, n));
  Stops stops(law, Draw::independent, seed);
  ASSERT_TRUE(stops.wait_for_terms());
  const TruncationLaw given = law.given(terms);
  for (int n = 0; n < steps; ++n) {
    int known = -1;
    stops.draw_in_view(
        n,
        [&](std::size_t, int k) {
          EXPECT_LE(k, known);
          return terms[k];
        },
        [&](int degree) { known = degree; });
    EXPECT_EQ(stops.degree(), given.draw(uniform(seed, shared_by_all, n)));
    EXPECT_EQ(known, stops.degree());
    for (int k = 0; k <= stops.degree(); ++k) EXPECT_NEAR(stops.weights()[k], given.weight(k), 1e-12);
  }
}

TEST(StoppedSeries, HasTheSameDrawsInEveryMethod) {
  // x'' = -x by all of them: the sums are the same to rounding, some eps of weights up to 2^7 a step. Another degree in one
  // step would change x by 1e-2.
  const TruncationLaw law = geometric(2, 9, 0.5);
  const Problem scene = oscillator(1.0, 1.0, 0.0);
  std::uint64_t expected = 0;
  for (int degree : degrees(law)) expected += degree;

  RandomTaylor::Options options;
  options.seed = seed;
  RandomTaylor controlled(scene.system, law, std::make_unique<FixedStep>(step), options);
  State<double> state = scene.start;
  Report report;
  for (int n = 0; n < steps; ++n) state.time += controlled.step(state, 1e9, report);
  EXPECT_EQ(controlled.work().degrees, expected);

  ParticleTaylor<> particles(scene.system, {.step = step, .law = law, .seed = seed});
  State<double> end = scene.start;
  EXPECT_EQ(particles.run(end, steps * step).outcome, Outcome::success);
  EXPECT_EQ(particles.work().degrees, expected);
  EXPECT_NEAR(end.position(0, 0), state.position(0, 0), 1e-11);
  EXPECT_NEAR(end.velocity(0, 0), state.velocity(0, 0), 1e-11);

  FirstOrderTaylor<> first_order(circle, 2, {.step = step, .law = law, .seed = seed});
  FirstOrderState<> numbers{0.0, {1.0, 0.0}};
  EXPECT_EQ(first_order.run(numbers, steps * step).outcome, Outcome::success);
  EXPECT_EQ(first_order.work().degrees, 2 * expected);  // of two numbers
  EXPECT_NEAR(numbers.y[0], state.position(0, 0), 1e-11);
  EXPECT_NEAR(numbers.y[1], state.velocity(0, 0), 1e-11);

  BlockSteps::Options clocks;
  clocks.seed = seed;
  clocks.tolerance = 1e9;  // steps of the largest length
  clocks.max_step = step;
  BlockSteps block(scene.system, law, clocks);
  State<double> last = scene.start;
  EXPECT_EQ(block.run(last, steps * step, {}).outcome, Outcome::success);
  ASSERT_EQ(block.work().steps, static_cast<std::uint64_t>(steps));
  EXPECT_EQ(block.work().degrees, expected);
  EXPECT_NEAR(last.position(0, 0), state.position(0, 0), 1e-11);
}

TEST(StoppedSeries, HasTheSameDrawsInViewOfTermsInEveryMethod) {
  const SequentialLaw law = sequential(1, 9, 1e-3);
  const Problem scene = oscillator(1.0, 1.0, 0.0);
  RandomTaylor::Options options;
  options.seed = seed;
  RandomTaylor controlled(scene.system, law, std::make_unique<FixedStep>(step), options);
  ParticleTaylor<> particles(scene.system, {.step = step, .law = law, .seed = seed});
  State<double> state = scene.start, other = scene.start;
  Report report;
  for (int n = 0; n < steps; ++n) {
    controlled.step(state, 1e9, report);
    particles.step(other, 1e9, report);
    ASSERT_EQ(particles.work().degrees, controlled.work().degrees) << n;
    ASSERT_EQ(particles.work().element_coefficients, controlled.work().element_coefficients) << n;
  }
}

TEST(StoppedSeries, GrowsInAUnitInWhichItsCoefficientsAreNumbers) {
  // x'' = -w^2 x: coefficient 20 is w^20 / 20! and beyond a double for w = 1e20 and 1e-20.
  for (const double w : {1e20, 1e-20}) {
    const Problem scene = oscillator(w, 1.0, 0.0);
    StoppedSeries<Expansion<double>> series(Expansion<double>(scene.system, 20),
                                            Stops(fixed_degree(20), Draw::independent, seed), 0);
    series.start(scene.start);
    series.grow_to(20);
    const double s = w * series.series().time_unit();  // a radian or so
    EXPECT_GT(s, 1e-9);
    EXPECT_LT(s, 1e9);
    EXPECT_NEAR(series.series().norm(20) / (std::pow(s, 20) / std::tgamma(21.0)), 1.0, 1e-12);
    series.start(scene.start);  // goes on in it
    EXPECT_EQ(w * series.series().time_unit(), s);
    series.forget_unit();
    series.start(scene.start);
    EXPECT_EQ(series.series().time_unit(), 1.0);
  }
}

TEST(StoppedSeries, KnowsAllThatItsSumsNeedAndNoMore) {
  const Problem scene = oscillator(1.0, 1.0, 0.0);
  for (const int beyond : {0, 1}) {
    StoppedSeries<Expansion<double>> series(Expansion<double>(scene.system, 9),
                                            Stops(geometric(2, 9, 0.5), Draw::independent, seed), beyond);
    for (int n = 0; n < steps; ++n) {
      series.start(scene.start);
      series.draw(n);
      series.stop(step, n);
      EXPECT_EQ(series.series().order(), series.stops().degree() + beyond);
    }
  }
}

}  // namespace
}  // namespace jetlag::testing
