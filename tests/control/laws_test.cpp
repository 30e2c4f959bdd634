// SPDX-License-Identifier: MIT
// What every control that looks at the series obeys, and what each of them promises beyond that.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/halve_double.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/control/variance_target.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::laws_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What a control proposes in a state, where no more is known than it asks for. Asked `times` times, as a run would.
double proposal(Control& control, const Problem& scene, const TruncationLaw& law, int times = 1) {
  Expansion<double> series(scene.system);
  series.start(scene.start);
  series.grow_to(std::max(1, control.orders_read(law, VelocitySeries::own_series)));
  double h = 0;
  for (int i = 0; i < times; ++i) h = control.propose({series, law});
  return h;
}

// ---- laws -------------------------------------------------------------------------------------------------

/// A control as the laws see it. error: its tolerance for one step, as a length [m]; times that are
/// parameters are given in units of `unit`.
struct Member {
  std::string name;
  std::function<std::unique_ptr<Control>(const TruncationLaw& law, double error, double max_step,
                                         double unit)>
      make;
};
void PrintTo(const Member& member, std::ostream* out) { *out << member.name; }

const std::vector<Member> members = {
    {"JorbaZou",  // its tolerance is the degree
     [](const TruncationLaw&, double, double max_step, double) {
       return std::make_unique<JorbaZou>(max_step);
     }},
    {"LastTwo", [](const TruncationLaw&, double error, double max_step,
                   double) { return std::make_unique<LastTwo>(error, max_step); }},
    {"HalveDouble",
     [](const TruncationLaw& law, double error, double max_step, double unit) {
       const double max_variance = error * error;
       return std::make_unique<HalveDouble>(std::min(0.1 * unit, max_step), max_step,
                                            max_variance / std::pow(4.0, law.min_degree() + 2), max_variance,
                                            law.min_degree());
     }},
    {"VarianceTarget",
     [](const TruncationLaw&, double error, double max_step, double unit) {
       return std::make_unique<VarianceTarget>(std::min(0.1 * unit, max_step), max_step, error, error);
     }},
};
const std::vector<TruncationLaw> truncations = {geometric(3, 6, 0.5), geometric(4, 16, 0.25), fixed_degree(6),
                                                fixed_degree(20)};

class ControlLaws : public ::testing::TestWithParam<Member> {};
INSTANTIATE_TEST_SUITE_P(, ControlLaws, ::testing::ValuesIn(members),
                         [](const auto& info) { return info.param.name; });

TEST_P(ControlLaws, TimeRunningTwiceAsFastHalvesTheStep) {
  // The circle at speeds of 1, 2, 4. Powers of 2 are exact.
  for (const TruncationLaw& law : truncations)
    for (int times : {1, 20}) {
      std::vector<double> h;
      for (double speed : {1.0, 2.0, 4.0}) {
        const Problem scene = circular_oscillator(speed);
        const double unit = 1 / speed;
        h.push_back(proposal(*GetParam().make(law, 1e-6, infinity, unit), scene, law, times) * speed);
      }
      // pow() of scaled arguments: a few roundings.
      EXPECT_NEAR(h[1], h[0], 1e-14 * h[0]);
      EXPECT_NEAR(h[2], h[0], 1e-14 * h[0]);
    }
}

TEST_P(ControlLaws, NoStepGrowsAsTheToleranceShrinks) {
  const Problem scene = circular_oscillator();
  for (const TruncationLaw& law : truncations) {
    double last = infinity;
    for (double error = 1e-2; error > 1e-13; error /= 10) {
      const double h = proposal(*GetParam().make(law, error, infinity, 1.0), scene, law, 50);
      EXPECT_LE(h, last);
      last = h;
    }
    if (GetParam().name != "JorbaZou") {
      EXPECT_LT(last, 0.7 * proposal(*GetParam().make(law, 1e-2, infinity, 1.0), scene, law, 50));
    }
  }
}

