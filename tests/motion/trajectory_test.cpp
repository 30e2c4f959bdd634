// SPDX-License-Identifier: MIT
// Dense output: the state at any time of a run is that of a step to the same time.

#include "jetlag/motion/trajectory.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/schedule/record.hpp"
#include "support/problems.hpp"
#include "support/random.hpp"

namespace jetlag::testing::trajectory_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double eps = std::numeric_limits<double>::epsilon();

double distance(const Coordinates<double>& a, const Coordinates<double>& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

Lockstep in_steps(const Problem& scene, double step, int degree = 20) {
  return Lockstep(taylor(scene.system, degree, std::make_unique<FixedStep>(step)));
}

Lockstep at_random(const Problem& scene, double step) {
  return Lockstep(
      std::make_unique<RandomTaylor>(scene.system, geometric(3, 8, 0.5), std::make_unique<FixedStep>(step)));
}

/// The motion of a scene until a time.
Trajectory motion(const Problem& scene, Lockstep schedule, double until) {
  Trajectory trajectory;
  State<double> state = scene.start;
  EXPECT_EQ(record(schedule, state, until, trajectory).outcome, Outcome::success);
  return trajectory;
}

/// x = c + v (t - begin) on a line.
Piece line(double begin, double end, double c, double v) {
  const auto number = [](double x) { return Coordinates<double>::Constant(1, 1, x); };
  return {begin, end, {number(c), number(v)}, {number(v)}};
}

TEST(Trajectory, CountsInTheUnitOfItsPieces) {
  const auto one = [](double c) { return Coordinates<double>::Constant(1, 1, c); };
  Trajectory motion;
  motion.add({1.0, 5.0, {one(1.0), one(2.0)}, {one(3.0), one(8.0)}, 4.0});
  EXPECT_EQ(motion.position(0, 3.0)[0], 2.0);  // 1 + 2 (3 - 1)/4
  EXPECT_EQ(motion.velocity(0, 3.0)[0], 7.0);
  EXPECT_EQ(motion.at(3.0).position(0, 0), 2.0);
}

TEST(Trajectory, IsTheClosedFormOfAnOscillator) {
  // 34 steps of 0.3 at degree 20 leave out 0.3^21/21! < 1e-30. Each rounds its two Horner sums by less than
  // eps/2 (1 + 2 (0.3 + 0.3^2 + ...)) < eps each and turns what it found; a time is off by at most ulp(10) = 8 eps.
  const Problem scene = oscillator();
  const Trajectory trajectory = motion(scene, in_steps(scene, 0.3), 10.0);
  Uniform random(1);
  for (int i = 0; i < 1000; ++i) {
    const double t = random(0.0, 10.0);
    const State<double> state = trajectory.at(t);
    EXPECT_EQ(state.time, t);
    EXPECT_NEAR(state.position(0, 0), std::cos(t), (35 * std::sqrt(2.0) + 8) * eps) << "seed 1";
    EXPECT_NEAR(state.velocity(0, 0), -std::sin(t), (35 * std::sqrt(2.0) + 8) * eps) << "seed 1";
  }
}

TEST(Trajectory, EqualsAStepToTheSameTime) {
  // Steps of 1/8 leave nothing to round in the clock: a run that ends at t takes the same last polynomial there, with
  // the same draw, and the same bits follow.
  const Problem scene = spring_cube(1);
  Uniform random(2);
  for (const bool drawn : {false, true}) {
    const auto schedule = [&] { return drawn ? at_random(scene, 0.125) : in_steps(scene, 0.125, 6); };
    const Trajectory trajectory = motion(scene, schedule(), 2.5);
    for (int i = 0; i < 30; ++i) {
      const double t = random(0.0, 2.5);
      State<double> stepped = scene.start;
      ASSERT_EQ(schedule().run(stepped, t, {}).outcome, Outcome::success);
      EXPECT_EQ(trajectory.at(t).position, stepped.position)
          << "random " << drawn << ", t = " << t << ", seed 2";
      EXPECT_EQ(trajectory.at(t).velocity, stepped.velocity)
          << "random " << drawn << ", t = " << t << ", seed 2";
    }
  }
}

TEST(Trajectory, EqualsAStepToTheSameTimeUpToItsClock) {
  // Steps of 0.1 from t = 1000: `begin` and t are rounded to ulp(1000) = 1.1e-13. Speeds and accelerations are below 1,
  // a coordinate below 2 is summed from 7 terms.
  Problem scene = spring_cube(3);
  scene.start.time = 1000.0;
  const Trajectory trajectory = motion(scene, in_steps(scene, 0.1, 6), 1002.0);
  Uniform random(3);
  for (int i = 0; i < 30; ++i) {
    const double t = random(1000.0, 1002.0), tolerance = 512 * eps + 7 * 2 * eps;
    State<double> stepped = scene.start;
    ASSERT_EQ(in_steps(scene, 0.1, 6).run(stepped, t, {}).outcome, Outcome::success);
    EXPECT_LT(stepped.velocity.cwiseAbs().maxCoeff(), 1.0);
    EXPECT_LT(distance(trajectory.at(t).position, stepped.position), tolerance) << "seed 3";
    EXPECT_LT(distance(trajectory.at(t).velocity, stepped.velocity), tolerance) << "seed 3";
  }
}

TEST(Trajectory, IsContinuous) {
  // As above, at every border: the end of a piece and the beginning of the next, for speeds below 1.
  for (const double begin : {0.0, 1000.0}) {
    Problem scene = spring_cube(4);
    scene.start.time = begin;
    const double clock = begin == 0.0 ? 2 * eps : 512 * eps;
    std::vector<Trajectory> all;
    all.push_back(motion(scene, in_steps(scene, 0.1, 6), begin + 2));
    all.push_back(motion(scene, at_random(scene, 0.1), begin + 2));
    all.push_back(motion(scene, Lockstep(std::make_unique<Leapfrog>(scene.system, 0.1)), begin + 2));
    for (const Trajectory& trajectory : all) {
      ASSERT_EQ(trajectory.size(), 20u);
      for (std::size_t i = 1; i < 20; ++i) {
        const PieceView before = trajectory.piece(i - 1), after = trajectory.piece(i);
        EXPECT_EQ(before.end, after.begin);
        EXPECT_LT(distance(before.at(before.end).position, after.at(after.begin).position), clock + 14 * eps);
        EXPECT_LT(distance(before.at(before.end).velocity, after.at(after.begin).velocity), clock + 14 * eps);
      }
    }
  }
}

TEST(Trajectory, TakesTheLaterPieceAtABorder) {
  Trajectory trajectory;
  trajectory.add(line(0.0, 1.0, 0.0, 1.0));
  trajectory.add(line(1.0, 1.5, 3.0, -1.0));
  trajectory.add(line(1.5, 2.0, 7.0, 0.0));
  EXPECT_EQ(trajectory.begin(), 0.0);
  EXPECT_EQ(trajectory.end(), 2.0);
  EXPECT_EQ(trajectory.at(0.0).position(0, 0), 0.0);
  EXPECT_EQ(trajectory.at(std::nextafter(1.0, 0.0)).position(0, 0), std::nextafter(1.0, 0.0));
  EXPECT_EQ(trajectory.at(1.0).position(0, 0), 3.0);
  EXPECT_EQ(trajectory.at(1.25).position(0, 0), 2.75);
  EXPECT_EQ(trajectory.at(1.5).position(0, 0), 7.0);
  EXPECT_EQ(trajectory.at(2.0).position(0, 0), 7.0);
}

TEST(Trajectory, ShowsOneParticle) {
  const Problem scene = spring_cube(5);
  const Trajectory trajectory = motion(scene, at_random(scene, 0.125), 1.0);
  for (const double t : {0.0, 0.3, 0.5, 0.99, 1.0})
    for (int i = 0; i < 8; ++i) {
      EXPECT_EQ(trajectory.position(i, t), trajectory.at(t).position.row(i));
      EXPECT_EQ(trajectory.velocity(i, t), trajectory.at(t).velocity.row(i));
    }
  const auto message = [](const char* text) { return ThrowsMessage<std::invalid_argument>(HasSubstr(text)); };
  EXPECT_THAT([&] { trajectory.position(8, 0.5); }, message("particle 8 does not exist, there are 8"));
  EXPECT_THAT([&] { trajectory.velocity(-1, 0.5); }, message("particle -1"));
}

TEST(Trajectory, GrowsFromRunToRun) {
  const Problem scene = oscillator();
  Trajectory trajectory;
  State<double> state = scene.start;
  int steps = 0;
  RunOptions options;
  options.observer.after_step = [&](const StepView&) { return ++steps != 3; };
  Lockstep schedule = in_steps(scene, 0.25);
  EXPECT_EQ(record(schedule, state, 1.0, trajectory, options).outcome, Outcome::interrupted);
  EXPECT_EQ(trajectory.end(), 0.75);
  EXPECT_EQ(record(schedule, state, 2.0, trajectory, options).outcome, Outcome::success);
  EXPECT_EQ(trajectory.end(), 2.0);
  EXPECT_EQ(steps, 8);
  EXPECT_EQ(trajectory.at(2.0).position, state.position);
}

TEST(Trajectory, SaysWhereItIsKnown) {
  Trajectory trajectory;
  const auto message = [](auto... text) {
    return ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(text)...));
  };
  EXPECT_THAT([&] { trajectory.at(0.0); }, message("no piece"));
  EXPECT_THAT([&] { trajectory.end(); }, message("no piece"));
  trajectory.add(line(0.1, 0.5, 0.0, 1.0));
  EXPECT_THAT([&] { trajectory.at(0.6); }, message("t = 0.6", "[0.1, 0.5]"));
  EXPECT_THAT([&] { trajectory.at(std::nextafter(0.1, 0.0)); }, message("[0.1, 0.5]"));
  EXPECT_THAT([&] { trajectory.at(NAN); }, message("nan"));
}

