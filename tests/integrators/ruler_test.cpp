// SPDX-License-Identifier: MIT
// Equidistributed draws over 1000 revolutions of a planet, e = .3, velocities by the derivative: where a fixed degree
// loses energy every period and independent draws let it walk, the ruler keeps it, unless it resonates.
//
// `jetlag study ruler` makes the whole table, with 16 seeds; here four of them must do, and each is to pass.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {
namespace {

constexpr double off_resonance = 118.3719;  // steps a period

struct Errors {
  double energy = 0, energy_at_half = 0, position = 0, coefficients = 0;  // the last: of the element, a step
};

/// Root mean squares over the seeds.
Errors errors(const TruncationLaw& law, Draw draws, double steps_a_period, int periods, int seeds) {
  const double step = 2 * std::numbers::pi / steps_a_period;
  const auto steps = static_cast<std::uint64_t>(std::llround(steps_a_period * periods));
  const Problem scene = planet(0.3);
  EnergyMeter meter(scene.system);
  Errors sum;
  for (int seed = 1; seed <= seeds; ++seed) {
    RandomTaylor::Options options{static_cast<std::uint64_t>(seed), true, VelocitySeries::derivative};
    options.draws = draws;
    RandomTaylor method(scene.system, law, std::make_unique<FixedStep>(step), options);
    State<double> state = scene.start;
    Report report;
    const auto energy_error = [&] { return std::pow(meter(state).total() + 0.5, 2) / seeds; };
    for (std::uint64_t n = 0; n < steps; ++n) {
      if (n == steps / 2) sum.energy_at_half += energy_error();
      EXPECT_EQ(method.step(state, 1.0, report), step);
    }
    sum.energy += energy_error();
    const KeplerPoint end = kepler(0.3, static_cast<double>(steps) * step);
    sum.position += (Eigen::RowVector2d(state.position.row(1)) - end.position).squaredNorm() / seeds;
    sum.coefficients +=
        static_cast<double>(method.work().element_coefficients) / static_cast<double>(steps) / seeds;
  }
  return {std::sqrt(sum.energy), std::sqrt(sum.energy_at_half), std::sqrt(sum.position), sum.coefficients};
}

TruncationLaw ruler_law(int base) { return geometric(6, 16, 1 - 1.0 / base); }

TEST(RulerOnAPlanet, IsAHundredTimesAsExactAsDegreeSixForATwentiethOfWorkMore) {
  const Errors fixed = errors(fixed_degree(6), Draw::independent, off_resonance, 1000, 1),
               ruler = errors(ruler_law(5), Draw::ruler, off_resonance, 1000, 4);
  EXPECT_LT(ruler.position, fixed.position / 100);  // 1.9e-3 against 0.85
  EXPECT_LT(ruler.coefficients, 1.06 * fixed.coefficients);
  EXPECT_LT(ruler.energy, 1.5 * ruler.energy_at_half) << "seeds 1 .. 4";
  EXPECT_NEAR(fixed.energy / fixed.energy_at_half, 2.0, 0.02);
}

TEST(RulerOnAPlanet, KeepsEnergyFiftyTimesAsWellAsDegreeSevenForTheSameWork) {
  const Errors fixed = errors(fixed_degree(7), Draw::independent, off_resonance, 1000, 1),
               ruler = errors(ruler_law(2), Draw::ruler, off_resonance, 1000, 4);
  EXPECT_LT(ruler.energy, fixed.energy / 50);  // 8.4e-10 against 2.7e-7
  EXPECT_LT(ruler.coefficients, 1.01 * fixed.coefficients);
}

TEST(RotationOnAPlanet, KeepsEnergyTwiceAsWellAsDegreeSevenForLessWork) {
  // 1-p = phi^2. (The positions of 16 seeds are as exact as those of degree 7, 3.2e-3, no more.)
  const Errors fixed = errors(fixed_degree(7), Draw::independent, off_resonance, 1000, 1),
               golden =
                   errors(geometric(6, 16, std::numbers::phi - 1), Draw::rotation, off_resonance, 1000, 4);
  EXPECT_LT(golden.energy, fixed.energy / 2);  // 1.1e-7 against 2.7e-7
  EXPECT_LT(golden.coefficients, 0.95 * fixed.coefficients);
}

TEST(RulerOnAPlanet, ResonatesWhereItsBaseDividesTheStepsOfAPeriod) {
  // 8 and 5 divide 120: the strong impulses come at the same points of every orbit, and energy runs away.
  for (int base : {2, 5}) {
    const Errors e = errors(ruler_law(base), Draw::ruler, 120, 1000, 4);
    // What runs is 6e-8 and more, what does not some 1e-8 at either time, of any sign.
    EXPECT_NEAR(e.energy / e.energy_at_half, 2.0, 0.2) << "base " << base << ", seeds 1 .. 4";
  }
}

}  // namespace
}  // namespace jetlag::testing