TEST_P(ControlLaws, SeriesThatEndGiveTheLargestStep) {
  Problem rest = oscillator(1.0, 0.0, 0.0), fall = free_fall();
  for (const TruncationLaw& law : truncations)
    for (const Problem* scene : {&rest, &fall}) {
      // Those that remember a step double it every time: 0.1 2^7 > 10.
      EXPECT_EQ(proposal(*GetParam().make(law, 1e-6, 10.0, 1.0), *scene, law, 7), 10.0);
      EXPECT_FALSE(std::isnan(proposal(*GetParam().make(law, 1e-6, infinity, 1.0), *scene, law, 2000)));
    }
}

TEST_P(ControlLaws, NoStepIsBeyondTheLargest) {
  const Problem scene = circular_oscillator();
  for (const TruncationLaw& law : truncations)
    for (double max_step : {1e-3, 0.01, 0.05})
      EXPECT_LE(proposal(*GetParam().make(law, 1.0, max_step, 1.0), scene, law, 10), max_step);
}

TEST_P(ControlLaws, NoStepIsBeyondTheRadiusOfConvergence) {
  // x'' = 2 x^3 from x = 1, x' = 1 is x = 1/(1-t).
  System<double> system(1, {1.0});
  system.add<CubicPush>({{0}}, {{}});
  const Problem scene{std::move(system),
                      {0.0, Coordinates<double>::Ones(1, 1), Coordinates<double>::Ones(1, 1)}};
  for (const TruncationLaw& law : truncations)
    EXPECT_LT(proposal(*GetParam().make(law, 0.5, infinity, 1.0), scene, law, 50), 1.0);
}

TEST_P(ControlLaws, ACopyGoesOnAsTheOriginal) {
  const Problem scene = circular_oscillator();
  const TruncationLaw law = geometric(3, 6, 0.5);
  const auto control = GetParam().make(law, 1e-6, infinity, 1.0);
  proposal(*control, scene, law, 3);
  const auto copy = control->clone();
  for (VelocitySeries velocity : {VelocitySeries::own_series, VelocitySeries::derivative})
    EXPECT_EQ(copy->orders_read(law, velocity), control->orders_read(law, velocity));
  EXPECT_EQ(proposal(*copy, scene, law), proposal(*control, scene, law));
}

TEST_P(ControlLaws, AdaptsWhereTheDegreeIsFixed) {
  // There the variance vanishes and the bias decides: twice as fast a motion gets a shorter step.
  const TruncationLaw law = fixed_degree(6);
  const double slow = proposal(*GetParam().make(law, 1e-6, infinity, 1.0), circular_oscillator(1.0), law, 50);
  const double fast = proposal(*GetParam().make(law, 1e-6, infinity, 1.0), circular_oscillator(4.0), law, 50);
  EXPECT_LT(fast, 0.51 * slow);
  EXPECT_LT(slow, 10.0);
}

// ---- HalveDouble and VarianceTarget over a run ------------------------------------------------------------

/// The steps of 10^4 updates on a circle, where the size of every derivative is constant, and the largest
/// errors.
struct Trace {
  std::vector<double> steps;
  double largest_variance = 0, largest_bias = 0;  // after the first 100 steps
  int changes = 0;                                // of the step, after the first 100
};
Trace trace(Control& control, const TruncationLaw& law) {
  const Problem scene = circular_oscillator();
  Expansion<double> series(scene.system, law.max_degree());
  State<double> state = scene.start;
  Trace result;
  const int n = law.max_degree();
  for (int i = 0; i < 10'000; ++i) {
    series.start(state);
    series.grow_to(n + 1);
    const double h = control.propose({series, law});
    // Along the exact motion, so that what is seen is the control alone.
    state.time += h;
    state.position << std::cos(state.time), std::sin(state.time);
    state.velocity << -std::sin(state.time), std::cos(state.time);
    if (i >= 100) {
      // Of each component, by the closed form for the terms of cos(t + h): not by the control's own sum.
      for (int c = 0; c < 2; ++c) {
        std::vector<double> terms(n + 1);
        for (int k = 0; k <= n; ++k) terms[k] = series.position(k)(0, c) * std::pow(h, k);
        result.largest_variance = std::max(result.largest_variance, variance(law, terms));
        result.largest_bias = std::max({result.largest_bias, std::abs(terms[n]), std::abs(terms[n - 1])});
      }
      result.changes += h != result.steps.back();
    }
    result.steps.push_back(h);
  }
  return result;
}

