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
#include "support/scenes_for_tests.hpp"

namespace jetlag::testing {
namespace {

/// F = d + d^3 on the first, d = x_1 - x_0; the opposite on the second.
struct HardeningSpring {
  static constexpr const char* name = "hardening spring";
  static constexpr int participants = 2;
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return T(T(1.0) + d.squaredNorm()) * d;
  }
};

/// q_i = .1 sin(2 pi i / 33) + .02 sin(9 pi i / 33) at rest; particles 0 and 33 are the walls. Displacements, not
/// places.
Scene chain() {
  System<double> system(1, std::vector<double>(34, 1.0));
  system.fix(0);
  system.fix(33);
  std::vector<std::array<int, 2>> pairs;
  for (int i = 0; i < 33; ++i) pairs.push_back({i, i + 1});
  system.add<HardeningSpring>(pairs, std::vector<std::array<double, 0>>(33));
  State<double> start{0.0, Coordinates<double>::Zero(34, 1), Coordinates<double>::Zero(34, 1)};
  for (int i = 1; i <= 32; ++i)
    start.position(i, 0) =
        0.1 * std::sin(2 * std::numbers::pi * i / 33) + 0.02 * std::sin(9 * std::numbers::pi * i / 33);
  return {std::move(system), std::move(start)};
}

constexpr double until = 496;

struct End {
  Coordinates<double> position;
  double coefficients;  // a step
};

End end_of(const TruncationLaw& law, std::unique_ptr<Control> control, RandomTaylor::Options options) {
  const Scene scene = chain();
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
}  // namespace jetlag::testing
