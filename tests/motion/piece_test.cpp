// SPDX-License-Identifier: MIT
// A piece is the motion during a step: it ends in the state, moves with its origin, and is dense output.

#include "jetlag/motion/piece.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/truncation/draws.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::piece_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

double distance(const Coordinates<double>& a, const Coordinates<double>& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

/// The pieces of 20 steps of random Taylor, and the states they led to.
struct Walk {
  std::vector<Piece> pieces;
  std::vector<State<double>> ends;
};
Walk walk(const Problem& scene, VelocitySeries velocity, bool shared_draw) {
  RandomTaylor::Options options;
  options.shared_draw = shared_draw;
  options.velocity = velocity;
  Lockstep lockstep(std::make_unique<RandomTaylor>(scene.system, geometric(3, 8, 0.5),
                                                   std::make_unique<FixedStep>(0.125), options));
  Walk result;
  RunOptions run;
  run.observer.after_step = [&](const StepView& view) {
    result.pieces.push_back(view.piece());
    result.ends.push_back(view.state());
    return true;
  };
  State<double> state = scene.start;
  EXPECT_EQ(lockstep.run(state, 2.5, run).outcome, Outcome::success);
  EXPECT_EQ(result.pieces.size(), 20u);
  return result;
}

/// Every way to draw and to take the velocity.
template <class F>
void for_each_way(F f) {
  for (VelocitySeries velocity : {VelocitySeries::own_series, VelocitySeries::derivative})
    for (bool shared : {true, false}) {
      SCOPED_TRACE(::testing::Message() << "own series: " << (velocity == VelocitySeries::own_series)
                                        << ", shared draw: " << shared << ", seed 1");
      f(velocity, shared);
    }
}

TEST(Piece, EndsInTheState) {
  const Problem scene = spring_cube(1);
  for_each_way([&](VelocitySeries velocity, bool shared) {
    const Walk w = walk(scene, velocity, shared);
    for (std::size_t i = 0; i < w.pieces.size(); ++i) {
      const Piece& piece = w.pieces[i];
      EXPECT_EQ(piece.begin, 0.125 * i);
      EXPECT_EQ(piece.end, w.ends[i].time);
      const State<double> end = piece.at(piece.end);
      EXPECT_EQ(end.time, piece.end);
      // Both are Horner's rule on at most 9 terms; the sum is below 2 and the later terms are smaller.
      EXPECT_LT(distance(end.position, w.ends[i].position), 9 * 2 * eps);
      EXPECT_LT(distance(end.velocity, w.ends[i].velocity), 9 * 2 * eps);
    }
  });
}

TEST(Piece, BeginsInTheStateBefore) {
  const Problem scene = spring_cube(2);
  for_each_way([&](VelocitySeries velocity, bool shared) {
    const Walk w = walk(scene, velocity, shared);
    for (std::size_t i = 1; i < w.pieces.size(); ++i) {
      const State<double> begin = w.pieces[i].at(w.pieces[i].begin);
      EXPECT_EQ(begin.position, w.ends[i - 1].position);
      EXPECT_EQ(begin.velocity, w.ends[i - 1].velocity);
    }
  });
}

TEST(Piece, IsTheSameMotionAboutAnotherOrigin) {
  const Problem scene = spring_cube(3);
  for_each_way([&](VelocitySeries velocity, bool shared) {
    for (const Piece& piece : walk(scene, velocity, shared).pieces) {
      const double origin = piece.begin + 0.0625;
      const Piece moved = piece.about(origin);
      EXPECT_EQ(moved.begin, origin);
      EXPECT_EQ(moved.end, piece.end);
      for (double t : {origin, origin + 0.02, piece.end}) {
        EXPECT_LT(distance(moved.at(t).position, piece.at(t).position), 1e-14);  // sizes are about 1
        EXPECT_LT(distance(moved.at(t).velocity, piece.at(t).velocity), 1e-14);
      }
      // Its first coefficient is the motion at the new origin.
      EXPECT_LT(distance(moved.position[0], piece.at(origin).position), 1e-14);
    }
  });
}

TEST(Piece, HasTheDerivativeAsVelocityWhereThatWasChosen) {
  const Problem scene = spring_cube(4);
  for (bool shared : {true, false})
    for (const Piece& piece : walk(scene, VelocitySeries::derivative, shared).pieces) {
      ASSERT_EQ(piece.velocity.size() + 1, piece.position.size());
      for (std::size_t n = 1; n < piece.position.size(); ++n)
        EXPECT_EQ(piece.velocity[n - 1], static_cast<double>(n) * piece.position[n]);
    }
}

TEST(Piece, StopsAtTheDegreeOfEachParticle) {
  // With draws for each particle some stop early: all their later coefficients are zero, and no others are.
  const Problem scene = spring_cube(5);
  int early = 0;
  auto pieces = walk(scene, VelocitySeries::own_series, false).pieces;
  pieces.erase(pieces.begin());  // its springs are at rest length, so that coefficient 2 is zero
  for (const Piece& piece : pieces)
    for (int i = 0; i < 8; ++i) {
      std::size_t degree = 0;
      for (std::size_t n = 0; n < piece.position.size(); ++n)
        if (piece.position[n].row(i).any()) degree = n;
      for (std::size_t n = 0; n < piece.position.size(); ++n)
        EXPECT_EQ(piece.velocity[n].row(i).any(), n <= degree);
      EXPECT_GE(degree, 3u);
      early += degree + 1 < piece.position.size();
    }
  EXPECT_GT(early, 40);  // of 152; each is below the largest of 8 with a chance of more than a half
}

TEST(Piece, GivesThePolynomialsOfAParticle) {
  const Problem scene = spring_cube(6);
  const Piece piece = walk(scene, VelocitySeries::own_series, true).pieces.back();
  const auto rows = polynomials(piece, 5);
  ASSERT_EQ(rows.size(), 3u);
  for (int c = 0; c < 3; ++c) {
    ASSERT_EQ(rows[c].size(), piece.position.size());
    for (std::size_t n = 0; n < rows[c].size(); ++n) EXPECT_EQ(rows[c][n], piece.position[n](5, c));
  }
}

TEST(Piece, IsTheSameWhereItStands) {
  // In memory of its own, and as a method has it: coefficients of a random truncation, of a fixed degree in rows that are
  // padded (3 components) and not, and of steps that are no Taylor steps.
  const auto look = [](const Problem& scene, std::unique_ptr<Integrator> method) {
    Lockstep lockstep(std::move(method));
    RunOptions run;
    run.observer.after_step = [](const StepView& view) {
      const Piece piece = view.piece(), there = view.motion().copy();
      EXPECT_EQ(there.begin, piece.begin);
      EXPECT_EQ(there.end, piece.end);
      EXPECT_EQ(there.unit, piece.unit);
      for (const auto of : {&Piece::position, &Piece::velocity}) {
        EXPECT_EQ((there.*of).size(), (piece.*of).size());
        for (std::size_t k = 0; k < (piece.*of).size(); ++k) EXPECT_EQ((there.*of)[k], (piece.*of)[k]) << k;
      }
      const double t = piece.begin + 0.3 * (piece.end - piece.begin);
      EXPECT_EQ(view.motion().at(t).position, piece.at(t).position);
      EXPECT_EQ(view.motion().at(t).velocity, piece.at(t).velocity);
      return true;
    };
    State<double> state = scene.start;
    EXPECT_EQ(lockstep.run(state, 1.0, run).outcome, Outcome::success);
  };
  const auto step = [] { return std::make_unique<FixedStep>(0.125); };
  for (const Problem& scene : {oscillator(), planet(0.5), spring_cube(8)}) {
    look(scene, taylor(scene.system, 20, step()));
    look(scene, std::make_unique<RandomTaylor>(scene.system, geometric(3, 8, 0.5), step()));
    look(scene, std::make_unique<Leapfrog>(scene.system, 0.125));
    RandomTaylor::Options options;
    options.velocity = VelocitySeries::derivative;
    look(scene, taylor(scene.system, 20, step(), options));
  }
}

TEST(Piece, IsTheSameAtSeveralTimesAtOnce) {
  // Of 1, 2, 3 and more numbers, and of more times than go beside each other.
  const std::vector<double> times{0.1, 0.25, 0.5, 0.75, 0.875, 1.0};
  for (const auto& [particles, dimension] : {std::pair{1, 1}, {1, 2}, {3, 1}, {2, 3}}) {
    Piece piece{0.0, 1.0, Coefficients(9, particles, dimension), Coefficients(8, particles, dimension)};
    for (Coefficients* series : {&piece.position, &piece.velocity})
      for (std::size_t k = 0; k < series->size(); ++k)
        (*series)[k] = Coordinates<double>::Random(particles, dimension);
    for (std::size_t count = 0; count <= times.size(); ++count) {
      std::vector<State<double>> states(count);
      PieceView(piece).at(std::span(times).first(count), states);
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(states[i].time, times[i]);
        EXPECT_EQ(states[i].position, piece.at(times[i]).position);
        EXPECT_EQ(states[i].velocity, piece.at(times[i]).velocity);
      }
    }
  }
}

