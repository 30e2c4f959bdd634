// SPDX-License-Identifier: MIT
// The ruler on a coupled scene at equal work: a chain of 32 masses between walls, springs d + d^3, until T = 496.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::ruler_chain_test {
namespace {

constexpr double until = 496;

struct End {
  Coordinates<double> position;
  double coefficients;  // a step
};

End end_of(const TruncationLaw& law, std::unique_ptr<Control> control, RandomTaylor::Options options) {
  const Problem scene = fput();
  State<double> state = scene.start;
  Lockstep run(std::make_unique<RandomTaylor>(scene.system, law, std::move(control), options));
  EXPECT_EQ(run.run(state, until, {}).outcome, Outcome::success);
  return {state.position,
          static_cast<double>(run.work().element_coefficients) / static_cast<double>(run.work().steps)};
}

class RulerOnAChain : public ::testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(RulerOnAChain, IsTwoHundredTimesAsExactAsAFixedDegreeOfTheSameWork) {
  const auto [m, step] = GetParam();
  RandomTaylor::Options exact;
  exact.compensated = true;
  static const Coordinates<double> truth =
      end_of(fixed_degree(20), std::make_unique<JorbaZou>(), exact).position;
  const End fixed = end_of(fixed_degree(m + 1), std::make_unique<FixedStep>(step), {});
  const double miss = (fixed.position - truth).cwiseAbs().maxCoeff();
  double squares = 0;
  for (int seed = 1; seed <= 8; ++seed) {
    RandomTaylor::Options options;
    options.seed = seed;
    options.draws = Draw::ruler;
    const End ruler = end_of(geometric(m, 16, 0.5), std::make_unique<FixedStep>(step), options);
    squares += std::pow((ruler.position - truth).cwiseAbs().maxCoeff(), 2) / 8;
    EXPECT_NEAR(ruler.coefficients / fixed.coefficients, 1.0, 0.01);
  }
  EXPECT_LT(std::sqrt(squares), miss / 200) << "seeds 1 .. 8";
}

INSTANTIATE_TEST_SUITE_P(Steps, RulerOnAChain,
                         ::testing::Combine(::testing::Values(3, 4, 5), ::testing::Values(0.31, 0.155)));

}  // namespace
}  // namespace jetlag::testing::ruler_chain_test
