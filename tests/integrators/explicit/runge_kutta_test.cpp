// SPDX-License-Identifier: MIT
// Runge-Kutta methods: their tables, and steps by the estimated error.

#include "jetlag/integrators/explicit/runge_kutta.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "jetlag/forces/drag.hpp"
#include "jetlag/integrators/explicit/dop853.hpp"
#include "jetlag/integrators/explicit/dopri5.hpp"
#include "jetlag/integrators/explicit/rk4.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::runge_kutta_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// ---- order conditions --------------------------------------------------------------------------------------
// A method is of order p if for each rooted tree t of up to p vertices  sum_i b_i Phi_i(t) = 1 / gamma(t),
// Phi_i = product over the subtrees u at the root of sum_j a_ij Phi_j(u), gamma(t) = |t| product of gamma(u).
// Source: Butcher 1963; [HNW93] II.2, theorem 2.13.

struct Tree {
  int size;
  double gamma;
  std::vector<double> phi;  // of each stage
};

/// All multisets of `trees` (from number `first` on) of `size` vertices together, joined by a new root.
void join(const RungeKuttaTable& table, const std::vector<Tree>& trees, std::size_t first, int size,
          Tree so_far, std::vector<Tree>& found) {
  if (size == 0) {
    so_far.gamma *= so_far.size;
    found.push_back(so_far);
    return;
  }
  for (std::size_t u = first; u < trees.size() && trees[u].size <= size; ++u) {
    Tree next = so_far;
    next.size += trees[u].size;
    next.gamma *= trees[u].gamma;
    for (int i = 0; i < table.stages(); ++i) {
      double sum = 0;
      for (int j = 0; j < i; ++j) sum += table.a[i][j] * trees[u].phi[j];
      next.phi[i] *= sum;
    }
    join(table, trees, u, size - trees[u].size, next, found);
  }
}

std::vector<Tree> trees_up_to(int order, const RungeKuttaTable& table) {
  std::vector<Tree> trees;
  for (int size = 1; size <= order; ++size) {
    std::vector<Tree> of_size;
    join(table, trees, 0, size - 1, {1, 1.0, std::vector<double>(table.stages(), 1.0)}, of_size);
    trees.insert(trees.end(), of_size.begin(), of_size.end());
  }
  return trees;
}

/// The largest miss of the conditions of trees with exactly `size` vertices.
double miss(const RungeKuttaTable& table, const std::vector<double>& b, int size) {
  double worst = 0;
  for (const Tree& tree : trees_up_to(size, table)) {
    if (tree.size != size) continue;
    double sum = 0;
    for (int i = 0; i < table.stages(); ++i) sum += b[i] * tree.phi[i];
    worst = std::max(worst, std::abs(sum - 1 / tree.gamma));
  }
  return worst;
}

TEST(RungeKutta, ThereAre200TreesUpToOrderEight) {
  EXPECT_EQ(trees_up_to(8, dop853()).size(), 1u + 1 + 2 + 4 + 9 + 20 + 48 + 115);  // Cayley 1857
}

TEST(RungeKutta, TablesMeetTheConditionsOfTheirOrderAndOfNoMore) {
  for (const RungeKuttaTable* table : {&euler(), &rk4(), &dopri5(), &dop853()}) {
    // Products of up to 8 row sums of numbers below 50.
    for (int size = 1; size <= table->order; ++size)
      EXPECT_LT(miss(*table, table->b, size), 1e4 * eps) << table->name << ", trees of " << size;
    EXPECT_GT(miss(*table, table->b, table->order + 1), 1e-7) << table->name;
  }
}

TEST(RungeKutta, EstimatesAreDifferencesToMethodsOfTheirOrder) {
  const auto other = [](const RungeKuttaTable& table, const std::vector<double>& error) {
    std::vector<double> b = table.b;
    for (std::size_t i = 0; i < b.size(); ++i) b[i] -= error[i];
    return b;
  };
  const auto expect_order = [](const RungeKuttaTable& table, const std::vector<double>& b, int order) {
    for (int size = 1; size <= order; ++size) EXPECT_LT(miss(table, b, size), 1e4 * eps) << table.name;
    EXPECT_GT(miss(table, b, order + 1), 1e-5) << table.name;
  };
  expect_order(dopri5(), other(dopri5(), dopri5().error), 4);
  expect_order(dop853(), other(dop853(), dop853().error), 5);
  expect_order(dop853(), other(dop853(), dop853().second_error), 3);
}

// ---- steps by the estimated error --------------------------------------------------------------------------

struct Result {
  double error;
  Work work;
};
Result one_orbit(const RungeKuttaTable& table, double e, double tolerance) {
  const Problem scene = planet(e);
  State<double> state = scene.start;
  Lockstep run(std::make_unique<RungeKutta>(scene.system, table, EmbeddedControl{tolerance}));
  EXPECT_EQ(run.run(state, 2 * std::numbers::pi, {}).outcome, Outcome::success);
  return {(state.position - scene.start.position).norm(), run.work()};
}

