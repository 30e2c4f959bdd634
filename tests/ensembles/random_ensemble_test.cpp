// SPDX-License-Identifier: MIT
// A random ensemble is many runs of RandomTaylor at once, each with a seed of its own; what its members amount to is
// known for linear motions.
#include "jetlag/ensembles/random_ensemble.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/halve_double.hpp"
#include "jetlag/forces/forces.hpp"

namespace jetlag::testing::random_ensemble_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Layout = RandomEnsemble::Layout;

/// F = -k x: linear, so that expectations go through.
struct Pull {
  static constexpr const char* name = "pull";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"stiffness"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& stiffness) {
    return T(-stiffness) * p.position[0];
  }
};

/// Springs, drag, a field, a particle that is held.
System<double> chain() {
  System<double> system(2, {1.0, 0.5, 2.0, 1.5});
  system.add<Spring>({{0, 1}, {1, 2}, {3, 2}}, {{4.0, 0.9}, {3.0, 0.8}, {2.0, 1.1}});
  system.add<Drag>({{1}, {2}}, {{0.3}, {0.2}});
  system.add<UniformField>({{1}, {2}, {3}}, {{0.0, -1.0, 0.0}});
  system.fix(0);
  return system;
}
State<double> stretched() {
  State<double> state{0.25, Coordinates<double>::Zero(4, 2), Coordinates<double>::Zero(4, 2)};
  for (int p = 0; p < 4; ++p) state.position.row(p) << p, 0.1 * p * p;
  state.velocity(2, 1) = 0.3;
  return state;
}

SeriesMethod method(bool shared_draw, VelocitySeries velocity, double step = 0.1) {
  RandomTaylor::Options options;
  options.seed = 5;
  options.shared_draw = shared_draw;
  options.velocity = velocity;
  return {geometric(3, 6, 0.5), options, std::make_shared<FixedStep>(step)};
}

RandomEnsemble ensemble(const System<double>& system, const SeriesMethod& method, const State<double>& start,
                        std::size_t members, Layout layout, int threads = 1, double end = infinity) {
  RandomEnsemble::Options options;
  options.workers = Workers(threads);
  options.layout = layout;
  options.end = end;
  return {system, method, std::vector<State<double>>(members, start), options};
}

void expect_same_bits(const State<double>& a, const State<double>& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.velocity, b.velocity);
}

/// Some 40 steps of a few roundings of numbers near 1 .. 4 in a damped motion: below 40 x 10 x 4e-16 < 1e-12.
TEST(RandomEnsemble, IsRandomTaylorWithASeedForEachMember) {
  for (const bool shared_draw : {true, false})
    for (const auto velocity : {VelocitySeries::own_series, VelocitySeries::derivative}) {
      const SeriesMethod series = method(shared_draw, velocity);
      auto lanes = ensemble(chain(), series, stretched(), 70, Layout::in_lanes, 1, 4.3);
      auto alone = ensemble(chain(), series, stretched(), 70, Layout::one_by_one, 1, 4.3);
      EXPECT_TRUE(lanes.in_lanes());
      EXPECT_FALSE(alone.in_lanes());
      std::vector<RandomTaylor> methods;
      std::vector<State<double>> states(70, stretched());
      for (std::size_t i = 0; i < states.size(); ++i) {
        auto options = series.options;
        options.seed = member_seed(5, i);
        methods.emplace_back(chain(), series.law, series.control->clone(), options);
      }
      for (const double time :
           {1.03, 1.04, 1.04, 2.0, 4.28, 4.3, 5.0}) {  // some in the same step, the last two at the end
        lanes.advance_to(time);
        alone.advance_to(time);
        for (const std::size_t i : {0, 31, 69}) {
          State<double>& state = states[i];
          Report report;
          while (state.time < std::min(time, 4.3)) {
            const double limit = 4.3 - state.time, h = methods[i].step(state, limit, report);
            ASSERT_GT(h, 0.0);
            state.time = h == limit ? 4.3 : state.time + h;
          }
          const auto seen = time < state.time ? methods[i].piece().at(time) : state;
          expect_same_bits(alone.state(i), seen);
          EXPECT_EQ(lanes.state(i).time, seen.time);
          EXPECT_LT((lanes.state(i).position - seen.position).cwiseAbs().maxCoeff(), 1e-12);
          EXPECT_LT((lanes.state(i).velocity - seen.velocity).cwiseAbs().maxCoeff(), 1e-12);
        }
      }
      EXPECT_EQ(alone.work().steps, 70 * methods[0].work().steps);
      EXPECT_NE(lanes.state(0).position, lanes.state(1).position);
      EXPECT_EQ(lanes.work().steps, alone.work().steps);
      EXPECT_EQ(lanes.work().updates, alone.work().updates);
      EXPECT_EQ(lanes.work().degrees, alone.work().degrees);
      EXPECT_GE(lanes.work().element_coefficients, alone.work().element_coefficients);
    }
}

