// SPDX-License-Identifier: MIT
// RandomTaylor with every kind of law and draw: unbiased steps, no order that is not drawn, dense output as stepped.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/integrators/state_variance.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/truncation/poisson.hpp"
#include "jetlag/truncation/single_term.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {
namespace {

constexpr double h = 0.3;

struct Kind {
  const char* name;
  Truncation law;
  Draw draws;
  bool shared;
};

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"Geometric", geometric(3, 10, 0.5), Draw::independent, true},
      {"Poisson", poisson(2, 8, 1.0), Draw::antithetic, true},
      {"Ruler", geometric(3, 10, 0.8), Draw::ruler, true},
      {"ScrambledRulers", geometric(3, 10, 0.5), Draw::scrambled_ruler, false},
      {"Rotations", geometric(3, 10, 0.4), Draw::rotation, false},
      {"Strata", geometric(2, 8, 0.5), Draw::stratified, false},
      {"SingleTerm", single_term(geometric(3, 8, 0.5)), Draw::rotation, true},
      {"SingleTerms", single_term(geometric(3, 8, 0.5)), Draw::independent, false},
      {"Sequential", sequential(2, 10, 1e-3, 0.2), Draw::independent, true},
      {"SequentialForEach", sequential(2, 10, 1e-3, 0.2), Draw::stratified, false}};
  return all;
}

/// Two planets of one sun, of different speeds.
Problem planets() {
  System<double> system(2, {1.0, 1e-3, 1e-3});
  system.fix(0);
  system.add<Gravity>({{0, 1}, {0, 2}}, {{1.0}});
  Problem scene{std::move(system), {0.0, Coordinates<double>::Zero(3, 2), Coordinates<double>::Zero(3, 2)}};
  scene.start.position.col(0) << 0, 1, -2;
  scene.start.velocity.col(1) << 0, 1.1, -0.6;
  return scene;
}

std::unique_ptr<RandomTaylor> method(const Problem& scene, const Kind& kind, std::uint64_t seed) {
  RandomTaylor::Options options{seed, kind.shared};
  options.draws = kind.draws;
  return std::make_unique<RandomTaylor>(scene.system, kind.law, std::make_unique<FixedStep>(h), options);
}

class EveryTruncation : public ::testing::TestWithParam<Kind> {};

TEST_P(EveryTruncation, TakesUnbiasedSteps) {
  const Kind& kind = GetParam();
  const Problem scene = planets();
  const auto degree = std::visit([](const auto& law) { return law.max_degree(); }, kind.law);
  Expansion<double> series(scene.system);
  series.start(scene.start);
  series.grow_to(degree + 1);
  Coordinates<double> truth = Coordinates<double>::Zero(3, 2);
  for (int n = 0; n <= degree; ++n) truth += std::pow(h, n) * series.position(n);

  const int seeds = 5000;
  Coordinates<double> mean = Coordinates<double>::Zero(3, 2), squares = mean;
  for (int seed = 1; seed <= seeds; ++seed) {
    State<double> state = scene.start;
    Report report;
    ASSERT_EQ(method(scene, kind, seed)->step(state, 1.0, report), h);
    mean += (state.position - truth) / seeds;
    squares += (state.position - truth).cwiseAbs2() / seeds;
  }
  for (int i : {1, 2})
    for (int c : {0, 1})
      EXPECT_LT(std::abs(mean(i, c)), 4 * std::sqrt(squares(i, c) / seeds)) << "seeds 1 .. 5000";
  if (const auto* law = std::get_if<TruncationLaw>(&kind.law)) {
    const StateVariance predicted = state_variance(series, *law, h);
    // The relative scatter of a sample variance is sqrt((kurtosis - 1) / n); the tails of single terms have some 50.
    EXPECT_NEAR(squares(1, 0) / predicted.position(1, 0), 1.0, 4 * std::sqrt(50.0 / seeds));
  }
}

TEST_P(EveryTruncation, ComputesTheOrdersItDrawsAndNoMore) {  // of two elements, orders 0 .. K-1
  const Problem scene = planets();
  std::uint64_t total = 0;
  for (int seed = 1; seed <= 200; ++seed) {
    const auto one = method(scene, GetParam(), seed);
    State<double> state = scene.start;
    Report report;
    ASSERT_EQ(one->step(state, 1.0, report), h);
    const Work& work = one->work();
    EXPECT_EQ(work.element_coefficients % 2, 0u);
    const auto orders = work.element_coefficients / 2;
    if (GetParam().shared)
      EXPECT_EQ(work.degrees, 2 * orders);  // two planets of degree K
    else
      EXPECT_TRUE(2 * orders >= work.degrees && orders < work.degrees)
          << orders;  // the larger of two degrees
    total += orders;
  }
  const auto degree = std::visit([](const auto& law) { return law.max_degree(); }, GetParam().law);
  EXPECT_LT(total, 200 * 0.8 * degree);
}

TEST_P(EveryTruncation, MovesAlongItsPiece) {
  const Problem scene = planets();
  for (int seed = 1; seed <= 20; ++seed) {
    const auto one = method(scene, GetParam(), seed);
    State<double> state = scene.start;
    Report report;
    ASSERT_EQ(one->step(state, 1.0, report), h);
    const State<double> end = one->piece().at(h);
    EXPECT_LT((end.position - state.position).cwiseAbs().maxCoeff(), 1e-14);  // another order of a few sums
    EXPECT_LT((end.velocity - state.velocity).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST_P(EveryTruncation, RepeatsItselfBitForBit) {
  const Problem scene = planets();
  const auto end = [&](std::uint64_t seed) {
    State<double> state = scene.start;
    EXPECT_EQ(Lockstep(method(scene, GetParam(), seed)).run(state, 20.0, {}).outcome, Outcome::success);
    return state;
  };
  const State<double> first = end(3), again = end(3);
  EXPECT_EQ(first.position, again.position);
  EXPECT_NE(first.position, end(4).position);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryTruncation, ::testing::ValuesIn(kinds()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(SequentialTruncation,
     KnowsAllTermsWhereTheControlReadsThem) {  // the step is the control's, the mean unbiased
  const Problem scene = planets();
  RandomTaylor one(scene.system, sequential(2, 10, 1e-3), std::make_unique<JorbaZou>());
  RandomTaylor fixed(scene.system, fixed_degree(10), std::make_unique<JorbaZou>());
  State<double> state = scene.start, other = scene.start;
  Report report;
  EXPECT_EQ(one.step(state, 1.0, report), fixed.step(other, 1.0, report));
  EXPECT_EQ(one.work().element_coefficients, fixed.work().element_coefficients);
}

TEST(RandomTaylor, RefusesDrawsThatDoNotGoWithTheLaw) {
  const Problem scene = planets();
  EXPECT_THROW(method(scene, {"", geometric(3, 6, 0.3), Draw::ruler, true}, 1), std::invalid_argument);
  EXPECT_THROW(method(scene, {"", sequential(3, 6, 1.0), Draw::ruler, true}, 1), std::invalid_argument);
  EXPECT_THROW(method(scene, {"", geometric(3, 6, 0.5), Draw::stratified, true}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing
