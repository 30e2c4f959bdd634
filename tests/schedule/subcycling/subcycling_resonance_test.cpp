// SPDX-License-Identifier: MIT
// Steps that resonate: where subcycling is unstable, and how that is avoided.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jetlag/control/courant.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/truncation/draws.hpp"
#include "schedule/subcycling/subcycling_for_tests.hpp"

namespace jetlag::testing::subcycling_resonance_test {
namespace {

/// Of the chain wall-100-A-1-B-1-wall: p / q steps h of A are one of B, in `p` of A they meet.
double radius(double h, int p, int q = 1) {
  return cycle_radius(wall_chain(), coarse_b(h, static_cast<double>(p) / q), h, p);
}

double edge(double stable, double unstable, int p, int q = 1) {
  return edge_of_stability(stable, unstable, [=](double h) { return radius(h, p, q); });
}

// Reference: 75-digit arithmetic.
TEST(SubcyclingResonance, HasTheBandOfTheChainWithRatioFour) {
  EXPECT_NEAR(edge(0.1260, 0.12725, 4), 0.1268403737, 1e-9);
  EXPECT_NEAR(edge(0.1285, 0.12725, 4), 0.1276082943, 1e-9);
  EXPECT_NEAR(radius(0.12725, 4), 1.0112361938, 1e-9);
}
TEST(SubcyclingResonance, HasTheBandOfTheChainWithRatioFive) {
  EXPECT_NEAR(edge(0.1035, 0.1045, 5), 0.1041663835, 1e-9);
  EXPECT_NEAR(edge(0.1055, 0.1045, 5), 0.1048236827, 1e-9);
  EXPECT_NEAR(radius(0.1045, 5), 1.0110089606, 1e-9);
}
TEST(SubcyclingResonance, IsTheLimitOfLeapfrogWithRatioOne) {
  EXPECT_NEAR(edge(0.198, 0.2, 1), 0.1989974874, 2e-9);
}
TEST(SubcyclingResonance, HasBandsForRealRatios) {
  // Edges and radii of 5/2 from a loop over plain matrices.
  EXPECT_NEAR(edge(0.1785, 0.17975, 5, 2), 0.1794743683, 1e-8);
  EXPECT_NEAR(edge(0.1810, 0.17975, 5, 2), 0.1800768707, 1e-8);
  EXPECT_NEAR(radius(0.1795, 5, 2), 1.0075812, 1e-6);
  EXPECT_NEAR(radius(0.17975, 5, 2), 1.018873, 1e-6);
  EXPECT_NEAR(radius(0.16, 3, 2), 1.0023, 5e-5);
  EXPECT_NEAR(radius(0.14225, 7, 3), 1.0013, 5e-5);
  EXPECT_NEAR(radius(0.1865, 7, 3), 1.0239, 5e-5);
}
TEST(SubcyclingResonance, IsNoneOutsideTheBands) {
  // A radius of 1 is known to the root of rounding where two eigenvalues are close.
  for (const double h : {0.02, 0.05, 0.1, 0.12, 0.1265, 0.128, 0.14}) EXPECT_NEAR(radius(h, 4), 1, 1e-7) << h;
  for (const double h : {0.02, 0.06, 0.0985, 0.1035, 0.1055}) EXPECT_NEAR(radius(h, 5), 1, 1e-7) << h;
  for (const double h : {0.1, 0.15, 0.178, 0.182}) EXPECT_NEAR(radius(h, 5, 2), 1, 1e-7) << h;
}

// ---- the cure ----------------------------------------------------------------------------------------------

/// The largest energy over that of the start, looked at a thousand times during so many steps of the shortest clock.
double largest_growth(const ParticleSteps& steps, double shortest_steps) {
  const Problem chain = wall_chain();
  State<double> state = chain.start;
  state.position(1, 0) += 0.01;
  state.velocity(2, 0) = 0.1;
  EnergyMeter energy(chain.system);
  const double begin = energy(state).total();
  Subcycling method(chain.system, steps);
  double largest = 1;
  for (int i = 0; i < 1000; ++i) {
    const Report report = method.run(state, state.time + 1e-3 * shortest_steps * steps[1], {});
    if (report.outcome != Outcome::success) return HUGE_VAL;
    largest = std::max(largest, energy(state).total() / begin);
  }
  return largest;
}

TEST(SubcyclingResonance, IsAvoidedByStepsThatNestBelowIt) {
  // Plain steps multiply the motion by 1.011 a cycle and overflow it. Cured, all of these are leapfrog at the short step,
  // which conserves an energy with 1 - (h omega / 2)^2 of the potential one: so much less than the total is the bound.
  const Problem chain = wall_chain();
  for (const auto& [h, r] : {std::pair(0.12725, 4.0), std::pair(0.1045, 5.0), std::pair(0.17975, 2.5)}) {
    const ParticleSteps plain = coarse_b(h, r), cured = without_resonance(chain.system, plain);
    EXPECT_EQ(largest_growth(plain, 1e6), HUGE_VAL);
    EXPECT_LT(largest_growth(cured, 1e6), 1 / (1 - h * h * 103 / 4));
    EXPECT_EQ(cured[1], h);
    EXPECT_EQ(cured[2], h);
  }
}

TEST(SubcyclingResonance, LeavesStepsThatCannotResonate) {
  // h omega = 0.3: up to a quarter of a period there is room for 4 h, and a million steps stay within the modified
  // energy of steps 4 h, 1/(1 - 0.36) of that of the start.
  const Problem chain = wall_chain();
  const double h = 0.03;
  for (const auto& [wanted, given] :
       {std::pair(1.0, 1), {1.9, 1}, {2.0, 2}, {3.9, 2}, {4.0, 4}, {7.0, 4}, {100.0, 4}}) {
    const ParticleSteps cured = without_resonance(chain.system, coarse_b(h, wanted));
    EXPECT_EQ(cured[1], h);
    EXPECT_EQ(cured[2], given * h) << wanted;
  }
  EXPECT_LT(largest_growth(coarse_b(h, 4), 1e6), 1.6);
}

TEST(SubcyclingResonance, IsAvoidedOnAnyChain) {
  // Chains of two to seven masses, stiffnesses from 1 to 1000, each mass with a step of its own, as long as it likes: the
  // radius of the cycle is 1 to the root of rounding; without the cure most of them blow up.
  int stable = 0, chains = 0, subcycled = 0;
  std::uint64_t drawn = 0;
  const auto random = [&] { return uniform(7, 0, drawn++); };
  for (; chains < 150; ++chains) {
    std::vector<double> stiffness(3 + static_cast<int>(6 * random()));
    for (double& k : stiffness) k = std::pow(1000, random());
    const Problem chain = chain_between_walls(stiffness);
    const double h = 2 / frequency_bound(chain.system) * std::pow(0.02, random());
    ParticleSteps steps(chain.system.particles());
    for (double& step : steps) step = std::ldexp(h, static_cast<int>(6 * random()));
    steps[1] = h;
    const auto longest = [&](const ParticleSteps& of) {
      return *std::max_element(of.begin() + 1, of.end() - 1);
    };
    const auto radius_of = [&](const ParticleSteps& of) { return cycle_radius(chain, of, longest(of), 1); };
    const ParticleSteps cured = without_resonance(chain.system, steps);
    EXPECT_NEAR(radius_of(cured), 1.0, 1e-7) << "chain " << chains;
    subcycled += longest(cured) > h;
    stable += radius_of(steps) < 1 + 1e-7;
  }
  EXPECT_GT(subcycled, chains / 2);
  EXPECT_LT(stable, chains / 2);
}

TEST(SubcyclingResonance, IsRefusedBeyondTheLimitOfTheShortestStep) {
  const Problem chain = wall_chain();
  EXPECT_THROW(without_resonance(chain.system, coarse_b(0.2, 4)), std::invalid_argument);
  EXPECT_THROW(without_resonance(planet(0.5).system, {0.1, 0.1}), std::invalid_argument);  // no stiffness
}

}  // namespace
}  // namespace jetlag::testing::subcycling_resonance_test
