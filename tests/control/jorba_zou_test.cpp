// SPDX-License-Identifier: MIT
// The step of Jorba and Zou: what it is on series in closed form, and that it knows neither units nor special points.
#include "jetlag/control/jorba_zou.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "jetlag/forces/gravity.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/motion/first_order.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"
#include "support/random.hpp"

namespace jetlag::testing::jorba_zou_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double eps = std::numeric_limits<double>::epsilon();
double sigma(int p) { return std::exp(-2 - 0.5 / (p - 1)); }

// ---- the rule on norms ------------------------------------------------------------------------------------

TEST(JorbaZouStep, IsSigmaTimesTheRadiusOfAGeometricSeries) {
  // c_n = 3 r^-n: every ratio gives r. Exponents of 2 up to 20 * 27, divided by 19: 30 roundings.
  for (double r : {1.0, 0.1, 7.0, 1e-8, 1e8}) {
    std::vector<double> norms(21);
    for (int n = 0; n <= 20; ++n) norms[n] = 3 * std::pow(r, -n);
    EXPECT_NEAR(jorba_zou_step(norms, infinity), r * sigma(20), 100 * eps * r) << r;
  }
}

TEST(JorbaZouStep, MeetsItsConditionAndNoLongerStepDoes) {
  // Random norms over twelve decades, some of them zero.
  Uniform random(1);
  for (int run = 0; run < 1000; ++run) {
    const int p = 2 + run % 30;
    std::vector<double> norms(p + 1);
    for (double& c : norms) c = random(0, 1) < 0.3 ? 0.0 : std::pow(10.0, random(-6, 6));
    norms[0] = norms[p] = 1.0;
    const double h = jorba_zou_step(norms, infinity);
    const auto met = [&](double step) {
      for (int q : {p - 1, p}) {
        double most = 0;
        for (int n = 0; n < q; ++n) most = std::max(most, norms[n] * std::pow(step, n));
        if (norms[q] * std::pow(step, q) > std::pow(sigma(p), q) * most) return false;
      }
      return true;
    };
    EXPECT_TRUE(met(h * (1 - 1e-12))) << "seed 1, run " << run;
    EXPECT_FALSE(met(h * (1 + 1e-12))) << "seed 1, run " << run;
    EXPECT_EQ(jorba_zou_step(norms, 0.5 * h), 0.5 * h);
    EXPECT_EQ(jorba_zou_step(norms, 2 * h), h);
  }
}

TEST(JorbaZouStep, KnowsNoUnits) {
  // The coefficients of the exponential in other units, as far as doubles go; those of time are what the tenth power of
  // still fits beside the length.
  std::vector<double> norms(11);
  const auto step = [&](int length, int time) {
    for (int n = 0; n <= 10; ++n) norms[n] = std::ldexp(1 / std::tgamma(n + 1.0), length - n * time);
    return std::ldexp(jorba_zou_step(norms, infinity), -time);
  };
  const double h = step(0, 0);
  for (int length : {-500, -50, 50, 500})
    for (int time : {-45, -5, 5, 45}) EXPECT_NEAR(step(length, time), h, 1e-12 * h) << length << " " << time;
}

TEST(JorbaZouStep, IsTheLargestAllowedWhereNothingBoundsIt) {
  EXPECT_EQ(jorba_zou_step(std::array{1.0, 2.0, 3.0, 0.0, 0.0}, infinity), infinity);
  EXPECT_EQ(jorba_zou_step(std::array{1.0, 2.0, 3.0, 0.0, 0.0}, 10.0), 10.0);
  EXPECT_EQ(jorba_zou_step(std::array{0.0, 0.0, 0.0}, 10.0), 10.0);
  EXPECT_EQ(jorba_zou_step(std::array{0.0, 0.0, 0.0, 1.0}, 10.0), 10.0);  // against what?
  EXPECT_EQ(jorba_zou_step(std::array{1.0, infinity, 1.0}, 10.0), 0.0);
  EXPECT_EQ(jorba_zou_step(std::array{1.0, std::nan(""), 1.0}, 10.0), 0.0);
  EXPECT_THROW(jorba_zou_step(std::array{1.0}, 10.0), std::invalid_argument);
}

TEST(JorbaZouStep, IsNotMisledWhereTheLastTwoVanish) {
  // A series with radius 1/4 of which cancellation has taken the last coefficients: those before them stand in. A series
  // that ends in its first half ends there.
  std::vector<double> norms(21);
  for (int taken : {2, 5, 9}) {
    for (int n = 0; n <= 20; ++n) norms[n] = n > 20 - taken ? 0.0 : std::pow(4, n);
    EXPECT_NEAR(jorba_zou_step(norms, 10.0), sigma(20) / 4, 1e-15) << taken;
  }
  norms[11] = 0;
  EXPECT_EQ(jorba_zou_step(norms, 10.0), 10.0);
}