TEST(Trajectory, RefusesPiecesThatDoNotFit) {
  Trajectory trajectory;
  const auto message = [](const char* text) { return ThrowsMessage<std::invalid_argument>(HasSubstr(text)); };
  EXPECT_THAT([&] { trajectory.add({0.0, 1.0, {}, {}}); }, message("without coefficients"));
  EXPECT_THAT([&] { trajectory.add(line(1.0, 0.5, 0.0, 0.0)); }, message("from 1 to 0.5"));
  EXPECT_THAT([&] { trajectory.add(line(0.0, NAN, 0.0, 0.0)); }, message("from 0 to nan"));
  trajectory.add(line(0.0, 1.0, 0.0, 1.0));
  EXPECT_THAT([&] { trajectory.add(line(1.5, 2.0, 0.0, 0.0)); },
              message("begins at 1.5, the last one ends at 1"));
  Piece wide = line(1.0, 2.0, 0.0, 0.0);
  wide.position = {Coordinates<double>::Zero(1, 3)};
  EXPECT_THAT([&] { trajectory.add(wide); }, message("(1, 3), not (1, 1)"));
  Piece high = line(1.0, 2.0, 0.0, 0.0);
  high.position = high.velocity = {Coordinates<double>::Zero(1, 4)};
  EXPECT_THAT([&] { trajectory.add(high); }, message("4 components, at most 3"));
  EXPECT_EQ(trajectory.size(), 1u);
}