TEST(HalveDouble, MeetsItsThresholdsWithoutALimitCycle) {
  for (const TruncationLaw& law : {geometric(3, 6, 0.5), geometric(4, 16, 0.5), fixed_degree(5)}) {
    // The variance changes by 4^(m+1) with the step and by 2 with the phase of the motion (cos^2 or sin^2,
    // the larger of the two); beyond that the step has no reason to change.
    const double max_variance = 1e-12, ratio = 4 * std::pow(4.0, law.min_degree() + 1);
    HalveDouble control(1.0, 10.0, max_variance / ratio, max_variance, law.min_degree());
    const Trace r = trace(control, law);
    EXPECT_LE(r.largest_variance + r.largest_bias * r.largest_bias, 2 * max_variance);
    EXPECT_EQ(r.changes, 0);
    EXPECT_LT(r.steps.back(), 1.0);
  }
}

TEST(HalveDouble, TakesTheFirstHalvingThatFits) {
  // x_4 = 1/24 on the circle: Var = h^8 / 576 to leading order; 1e-12 asks for h = 0.07, and 1/16 is the half
  // below. The bias, some h^11 / 11!, is far smaller.
  HalveDouble control(1.0, 10.0, 1e-12 / 1024, 1e-12, 3);
  const TruncationLaw law = geometric(3, 12, 0.5);
  EXPECT_EQ(proposal(control, circular_oscillator(), law), 0.0625);
}

TEST(HalveDouble, DoublesUpToItsLargestStepAndNotBeyond) {
  const TruncationLaw law = geometric(3, 6, 0.5);
  HalveDouble control(0.25, 1.5, 1e-3, 1.0, 3);
  const Problem rest = oscillator(1.0, 0.0, 0.0);
  EXPECT_EQ(proposal(control, rest, law), 0.5);
  EXPECT_EQ(proposal(control, rest, law), 1.0);
  EXPECT_EQ(proposal(control, rest, law), 1.5);
  EXPECT_EQ(proposal(control, rest, law), 1.5);
}

TEST(HalveDouble, RefusesThresholdsThatAreTooClose) {
  const auto made = [](double ratio, int m) { return [=] { HalveDouble(0.1, 1.0, 1e-9, ratio * 1e-9, m); }; };
  const auto refused = ThrowsMessage<std::invalid_argument>(
      ::testing::AllOf(HasSubstr("max_variance / min_variance"), HasSubstr("4^(min_degree+1)")));
  EXPECT_THAT(made(255, 3), refused);
  EXPECT_THAT(made(1e4, 6), refused);
  EXPECT_THAT([] { HalveDouble(0.1, 1.0, 1.0, 256.0, 3); }, refused);  // exactly 4^4
  EXPECT_NO_THROW(made(257, 3)());
  EXPECT_NO_THROW(made(16385, 6)());
}

