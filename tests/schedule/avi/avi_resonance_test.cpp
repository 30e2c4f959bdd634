// SPDX-License-Identifier: MIT
// Steps that resonate: where the asynchronous variational integrator is unstable, and how that is avoided.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "jetlag/model/energy.hpp"
#include "schedule/avi/avi_for_tests.hpp"

namespace jetlag::testing::avi_resonance_test {
namespace {

double radius(double h, int r) { return spectral_radius(wall_chain(), wall_chain_steps(h, r), r * h); }

double edge(double stable, double unstable, int r) {
  return edge_of_stability(stable, unstable, [r](double h) { return radius(h, r); });
}

// Chain wall-100-A-1-B-1-wall with the soft springs every r-th step; reference: 75-digit arithmetic.
TEST(AviResonance, HasTheBandsOfTheChainWithRatioTwo) {
  EXPECT_NEAR(edge(0.139, 0.14075, 2), 0.1400000, 1e-7);
  EXPECT_NEAR(edge(0.142, 0.14075, 2), 0.1414213562, 1e-9);
  EXPECT_NEAR(radius(0.14075, 2), 1.0203835232, 1e-9);
}
TEST(AviResonance, HasTheBandsOfTheChainWithRatioFive) {
  EXPECT_NEAR(edge(0.0605, 0.0615, 5), 0.0611770054, 1e-9);
  EXPECT_NEAR(edge(0.0625, 0.0615, 5), 0.0618033989, 1e-9);
  EXPECT_NEAR(radius(0.0615, 5), 1.0166843930, 1e-9);
}
TEST(AviResonance, IsNoneOutsideTheBands) {
  for (const double h : {0.02, 0.06, 0.1, 0.138, 0.1425}) EXPECT_NEAR(radius(h, 2), 1.0, 1e-7) << h;
  for (const double h : {0.01, 0.05, 0.0605, 0.0625}) EXPECT_NEAR(radius(h, 5), 1.0, 1e-7) << h;
}

/// One mass between a fast spring (frequency 1, in steps so short that its oscillation is exact to h^2/24 = 1e-7) and a
/// soft one with an impulse every H: unstable for omega H from pi - 2 atan(H k_s / (2 omega)) to pi.
TEST(AviResonance, BeginsWhereTheFormulaOfTheSoftImpulseSays) {
  for (const double soft : {0.1, 0.05}) {
    System<double> system(1, {1.0});
    system.add<Tether>({{0}, {0}}, {{1.0}, {soft}});
    const auto trace = [&](double H) {  // of the map of one period: the motion is stable where |trace| <= 2
      double sum = 0;
      for (int column = 0; column < 2; ++column) {
        State<double> state{0.0, Coordinates<double>::Zero(1, 1), Coordinates<double>::Zero(1, 1)};
        (column == 0 ? state.position : state.velocity)(0, 0) = 1.0;
        Avi avi(system, {{H / 2048, H}});
        EXPECT_EQ(avi.run(state, H, {}).outcome, Outcome::success);
        sum += column == 0 ? state.position(0, 0) : state.velocity(0, 0);
      }
      return sum;
    };
    const auto formula = [&](double H) { return H - std::numbers::pi + 2 * std::atan(H * soft / 2); };
    double low = 2, high = 3.1, stable = 2.5, unstable = 3.05;
    for (int i = 0; i < 30; ++i) {
      (formula(0.5 * (low + high)) > 0 ? high : low) = 0.5 * (low + high);
      (trace(0.5 * (stable + unstable)) < -2 ? unstable : stable) = 0.5 * (stable + unstable);
    }
    EXPECT_NEAR(low, soft == 0.1 ? 2.8577400224 : 2.9922579033, 1e-8);
    EXPECT_NEAR(stable, low, 1e-6);
  }
}

// ---- the cure ----------------------------------------------------------------------------------------------

/// The largest energy over that of the start, looked at every so often during a million impulses.
double largest_growth(const ElementSteps& steps, std::uint64_t impulses) {
  const Problem chain = wall_chain();
  State<double> state = chain.start;
  state.position(1, 0) += 0.01;
  state.velocity(2, 0) = 0.1;
  EnergyMeter energy(chain.system);
  const double begin = energy(state).total();
  Avi avi(chain.system, steps);
  double largest = 1;
  for (int i = 0; i < 1000 && avi.work().steps < impulses; ++i) {
    const Report report = avi.run(state, state.time + 1e-3 * impulses * steps[0][0], {});
    if (report.outcome != Outcome::success) return HUGE_VAL;
    largest = std::max(largest, energy(state).total() / begin);
  }
  return largest;
}

TEST(AviResonance, IsAvoidedByStepsThatNestBelowIt) {
  // A hundred periods of the plain steps multiply the motion by 1.02^100 = 7 and more; a million impulses overflow it.
  // Cured, the energy stays within what leapfrog near its limit makes of it: with omega h / 2 = 0.7 the energy that it
  // conserves is 1 - 0.49 of the potential one, so that the total is at most 1/(1 - 0.49) = 1.96 of that of the start.
  const Problem chain = wall_chain();
  for (const auto& [h, r] : {std::pair(0.14075, 2), std::pair(0.0615, 5)}) {
    const ElementSteps plain = wall_chain_steps(h, r), cured = without_resonance(chain.system, plain);
    EXPECT_EQ(largest_growth(plain, 1'000'000), HUGE_VAL);
    EXPECT_LT(largest_growth(cured, 1'000'000), 2.0);
    EXPECT_EQ(cured[0][0], h);                   // the shortest step stays
    EXPECT_EQ(cured[0][1], r == 5 ? 2 * h : h);  // 4 h would be at 0.80 pi
  }
}

TEST(AviResonance, IsAvoidedWhereManySoftElementsMakeAMassFast) {
  // A mass on 14 springs of k = 1, omega = sqrt(14), beside a pair with k = 2, omega = 2: each spring by itself allows
  // steps of 2, together they allow 2/sqrt(14) = .53. At .6 = 8 x .075 they are at .71 pi, and the mass is thrown about.
  System<double> system(1, std::vector<double>(17, 1.0));
  for (int i = 1; i <= 14; ++i) system.fix(i);
  for (int i = 1; i <= 14; ++i) system.add<LinearSpring>({{0, i}}, {{1.0}});
  system.add<LinearSpring>({{15, 16}}, {{2.0}});
  State<double> start{0.0, Coordinates<double>::Zero(17, 1), Coordinates<double>::Zero(17, 1)};
  start.position(0, 0) = start.position(15, 0) = 0.1;
  EnergyMeter energy(system);
  const auto growth = [&](const ElementSteps& steps) {
    State<double> state = start;
    Avi avi(system, steps);
    if (avi.run(state, 200.0, {}).outcome != Outcome::success) return HUGE_VAL;
    return energy(state).total() / energy(start).total();
  };
  ElementSteps plain = equal_steps(system, 0.6);
  plain.back()[0] = 0.075;
  EXPECT_GT(growth(plain), 1e10);
  // Halved, as leapfrog: .3 sqrt(14) / 2 = .56, at most 1/(1 - .56^2) = 1.46 of the start.
  EXPECT_LT(growth(without_resonance(system, plain)), 1.5);
}

TEST(AviResonance, IsAvoidedByAThirdOfPi) {
  // The longest steps H nest up to the limit of leapfrog of the bound on the frequency, and no farther. As many short steps
  // of h as there are in H turn the fastest oscillation by less than 2/3 pi then, whatever H / h.
  const Problem chain = wall_chain();
  const double omega = std::sqrt(103.0);
  for (int i = 1; i < 200; ++i) {
    const double h = 2 / omega * i / 200.0;
    const ElementSteps cured = without_resonance(chain.system, wall_chain_steps(h, 256));
    const double H = cured[0][1];
    EXPECT_LT(H * omega, 2.0) << h;
    EXPECT_TRUE(2 * H * omega >= 2.0 || H == 256 * h) << h;
    if (H > h) {
      EXPECT_LT(H * 2 / h * std::asin(h * omega / 2), 2 * std::numbers::pi / 3) << h;
    }
  }
}

TEST(AviResonance, IsAvoidedAtEveryStepThatLeapfrogCouldTake) {
  const Problem chain = wall_chain();
  const double limit = 2 / std::sqrt(103.0);  // of the bound on the frequency
  for (int i = 1; i < 200; ++i) {
    const double h = limit * i / 200.0;
    const ElementSteps cured = without_resonance(chain.system, wall_chain_steps(h, 64));
    EXPECT_NEAR(spectral_radius(chain, cured, cured[0][1]), 1.0, 1e-7)
        << "h = " << h << ", ratio " << cured[0][1] / h;
  }
}

}  // namespace
}  // namespace jetlag::testing::avi_resonance_test