TEST(RandomEnsemble, HasTheSameBitsForAnyNumberOfThreadsAndMembers) {
  for (const Layout layout : {Layout::in_lanes, Layout::one_by_one}) {
    const auto run = [&](std::size_t members, int threads) {
      auto all =
          ensemble(chain(), method(true, VelocitySeries::own_series), stretched(), members, layout, threads);
      all.advance_to(1.0);
      all.advance_to(2.0);
      return all;
    };
    const auto one = run(150, 1);
    for (const int threads : {2, 4}) {
      const auto several = run(150, threads);
      for (std::size_t i = 0; i < one.size(); ++i) expect_same_bits(several.state(i), one.state(i));
      EXPECT_EQ(several.work().element_coefficients, one.work().element_coefficients);
    }
    const auto few = run(37, 1), single = run(1, 1);
    for (const std::size_t i : {0, 36}) expect_same_bits(few.state(i), one.state(i));
    expect_same_bits(single.state(0), one.state(0));
  }
}

TEST(RandomEnsemble, KeepsAControlForEachMember) {  // whose steps depend on its own draws
  SeriesMethod series = method(true, VelocitySeries::own_series);
  series.control = std::make_shared<HalveDouble>(0.1, 0.2, 1e-9, 1e-6, 3);
  auto all = ensemble(chain(), series, stretched(), 5, Layout::automatic);
  for (const double until : {1.0, 2.0, 3.0}) all.advance_to(until);
  EXPECT_FALSE(all.in_lanes());
  for (std::size_t i = 0; i < 5; ++i) {
    std::vector<State<double>> starts(i + 1, stretched());
    RandomEnsemble fewer(chain(), series, starts);
    for (const double until : {1.0, 2.0, 3.0}) fewer.advance_to(until);
    expect_same_bits(fewer.state(i), all.state(i));
  }
}

/// For x'' = -x a step is y -> R_K y, y = (x, v), with the 2 x 2 matrices of the weighted series; K is drawn anew each
/// time. So E y = (E R)^n y_0 and E y (x) y = (E R (x) R)^n y_0 (x) y_0.   Source: methods 1c, 1d.
/// The mean of M members misses E x by sd / sqrt M, their second moment by its own deviation / sqrt M: |z| < 4.
TEST(RandomEnsemble, HasTheMeanAndTheVarianceOfALinearMotion) {
  constexpr int members = 20000, steps = 12;
  constexpr double h = 0.7;
  System<double> system(1, {1.0});
  system.add<Pull>({{0}}, {{1.0}});
  const State<double> start{0.0, Coordinates<double>::Constant(1, 1, 1.0),
                            Coordinates<double>::Constant(1, 1, 0.5)};
  for (const auto velocity : {VelocitySeries::own_series, VelocitySeries::derivative}) {
    const SeriesMethod series = method(true, velocity, h);
    Eigen::Matrix2d mean = Eigen::Matrix2d::Zero();
    Eigen::Matrix4d square = Eigen::Matrix4d::Zero();
    Eigen::Matrix2d term = Eigen::Matrix2d::Identity(), step = Eigen::Matrix2d::Zero();
    Eigen::Matrix2d generator;
    generator << 0, 1, -1, 0;
    for (int k = 0; k <= 6; ++k) {
      if (k > 0) term = generator * term * (h / k);
      const double weight = known_beforehand(series.law).weight(k);
      step.row(0) += weight * term.row(0);
      if (velocity == VelocitySeries::own_series)
        step.row(1) += weight * term.row(1);
      else if (k > 0)  // n x_n h^(n-1)
        step.row(1) += weight * k / h * term.row(0);
      const double p = known_beforehand(series.law).exactly(k);
      mean += p * step;
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) square.block<2, 2>(2 * a, 2 * b) += p * step(a, b) * step;
    }
    Eigen::Vector2d first(1.0, 0.5);
    Eigen::Vector4d second(1.0, 0.5, 0.5, 0.25);
    for (int n = 0; n < steps; ++n) {
      first = mean * first;
      second = square * second;
    }

    auto all = ensemble(system, series, start, members, Layout::in_lanes);
    all.advance_to(steps * h);
    const auto z = [&](double expected, const auto& of) {
      double sum = 0, squares = 0;
      for (int i = 0; i < members; ++i) {
        const State<double> state = all.state(i);
        const double value = of(state.position(0, 0), state.velocity(0, 0));
        sum += value;
        squares += value * value;
      }
      const double average = sum / members, deviation = std::sqrt(squares / members - average * average);
      EXPECT_GT(deviation, 1e-4);
      return (average - expected) / (deviation / std::sqrt(members));
    };
    EXPECT_LT(std::abs(z(first[0], [](double x, double) { return x; })), 4);
    EXPECT_LT(std::abs(z(first[1], [](double, double v) { return v; })), 4);
    EXPECT_LT(std::abs(z(second[0], [](double x, double) { return x * x; })), 4);
    EXPECT_LT(std::abs(z(second[1], [](double x, double v) { return x * v; })), 4);
    EXPECT_LT(std::abs(z(second[3], [](double, double v) { return v * v; })), 4);
  }
}