TEST(VarianceTarget, MeetsItsTolerancesWithoutALimitCycle) {
  struct Case {
    TruncationLaw law;
    double random, bias;
  };
  for (const Case& c : {Case{geometric(3, 6, 0.5), 1e-6, 1.0},
                        {geometric(3, 6, 0.5), 1.0, 1e-8},
                        {geometric(4, 16, 0.5), 1e-9, 1e-9},
                        {fixed_degree(6), 1e-9, 1e-9}}) {
    VarianceTarget control(1.0, 10.0, c.random, c.bias);
    const Trace r = trace(control, c.law);
    EXPECT_LE(std::sqrt(r.largest_variance), c.random);
    EXPECT_LE(r.largest_bias, c.bias);
    // Steady: with the phase the errors change by sqrt 2, the step by the root of that of order >= 4.
    const auto [least, largest] = std::minmax_element(r.steps.begin() + 100, r.steps.end());
    EXPECT_LT(*largest / *least, 1.1 * std::pow(2.0, 0.5 / 4));
    // And no shorter than needed: 0.9 of what the tolerance allows, and sqrt 2 of the phase, again.
    EXPECT_GT(std::max(std::sqrt(r.largest_variance) / c.random, r.largest_bias / c.bias), std::pow(0.8, 7));
  }
}

TEST(VarianceTarget, ReachesTheToleranceToLeadingOrder) {
  // (3, 4, .5) on the circle: sqrt(Var) = h^4 / 24 for the larger component, exactly; h = 0.9 (24 tol)^(1/4)
  // is the fixed point once it is approached from below.
  VarianceTarget control(0.01, 10.0, 1e-6, 1.0);
  const TruncationLaw law = geometric(3, 4, 0.5);
  EXPECT_NEAR(proposal(control, circular_oscillator(), law, 50), 0.9 * std::pow(24e-6, 0.25), 1e-12);
}

TEST(VarianceTarget, GrowsByTwoAtMost) {
  VarianceTarget control(1e-3, 10.0, 1e-3, 1e-3);
  const TruncationLaw law = geometric(3, 6, 0.5);
  EXPECT_DOUBLE_EQ(proposal(control, circular_oscillator(), law), 2e-3);
}

// ---- refusals, FixedStep -------------------------------------------------------------------------------------

TEST(Controls, RefuseStepsAndTolerancesThatAreNotPositiveByName) {
  const auto refused = [](const char* name) { return ThrowsMessage<std::invalid_argument>(HasSubstr(name)); };
  for (double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT([bad] { (void)FixedStep(bad); }, refused("step must be > 0"));
    EXPECT_THAT([bad] { (void)JorbaZou(bad); }, refused("max_step must be > 0"));
    EXPECT_THAT([bad] { VarianceTarget(bad, 1, 1, 1); }, refused("step must be > 0"));
    EXPECT_THAT([bad] { VarianceTarget(1, bad, 1, 1); }, refused("max_step must be > 0"));
    EXPECT_THAT([bad] { VarianceTarget(1, 1, bad, 1); }, refused("tolerance_random must be > 0"));
    EXPECT_THAT([bad] { VarianceTarget(1, 1, 1, bad); }, refused("tolerance_bias must be > 0"));
    EXPECT_THAT([bad] { HalveDouble(bad, 1, 1, 1e9, 3); }, refused("step must be > 0"));
    EXPECT_THAT([bad] { HalveDouble(1, bad, 1, 1e9, 3); }, refused("max_step must be > 0"));
    EXPECT_THAT([bad] { HalveDouble(1, 1, bad, 1e9, 3); }, refused("min_variance must be > 0"));
    EXPECT_THAT([bad] { HalveDouble(1, 1, 1, bad, 3); }, refused("max_variance must be > 0"));
  }
  EXPECT_THAT([] { (void)FixedStep(infinity); }, refused("step must be > 0"));
  EXPECT_THAT([] { HalveDouble(2, 1, 1, 1e9, 3); }, refused("step must not exceed max_step"));
}

TEST(FixedStep, IsTheSameEveryTime) {
  FixedStep control(0.125);
  EXPECT_EQ(control.orders_read(fixed_degree(3), VelocitySeries::own_series), 0);
  EXPECT_EQ(proposal(control, oscillator(), fixed_degree(3), 5), 0.125);
  EXPECT_EQ(proposal(*control.clone(), oscillator(), fixed_degree(3)), 0.125);
}

}  // namespace
}  // namespace jetlag::testing::laws_test
