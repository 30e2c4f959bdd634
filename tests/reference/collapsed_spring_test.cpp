// SPDX-License-Identifier: MIT
// A spring that collapses: unit mass, k = L = 1, q'' = -(1 - 1/|q|) q from (1, 0) with velocity (-1.2, delta).
//
// The mass passes the other end at a distance of 1.5 delta, where the direction of the force turns round within
// 1.5 delta / 0.66 s; at delta = 0 it jumps.
// Source of the values: Taylor series in 75-digit arithmetic, repeated at a second order.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "jetlag/model/energy.hpp"
#include "reference/conditioning.hpp"

namespace jetlag::testing {
namespace {

struct Passage {
  double delta, until, known[4];  // x, y, v_x, v_y
};
constexpr Passage passages[] = {{1e-1,
                                 10,
                                 {0.52966029309327483381507699, -0.82583380869474958566542626,
                                  -0.56187654769036898327232973, 1.0648648893453476707846829}},
                                {1e-3,
                                 10,
                                 {1.263029561342757868655169, -0.084835542224449331469822793,
                                  -1.1674917449944833671813369, 0.079210177094204696645856466}},
                                {1e-3,
                                 100,
                                 {1.5253435563371705941893531, -1.2076066584424468967688419,
                                  0.57966867949606649482034494, -0.45826512600776809360356334}},
                                {1e-6,
                                 10,
                                 {1.2661229803496504181608035, -0.00020477246036047531671662606,
                                  -1.1701190171960514517404821, 0.0001900353708131660595159538}}};

TEST(CollapsedSpring, IsFollowedThroughItsPassages) {
  for (const Passage& p : passages) {
    SCOPED_TRACE(::testing::Message() << "delta = " << p.delta << ", t = " << p.until);
    const ReferenceProblem problem = of_problem("collapsed", collapsing_spring(p.delta), p.until);
    const ReferenceSolution solution = problem.solve(20, {});
    ASSERT_EQ(solution.report.outcome, Outcome::success) << solution.report.message;
    // Measured: 2e-16, 3e-15, 1.5e-13, 1.3e-15. A disturbance of 1e-11 is small even against delta = 1e-6.
    const double tolerance = rounding_tolerance(problem, solution, 1e-11);
    EXPECT_LT(tolerance, 1e-11);
    EXPECT_LT(error(solution.end, {p.known[0], p.known[1], p.known[2], p.known[3]}), tolerance);
  }
}

TEST(CollapsedSpring, KeepsItsEnergyAndAngularMomentum) {
  for (const Passage& p : passages) {
    SCOPED_TRACE(::testing::Message() << "delta = " << p.delta << ", t = " << p.until);
    const Problem spring = collapsing_spring(p.delta);
    State<> state = spring.start;
    EnergyMeter meter(spring.system);
    const double energy = meter(state).total();
    double worst = 0, shortest = 1;
    RunOptions options;
    options.observer.after_step = [&](const StepView& view) {
      worst = std::max(worst, std::abs(meter(view.state()).total() - energy) / energy);
      shortest = std::min(shortest, view.end() - view.begin());
      return true;
    };
    Lockstep run(taylor(spring.system, 20, std::make_unique<JorbaZou>()));
    ASSERT_EQ(run.run(state, p.until, options).outcome, Outcome::success);
    EXPECT_LT(worst, 1e-12);  // measured: 8e-16 to 6e-15
    // x v_y - y v_x: two products of size 1 at most, eps for each of n steps.
    EXPECT_NEAR(angular_momentum(spring.system, state)(0), p.delta,
                eps * static_cast<double>(run.work().steps));
    // The series about the passage converge within 1.508 delta / 0.663 s; a step is a tenth to a whole of that.
    EXPECT_LT(shortest, 1.508 * p.delta / 0.663);
  }
}

/// On a line the direction of the force is a number: (x, v)' = (v, -(x - u)), u = 1 on the right, -1 on the left.
constexpr auto on_a_line = [](const auto&, const auto& y, const auto& p) {
  return std::array{y[1], p[0] - y[0]};
};

TEST(CollapsedSpring, PassesItsEndExactlyWhereTheCrossingIsFound) {
  // A harmonic motion about u: x = 1 - 1.2 sin t to the first crossing at asin(5/6), of speed sqrt(.44), and the half
  // turns that follow take 2 (pi - atan(speed)). Each step's dense output tells where x changes its sign.
  const double speed = std::sqrt(0.44), first = std::asin(5.0 / 6),
               half_turn = 2 * (std::numbers::pi - std::atan(speed));
  FirstOrderTaylor<> method(on_a_line, 2, {.parameters = {1.0}});
  FirstOrderState<> state{0.0, {1.0, -1.2}};
  for (int crossing = 0; crossing < 20; ++crossing) {
    const double side = method.options().parameters[0];
    double low = 0, high = 0;
    FirstOrderRunOptions<> options;
    options.after_step = [&](const FirstOrderStepView<>& view) {
      low = view.begin;
      high = view.state.time;
      return view.state.y[0] * side > 0;
    };
    ASSERT_EQ(method.run(state, state.time + 10, options).outcome, Outcome::interrupted);
    for (double middle = std::midpoint(low, high); low < middle && middle < high;
         middle = std::midpoint(low, high))
      (method.at(middle)[0] * side > 0 ? low : high) = middle;
    state = {high, method.at(high)};
    // The crossing is rounded up to a double, by eps t at most. So long the old force acts on the new side: the speed is
    // 2 eps t less, and the next half turn 2 / 1.44 of that longer. n crossings: n eps t, and n times that.
    const double expected = first + crossing * half_turn, rounding = eps * (1 + expected);
    EXPECT_NEAR(state.time, expected, (1 + crossing * crossing) * rounding) << crossing;
    EXPECT_NEAR(std::abs(state.y[1]), speed, (1 + crossing) * rounding) << crossing;
    const double energy =
        (state.y[1] * state.y[1] + (std::abs(state.y[0]) - 1) * (std::abs(state.y[0]) - 1)) / 2;
    EXPECT_NEAR(energy, 0.72, 0.72e-12) << crossing;
    method.set_parameters({-side});
  }
}

}  // namespace
}  // namespace jetlag::testing