TEST(Piece, HoldsOnItsClosedInterval) {
  const Piece piece{1.0, 2.0, {}, {}};
  EXPECT_TRUE(piece.holds(1.0));
  EXPECT_TRUE(piece.holds(2.0));
  EXPECT_FALSE(piece.holds(std::nextafter(1.0, 0.0)));
  EXPECT_FALSE(piece.holds(std::nextafter(2.0, 3.0)));
}

TEST(Piece, IsDenseOutputOfFullAccuracy) {
  // The planet at random times of every step, against Kepler's equation. After t the phase error is 3/2 t
  // |dE/E|, and the energy stays within 1e-14 over one period.
  const double e = 0.5;
  const Problem scene = planet(e);
  Lockstep lockstep(taylor(scene.system, 20, std::make_unique<JorbaZou>()));
  int times = 0;
  RunOptions run;
  run.observer.after_step = [&](const StepView& view) {
    const Piece piece = view.piece();
    for (int i = 0; i < 10; ++i) {
      const double t = piece.begin + uniform(1, i, times++) * (piece.end - piece.begin);
      const auto truth = kepler(e, t);
      const State<double> dense = piece.at(t);
      const double tolerance = 1.5 * t * 1e-14 + 8 * eps;
      EXPECT_LT((dense.position.row(1) - truth.position).norm(), tolerance * std::sqrt(3.0))
          << t;  // largest speed
      EXPECT_LT((dense.velocity.row(1) - truth.velocity).norm(), tolerance * 4.0)
          << t;  // largest acceleration
    }
    return true;
  };
  State<double> state = scene.start;
  ASSERT_EQ(lockstep.run(state, 2 * std::numbers::pi, run).outcome, Outcome::success);
  EXPECT_GT(times, 100) << "seed 1";
}

}  // namespace
}  // namespace jetlag::testing::piece_test