TEST(JorbaZouStep, ServesFirstOrderSystems) {
  // y' = y^2 is y_0 / (1 - y_0 t).
  FirstOrderExpansion<> series([](const auto&, const auto& y) { return std::array{y[0] * y[0]}; }, 1);
  series.start(0.0, {0.25});
  series.grow_to(20);
  EXPECT_NEAR(jorba_zou_step(series[0], infinity), 4 * sigma(20), 1e-14);
}

TEST(JorbaZouDegree, IsTwentyForDoubles) {
  EXPECT_EQ(jorba_zou_degree(2.2e-16), 20);
  EXPECT_EQ(jorba_zou_degree(0.5), 2);
  EXPECT_EQ(jorba_zou_degree(1e-6), 8);  // 1 + 6.9
  for (double t : {0.0, 1.0, -1.0, infinity, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(jorba_zou_degree(t), std::invalid_argument) << t;
}

// ---- the control ------------------------------------------------------------------------------------------

double proposal(const Problem& scene, int degree, double max_step = infinity) {
  Expansion<double> series(scene.system);
  series.start(scene.start);
  series.grow_to(degree + 1);
  const TruncationLaw law = fixed_degree(degree);
  return JorbaZou(max_step).propose({series, law});
}

/// F = m v^2: from v = 1 the velocity is 1 / (1-t) wherever that is.
struct Runaway {
  static constexpr const char* name = "runaway";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    return T(p.mass[0] * p.velocity[0].squaredNorm()) * Vector<T, D>::Constant(T(1.0));
  }
};
Problem runaway(double at) {
  System<double> system(1, {1.0});
  system.add<Runaway>({{0}}, {{}});
  return {std::move(system), {0.0, Coordinates<double>::Constant(1, 1, at), Coordinates<double>::Ones(1, 1)}};
}

TEST(JorbaZou, HoldsVelocitiesToPositionsAndToThemselves) {
  // All coefficients of v are 1, so that the step is the longest with
  //     h^q <= sigma^(q-1) min(max(|x_0|, h), C h),   q = p, p + 1:
  // next to the origin the velocity counts (h = 0.13), then the position, and beyond C = 16 ways of a step the velocity again. Of
  // a degree that leaves out more than rounding C = 1: only the velocity counts.
  for (const int p : {8, 19, 20, 24}) {
    const double share = p < 20 ? 1 : 16;
    const auto largest = [&](double at, int q) {
      const double bound = std::pow(sigma(p), q - 1);
      const double by_position = std::pow(bound * at, 1.0 / q), by_velocity = std::pow(bound, 1.0 / (q - 1)),
                   by_share = std::pow(share * bound, 1.0 / (q - 1));
      return std::min(std::max(by_position, by_velocity), by_share);
    };
    for (const double at : {0.0, 1e-300, 0.01, 0.1, 0.2, 1.0, 1.7, 2.0, 10.0, 1e9, 1e300})
      EXPECT_NEAR(proposal(runaway(at), p), std::min(largest(at, p), largest(at, p + 1)), 1e-15)
          << p << " " << at;  // a few roundings of 0.13
  }
}

TEST(JorbaZou, LosesNoDigitsOfAVelocityFarFromTheOrigin) {
  // To v = 2 in t = 1/2, some five steps: rounding, as near the origin. A step held to the position alone, which rounding lets
  // pass at its end, would leave out 1e-6.
  for (const double at : {0.0, 1e15}) {
    Problem scene = runaway(at);
    Lockstep lockstep(taylor(scene.system, 20, std::make_unique<JorbaZou>()));
    EXPECT_EQ(lockstep.run(scene.start, 0.5, {}).outcome, Outcome::success);
    EXPECT_NEAR(scene.start.velocity(0, 0), 2.0, 32 * eps) << at;
  }
}

TEST(JorbaZou, StepsAwayFromWherePositionsOrVelocitiesVanish) {
  // On a line an oscillator passes x = 0 and v = 0. There the velocity or the force is what the position or
  // the velocity is held to: the step changes with the phase, but no more than the largest term does, by
  // h^(1/19) and less.
  const double h = proposal(circular_oscillator(), 20);
  for (const auto& [x, v] : {std::pair{0.0, 1.0}, {1.0, 0.0}, {1e-9, 1.0}, {1.0, 1e-9}, {1e-200, 1.0}}) {
    const double step = proposal(oscillator(1.0, x, v), 20);
    EXPECT_GT(step, 0.9 * h) << x << " " << v;
    EXPECT_LT(step, 1.1 * h) << x << " " << v;
  }
  // x = 1 - cos t from rest at the origin: nothing but the force is there.
  System<double> system(1, {1.0});
  system.add<Shaker>({{0}}, {{1.0}});
  const Problem shaken{std::move(system),
                       {0.0, Coordinates<double>::Zero(1, 1), Coordinates<double>::Zero(1, 1)}};
  EXPECT_NEAR(proposal(shaken, 20), h, 0.1 * h);
}

/// F = m (1 - cos t) in the first direction.
struct GentlePush {
  static constexpr const char* name = "gentle push";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    using std::cos;
    Vector<T, D> f = T(0.0) * p.position[0];
    f[0] = p.mass[0] * (T(1.0) - cos(p.time));
    return f;
  }
};