TEST(RungeKutta, TheErrorFallsWithTheToleranceAndTheWorkWithItsRoot) {
  // The estimate, of order q, is held at tol: h ~ tol^(1/q), and the solution of order p misses h^p. Slopes p/q = 1 and
  // 1/q, q = 5 and 8; over six decades, the signs and sizes of few steps change a decimal.
  for (const RungeKuttaTable* table : {&dopri5(), &dop853()}) {
    const Result coarse = one_orbit(*table, 0.5, 1e-5), fine = one_orbit(*table, 0.5, 1e-11);
    const double q = table->error_order;
    EXPECT_NEAR(std::log10(coarse.error / fine.error) / 6, table->order / q, 0.2) << table->name;
    EXPECT_NEAR(std::log10(static_cast<double>(fine.work.steps) / static_cast<double>(coarse.work.steps)) / 6,
                1 / q, 0.03)
        << table->name;
  }
}

TEST(RungeKutta, StepsAreScaledByTheUnitOfTime) {
  // A spring 10^6 times stiffer moves 10^3 times faster: the same steps on a shorter scale.
  const auto steps = [](double omega) {
    const Problem scene = circular_oscillator(omega);
    State<double> state = scene.start;
    Lockstep run(std::make_unique<RungeKutta>(scene.system, dopri5(), EmbeddedControl{1e-8}));
    EXPECT_EQ(run.run(state, 20.0 / omega, {}).outcome, Outcome::success);
    return run.work().steps;
  };
  EXPECT_EQ(steps(1.0), steps(1024.0));
}

TEST(RungeKutta, ARejectedStepIsTriedAgainAndCounted) {
  // On an orbit of e = .9 the pericentre is met with steps that are too long.
  const Result result = one_orbit(dopri5(), 0.9, 1e-8);
  EXPECT_GT(result.work.rejected, 0u);
  EXPECT_LT(result.error, 1e-4);
  // The first stage of all, then six of each step: FSAL; nothing more for those tried again.
  EXPECT_EQ(result.work.element_coefficients, 1 + 6 * (result.work.steps + result.work.rejected));
}

TEST(RungeKutta, DrivesADampedAndShakenParticle) {
  // x'' = -c x' + cos(w t): every stage needs its own time and velocity. From rest, with D = c^2 + w^2:
  // v = (c cos wt + w sin wt - c e^{-ct}) / D.
  Problem scene = oscillator(0.0, 0.0, 0.0);
  scene.system.add<Drag>({{0}}, {{0.7}});
  scene.system.add<Shaker>({{0}}, {{3.0}});
  for (const RungeKuttaTable* table : {&dopri5(), &dop853()}) {
    State<double> state = scene.start;
    Lockstep run(std::make_unique<RungeKutta>(scene.system, *table, EmbeddedControl{1e-11}));
    ASSERT_EQ(run.run(state, 2.0, {}).outcome, Outcome::success);
    const double v = (0.7 * std::cos(6.0) + 3 * std::sin(6.0) - 0.7 * std::exp(-1.4)) / (0.49 + 9);
    EXPECT_NEAR(state.velocity(0, 0), v, 1e-9) << table->name;
  }
}

TEST(RungeKutta, TheMotionWithinAStepIsThatOfHermitesInterpolation) {
  // Its error in the middle falls as h^6 (dopri5, in x); two steps of 1/4 and 1/8.
  const auto error = [](const RungeKuttaTable& table, double h) {
    const Problem scene = planet(0.1);
    RungeKutta method(scene.system, table, h);
    State<double> state = scene.start;
    Report report;
    method.step(state, 1.0, report);
    return (method.piece().at(h / 2).position.row(1) - kepler(0.1, h / 2).position).norm();
  };
  EXPECT_NEAR(std::log2(error(dopri5(), 0.25) / error(dopri5(), 0.125)), 6, 0.25);
  EXPECT_NEAR(std::log2(error(dop853(), 0.5) / error(dop853(), 0.25)), 8, 0.5);
}

TEST(RungeKutta, RefusesWhatIsNotPositiveAndEstimatesThatDoNotExist) {
  const Problem scene = oscillator();
  EXPECT_THROW(RungeKutta(scene.system, rk4(), 0.0), std::invalid_argument);
  EXPECT_THROW(RungeKutta(scene.system, dopri5(), EmbeddedControl{-1.0}), std::invalid_argument);
  EXPECT_THROW(RungeKutta(scene.system, dopri5(), EmbeddedControl{1e-9, 0.0}), std::invalid_argument);
  EXPECT_THROW(RungeKutta(scene.system, rk4(), EmbeddedControl{1e-9}), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing::runge_kutta_test