TEST(Trajectory, HoldsItsCoefficientsAndLittleElse) {
  // 8 particles, 3 components, 7 coefficients of position and of velocity, and 32 bytes a piece; in a block for pieces to come an
  // eighth of all before, up to a piece more, and the blocks themselves.
  const Problem scene = spring_cube(6);
  const Trajectory trajectory = motion(scene, in_steps(scene, 0.125, 6), 40.0);
  const std::size_t size = 320 * (2 * 7 * 8 * 3 * sizeof(double) + 32);
  EXPECT_GE(trajectory.bytes(), size);
  EXPECT_LE(trajectory.bytes(), size + size / 8 + size / 320 + 8192);
  EXPECT_EQ(Trajectory().bytes(), 0u);
}

TEST(Trajectory, HoldsAPendulumIn400BytesAStep) {
  // 21 coefficients of position and of velocity, 336 bytes, and 32 for the piece; a block for pieces to come is 2 MiB of 40.
  const Piece step{0.0, 1.0, Coefficients(21, 1, 1), Coefficients(21, 1, 1)};
  constexpr int steps = 100000;
  Trajectory trajectory;
  for (int i = 0; i < steps; ++i) {
    PieceView next = step;
    next.begin = i;
    next.end = i + 1.0;
    trajectory.add(next);
  }
  EXPECT_LE(trajectory.bytes(), 400.0 * steps);
}

TEST(Trajectory, KeepsItsPiecesWhereTheyAre) {
  // x = p on [p, p + 1]: of 1 to 40 coefficients each, in blocks of all sizes; views last while others are added.
  Trajectory trajectory;
  std::vector<PieceView> views;
  constexpr int pieces = 3000;
  for (int p = 0; p < pieces; ++p) {
    Piece piece{p * 1.0, p + 1.0, Coefficients(1 + p % 40, 2, 2), Coefficients(1 + p % 7, 2, 2)};
    piece.position[0].setConstant(p);
    piece.velocity[0].setConstant(-p);
    trajectory.add(piece);
    views.push_back(trajectory.piece(p));
  }
  ASSERT_EQ(trajectory.size(), std::size_t{pieces});
  const Trajectory copied = trajectory;
  State<double> state;
  for (int p = 0; p < pieces; ++p) {
    EXPECT_EQ(views[p].position.data(0), trajectory.piece(p).position.data(0));
    EXPECT_EQ(trajectory.piece(p).begin, p);
    EXPECT_EQ(trajectory.piece(p).end, p + 1);
    EXPECT_EQ(trajectory.piece(p).position.size(), 1u + p % 40);
    copied.at(p + 0.5, state);
    EXPECT_EQ(state.position, Coordinates<double>::Constant(2, 2, p));
    EXPECT_EQ(state.velocity, Coordinates<double>::Constant(2, 2, -p));
  }
}

TEST(Trajectory, WritesIntoTheMemoryOfAState) {
  const Problem scene = spring_cube(7);
  const Trajectory trajectory = motion(scene, in_steps(scene, 0.125, 6), 1.0);
  State<double> state = scene.start;
  const double *position = state.position.data(), *velocity = state.velocity.data();
  trajectory.at(0.7, state);
  EXPECT_EQ(state.position, trajectory.at(0.7).position);
  EXPECT_EQ(state.velocity, trajectory.at(0.7).velocity);
  EXPECT_EQ(state.time, 0.7);
  EXPECT_EQ(state.position.data(), position);
  EXPECT_EQ(state.velocity.data(), velocity);
}

}  // namespace
}  // namespace jetlag::testing::trajectory_test