TEST(JorbaZou, StepsAwayFromWhereTheForceVanishesToo) {
  // x = t^2 / 2 + cos t - 1 begins with t^4 / 4!, v with t^3 / 3!: there the last terms are held to that one.
  // The coefficients of even order are 1/n!, and no later term is larger: h is below 2. Of the last two 20 |x_20| is there
  // and |x_21| is not.
  System<double> system(1, {1.0});
  system.add<GentlePush>({{0}}, {{}});
  const Problem scene{std::move(system),
                      {0.0, Coordinates<double>::Zero(1, 1), Coordinates<double>::Zero(1, 1)}};
  // 20 h^20 / 20! <= sigma^19 4 h^4 / 4!
  const double h = std::pow(std::pow(sigma(20), 19) * std::tgamma(20.0) / std::tgamma(4.0), 1.0 / 16);
  EXPECT_NEAR(proposal(scene, 20), h, 1e-13);
}

/// Steps taken over ten periods by an oscillator started at x, v = w x.
std::uint64_t steps_of_ten_periods(double w, double x) {
  const Problem scene = oscillator(w, x, w * x);
  Lockstep lockstep(taylor(scene.system, 20, std::make_unique<JorbaZou>()));
  State<double> state = scene.start;
  const double until = 20 * std::numbers::pi / w;
  const Report report = lockstep.run(state, until, {});
  EXPECT_EQ(report.outcome, Outcome::success) << report.message;
  // Back where it began: the period is off by a rounding, and some 60 steps by one each.
  EXPECT_NEAR(state.position(0, 0) / x, 1.0, 200 * eps);
  EXPECT_NEAR(state.velocity(0, 0) / (w * x), 1.0, 200 * eps);
  return lockstep.work().steps;
}

TEST(JorbaZou, TakesTheSamePhasePerStepAtAnyRate) {
  // Coefficient 20 of x is some w^20 / 20!, beyond doubles at both ends: the integrator counts time in another unit.
  // 1 % of the phase: the same number of steps, which is below 100.
  const std::uint64_t steps = steps_of_ten_periods(1.0, 1.0);
  EXPECT_LT(steps, 100u);
  for (double w : {1e-16, 1e-8, 1e8, 1e16, 1e-100, 1e100})
    EXPECT_EQ(steps_of_ten_periods(w, 1.0), steps) << w;
}

TEST(JorbaZou, TakesTheSameStepsInAnyUnitOfLength) {
  const std::uint64_t steps = steps_of_ten_periods(1.0, 1.0);
  for (double x : {1e-290, 1e-150, 1e-8, 1e8, 1e150, 1e290})
    for (double w : {1.0, 1e-8, 1e8}) EXPECT_EQ(steps_of_ten_periods(w, x), steps) << x << " " << w;
}

TEST(JorbaZou, FollowsAPlanetInAnyUnits) {
  // Powers of two: the same bits, times the units. r^-3 of the law must be in range: lengths up to 2^+-300.
  const auto end = [](int length, int time) {
    Problem scene = planet(0.9);
    System<double> system(2, {1.0, 1.0});
    system.fix(0);
    system.add<Gravity>({{0, 1}}, {{std::ldexp(1.0, 3 * length - 2 * time)}});
    scene.start.position *= std::ldexp(1.0, length);
    scene.start.velocity *= std::ldexp(1.0, length - time);
    Lockstep lockstep(taylor(system, 20, std::make_unique<JorbaZou>()));
    EXPECT_EQ(lockstep.run(scene.start, std::ldexp(10.0, time), {}).outcome, Outcome::success);
    return Coordinates<double>(scene.start.position * std::ldexp(1.0, -length));
  };
  const auto truth = end(0, 0);
  for (const auto& [length, time] :
       {std::pair{300, 0}, {-300, 0}, {0, 100}, {0, -100}, {100, -50}, {-250, -300}})
    // The steps differ by the roundings of logarithms, and the planet by those of 120 steps, 100 times larger
    // near the sun.
    EXPECT_LT((end(length, time) - truth).cwiseAbs().maxCoeff(), 1e-12) << length << " " << time;
}

TEST(JorbaZou, GivesSeriesThatEndTheLargestStepInAnyUnits) {
  Problem fall = free_fall();
  for (double scale : {1e-150, 1.0, 1e150}) {
    fall.start.position *= scale;
    fall.start.velocity *= scale;
    EXPECT_EQ(proposal(fall, 20, 10.0), 10.0);
    EXPECT_EQ(proposal(fall, 20), infinity);
    fall = free_fall();
  }
  EXPECT_EQ(proposal(oscillator(1.0, 0.0, 0.0), 20), infinity);
}

}  // namespace
}  // namespace jetlag::testing::jorba_zou_test