/// Two bodies that fall on each other: from the distance 0 there is no series.
TEST(RandomEnsemble, LeavesOthersAloneWhereOneFails) {
  System<double> system(1, {1.0, 1.0});
  system.add<Gravity>({{0, 1}}, {{1.0}});
  State<double> apart{0.0, Coordinates<double>::Zero(2, 1), Coordinates<double>::Zero(2, 1)},
      together = apart;
  apart.position(1, 0) = 2;
  for (const Layout layout : {Layout::in_lanes, Layout::one_by_one}) {
    RandomEnsemble::Options options;
    options.layout = layout;
    options.end = 0.4;
    const SeriesMethod series = method(true, VelocitySeries::own_series, 0.05);
    RandomEnsemble healthy(system, series, std::vector(5, apart), options);
    RandomEnsemble one_fails(system, series, {apart, apart, together, apart, apart}, options);
    for (auto* all : {&healthy, &one_fails})
      for (const double until : {0.1, 0.4}) EXPECT_TRUE(all->advance_to(until));
    EXPECT_EQ(one_fails.report(2).outcome, Outcome::non_finite);
    EXPECT_NE(one_fails.report(2).message.find("particle 0"), std::string::npos);
    expect_same_bits(one_fails.state(2), together);
    for (const std::size_t i : {0, 1, 3, 4}) {
      EXPECT_EQ(one_fails.report(i).outcome, Outcome::success);
      expect_same_bits(one_fails.state(i), healthy.state(i));
    }
    EXPECT_EQ(one_fails.work().steps, 4u * 8u);
  }
}

TEST(RandomEnsemble, StopsWhereItIsAsked) {
  for (const Layout layout : {Layout::in_lanes, Layout::one_by_one}) {
    auto all = ensemble(chain(), method(true, VelocitySeries::own_series), stretched(), 40, layout);
    int questions = 0;
    EXPECT_FALSE(all.advance_to(2.0, [&] { return ++questions < 4; }));
    EXPECT_EQ(all.state(0).time, 0.25);  // as before
    EXPECT_EQ(all.report(0).outcome, Outcome::success);
    EXPECT_TRUE(all.advance_to(2.0));
    auto undisturbed = ensemble(chain(), method(true, VelocitySeries::own_series), stretched(), 40, layout);
    undisturbed.advance_to(2.0);
    for (std::size_t i = 0; i < all.size(); ++i) expect_same_bits(all.state(i), undisturbed.state(i));

    RandomEnsemble::Options options;
    options.layout = layout;
    options.max_steps = 6;
    RandomEnsemble limited(chain(), method(true, VelocitySeries::own_series), {stretched()}, options);
    limited.advance_to(2.0);
    EXPECT_EQ(limited.report(0).outcome, Outcome::step_limit);
    EXPECT_NEAR(limited.state(0).time, 0.25 + 6 * 0.1, 1e-15);
  }
}

TEST(RandomEnsemble, GivesNeighbouringSeedsDifferentMembers) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    for (std::uint64_t member = 0; member < 200; ++member) seeds.insert(member_seed(seed, member));
  EXPECT_EQ(seeds.size(), 100u * 200u);
}

TEST(RandomEnsemble, RefusesWhatMakesNoSense) {
  SeriesMethod series = method(true, VelocitySeries::own_series);
  State<double> later = stretched(), moved = stretched();
  later.time = 1;
  moved.velocity(0, 0) = 1;
  EXPECT_THROW(RandomEnsemble(chain(), series, {stretched(), later}), std::invalid_argument);
  EXPECT_THROW(RandomEnsemble(chain(), series, {stretched(), moved}), std::invalid_argument);
  RandomEnsemble two(chain(), series, {stretched(), stretched()});
  EXPECT_THROW(two.advance_to(std::nan("")), std::invalid_argument);
  EXPECT_THROW(two.advance_to(0.2), std::invalid_argument);
  EXPECT_THROW(two.state(2), std::invalid_argument);
  series.options.compensated = true;
  EXPECT_THROW(ensemble(chain(), series, stretched(), 2, Layout::in_lanes), std::invalid_argument);
  EXPECT_FALSE(ensemble(chain(), series, stretched(), 2, Layout::automatic).in_lanes());
  RandomEnsemble none(chain(), series, {});
  EXPECT_TRUE(none.advance_to(1.0));
}

}  // namespace
}  // namespace jetlag::testing::random_ensemble_test
