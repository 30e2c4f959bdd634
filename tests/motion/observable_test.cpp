// SPDX-License-Identifier: MIT
// Observables along a piece: their series, and when they cross zero.

#include "jetlag/motion/observable.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "jetlag/base/rounded_time.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/series/elementary.hpp"
#include "support/problems.hpp"
#include "support/random.hpp"

namespace jetlag::testing::observable_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// The motion of a scene to degree N, from its start, for a time h.
Piece piece_of(const Problem& scene, int degree, double h) {
  Expansion<double> series(scene.system);
  series.start(scene.start);
  series.grow_to(degree + 1);
  Piece piece{scene.start.time, scene.start.time + h, {}, {}};
  for (int k = 0; k <= degree; ++k) {
    piece.position.push_back(series.position(k));
    piece.velocity.push_back(series.velocity(k));
  }
  return piece;
}

/// x = c_0 + c_1 s + ... on a line from a time on.
Piece polynomial(double begin, double end, const std::vector<double>& c) {
  Piece piece{begin, end, {}, {}};
  for (std::size_t k = 0; k < c.size(); ++k) {
    piece.position.push_back(Coordinates<double>::Constant(1, 1, c[k]));
    if (k > 0) piece.velocity.push_back(Coordinates<double>::Constant(1, 1, static_cast<double>(k) * c[k]));
  }
  return piece;
}

const auto position = [](const auto&, const auto& x, const auto&) { return x(0, 0); };

TEST(Observable, MayBeASeparation) {  // which laws of two participants read in another way
  State<double> state{0.0, Coordinates<double>::Zero(2, 1), Coordinates<double>::Constant(2, 1, 7.0)};
  state.position << 5.0, 2.0;
  EXPECT_EQ(
      ObservableSeries([](const auto&, const auto& x, const auto&) { return x(0, 0) - x(1, 0); })(state),
      3.0);
  EXPECT_EQ(
      ObservableSeries([](const auto&, const auto& x, const auto&) { return x(1, 0) - x(0, 0); })(state),
      -3.0);
}

TEST(Observable, RefusesAPieceThatDoesNotCountSeconds) {
  Piece piece = polynomial(0.0, 1.0, {-1.0, 2.0});
  piece.unit = 0x1p-60;
  EXPECT_THROW(crossings(piece, Observable(position)), std::invalid_argument);
}

TEST(Observable, TellsTheSignOfALinearFunctionAllAlong) {
  // g = 3 - 2 t + t^2 / 2 on [0, 1] keeps its sign, and its first term outweighs the others, 3 > 2 + 1/2. On [0, 1.5] 3 < 3 + 9/8,
  // but g falls, 2 > 3/2, to 9/8. On [0, 2.5] it is still positive, but it turns, 2 < 5/2, and g = 1 - 2 t + t^2 / 2 falls to
  // -1/2 at 1; where time is taken off, g = 3 - 4 t + .., it does not keep its sign.
  const auto sign_of = [](const auto& g, double end) {
    return ObservableSeries(Observable(g)).sign_along(polynomial(0.0, end, {3.0, -2.0, 0.5}));
  };
  const auto x = [](const auto&, const auto& position, const auto&) { return position(0, 0); };
  EXPECT_EQ(sign_of(x, 1.0), 1);
  EXPECT_EQ(sign_of([](const auto&, const auto& p, const auto&) { return 1.0 - 2.0 * p(0, 0); }, 0.5), -1);
  EXPECT_EQ(sign_of(x, 1.5), 1);
  EXPECT_EQ(sign_of(x, 2.5), 0);
  EXPECT_EQ(sign_of([](const auto&, const auto& p, const auto&) { return p(0, 0) - 2.0; }, 1.0), 0);
  EXPECT_EQ(sign_of([](const auto& t, const auto& p, const auto&) { return p(0, 0) - 2.0 * t; }, 1.0), 0);
  EXPECT_EQ(
      sign_of([](const auto& t, const auto& p, const auto& v) { return p(0, 0) + t / 2.0 - v(0, 0); }, 1.0),
      1);
  EXPECT_EQ(sign_of([](const auto&, const auto& p, const auto&) { return p(0, 0) * p(0, 0); }, 0.1), 0)
      << "not linear";
  EXPECT_EQ(sign_of([](const auto&, const auto& p, const auto&) { return abs(p(0, 0)); }, 0.1), 0)
      << "a choice";
}

TEST(Observable, AddsUpTheSeriesOfItsInputs) {
  // x = 3 - 2 s + 5 s^2 at t = 1 + s, v its derivative; with weights that are powers of two nothing is rounded.
  const Piece piece = polynomial(1.0, 2.0, {3.0, -2.0, 5.0});
  const auto along = [&](const auto& g) { return ObservableSeries(Observable(g)).along(piece)[0].c; };
  using C = std::vector<double>;
  EXPECT_EQ(along([](const auto&, const auto& x, const auto&) { return 7.0 - 4.0 * x(0, 0); }),
            (C{-5.0, 8.0, -20.0}));
  EXPECT_EQ(along([](const auto&, const auto& x, const auto& v) { return 2.0 * x(0, 0) - 0.5 * v(0, 0); }),
            (C{7.0, -9.0, 10.0}));
  EXPECT_EQ(along([](const auto& t, const auto& x, const auto&) { return x(0, 0) - 4.0 * t; }),
            (C{-1.0, -6.0, 5.0}));
  EXPECT_EQ(along([](const auto& t, const auto& x, const auto& v) { return x(0, 0) - 4.0 * t + v(0, 0); }),
            (C{-3.0, 4.0, 5.0}));
}

TEST(Observable, WeighsItsInputsWhateverItsConstantIs) {
  // g = .6 x + .8 y - 1e8 at y = 8e7 + .. comes down to -.2 within the step and is .3 at both ends: weights that are rounded to
  // the places of 1e8 are off by up to 7e-9, which is .6 in g.
  Piece piece{0.0, 1.0};
  piece.position.push_back(Coordinates<double>{{6e7 + 0.5, 8e7}});
  piece.position.push_back(Coordinates<double>{{0.0, -2.5}});
  piece.position.push_back(Coordinates<double>{{0.0, 2.5}});
  piece.velocity.push_back(Coordinates<double>{{0.0, -2.5}});
  piece.velocity.push_back(Coordinates<double>{{0.0, 5.0}});
  ObservableSeries g(
      [](const auto&, const auto& x, const auto&) { return 0.6 * x(0, 0) + 0.8 * x(0, 1) - 1e8; });
  EXPECT_EQ(g.sign_along(piece), 0);
  // With 1e17 beside them, x moves g all the same.
  ObservableSeries far([](const auto&, const auto& x, const auto&) { return 3.0 * x(0, 1) - 1e17; });
  piece.position[0](0, 1) = 1e17;
  piece.position[1](0, 1) = -3e17;
  EXPECT_EQ(far.sign_along(piece), 0);
}

TEST(Observable, TellsNoSignWhereRoundingMayHaveMadeIt) {
  const Piece piece = polynomial(0.0, 1.0, {1.0, 0x1p-70});
  ObservableSeries g([](const auto&, const auto& x, const auto&) { return 0x1p50 * x(0, 0) - (0x1p50 - 1); });
  EXPECT_EQ(g.sign_along(piece), 0);
}

TEST(Observable, IsAFunctionOfTheState) {
  ObservableSeries g(
      [](const auto& t, const auto& x, const auto& v) { return t * x(1, 0) + v(0, 2) * v(0, 2); });
  State<double> state{3.0, Coordinates<double>::Zero(2, 3), Coordinates<double>::Zero(2, 3)};
  state.position(1, 0) = 5.0;
  state.velocity(0, 2) = 7.0;
  EXPECT_EQ(g(state), 64.0);
  EXPECT_EQ(ObservableSeries([](const auto&, const auto&, const auto&) { return 4.0; })(state), 4.0);
}

TEST(Observable, HasTheSeriesOfTheMotionWhereItIsLinear) {
  const Problem scene = spring_cube(1);
  const Piece piece = piece_of(scene, 8, 0.5);
  const auto series = ObservableSeries([](const auto& t, const auto& x, const auto& v) {
                        return 2.0 * x(3, 1) - v(5, 0) + t;
                      }).along(piece);
  ASSERT_EQ(series.size(), 1u);
  ASSERT_EQ(series[0].c.size(), 9u);
  for (int k = 0; k <= 8; ++k)
    EXPECT_EQ(series[0].c[k], 2.0 * piece.position[k](3, 1) - piece.velocity[k](5, 0) + (k == 1 ? 1.0 : 0.0));
}

TEST(Observable, IsItsFunctionOfTheStateAllAlongAPiece) {
  // Polynomials of degree 5 with coefficients below 1, on steps of 1/8 and of 2, where one expansion does not do. Terms
  // are below 2^6 there, moved coefficients below 6 * 2^6, products below 2^14; the functions below 2^14.
  Uniform random(1);
  std::vector<double> c(6);
  for (double& x : c) x = random(-1, 1);
  std::size_t expansions = 0;
  const auto expect_function = [&](double h, const Observable& g) {
    const Piece piece = polynomial(2.0, 2.0 + h, c);
    ObservableSeries function(g);
    const auto series = function.along(piece);
    expansions = series.size();
    EXPECT_EQ(series.back().end, piece.end);
    for (std::size_t i = 0; i < series.size(); ++i) {
      EXPECT_EQ(series[i].begin, i == 0 ? piece.begin : series[i - 1].end);
      for (int j = 0; j < 10; ++j) {
        const double t = random(series[i].begin, series[i].end);
        EXPECT_NEAR(series[i].at(t), function(piece.at(t)), h < 1 ? 40 * eps : 0x1p14 * 40 * eps) << "seed 1";
      }
    }
  };
  const auto product = [](const auto&, const auto& x, const auto& v) { return x(0, 0) * v(0, 0) * 0.25; };
  const auto root = [](const auto& t, const auto& x, const auto&) {
    return sqrt(x(0, 0) * x(0, 0) + 0.25) - 0.1 * t;
  };
  const auto wave = [](const auto& t, const auto& x, const auto& v) {
    return sin(x(0, 0) + t) * cos(v(0, 0));
  };
  expect_function(0.125, product);
  EXPECT_EQ(expansions, 1u);
  expect_function(0.125, root);
  expect_function(0.125, wave);
  EXPECT_EQ(expansions, 1u);
  expect_function(2.0, product);
  EXPECT_EQ(expansions, 1u);
  expect_function(2.0, root);
  EXPECT_GT(expansions, 2u);
  expect_function(2.0, wave);
  EXPECT_GT(expansions, 2u);
}

TEST(Observable, ExistsUpToItsSingularity) {
  // sqrt(1 - s): each expansion ends before half of what is left, until 2^-30 of the step is.
  const Piece piece = polynomial(0.0, 2.0, {1.0, -1.0});
  const auto series =
      ObservableSeries([](const auto&, const auto& x, const auto&) { return sqrt(x(0, 0)); }).along(piece);
  EXPECT_LT(series.size(), 200u);
  for (const LocalSeries& part : series) EXPECT_EQ(part.is_finite(), part.end <= 1.0) << part.begin;
}

TEST(Clock, RoundsToTheSideThatIsAskedFor) {
  const double after_1 = std::nextafter(1.0, 2.0);
  EXPECT_EQ(time_after(1.0, 0.25), 1.25);
  EXPECT_EQ(time_after(1.0, 1e-17), after_1);
  EXPECT_EQ(time_after(1.0, 0.75 * eps), after_1);
  EXPECT_EQ(time_between(1.0, 1.25), 0.25);
  EXPECT_EQ(time_between(0x1p-60, 1.0), std::nextafter(1.0, 0.0));
  EXPECT_EQ(time_between(-0x1p-60, 1.0), 1.0);
  EXPECT_EQ(time_between(1.0, 1.0), 0.0);
  Uniform random(4);
  for (int i = 0; i < 1000; ++i) {
    const double begin = random(-1, 1) * std::exp2(random(-60, 3)),
                 s = random(0, 1) * std::exp2(random(-60, 3));
    EXPECT_LE(s, time_between(begin, time_after(begin, s))) << "seed 4";
    EXPECT_LE(time_after(begin, time_between(begin, begin + s)), begin + s) << "seed 4";
  }
}

TEST(Crossings, OfAPolynomialAreTheFirstDoubleAfterIt) {
  // begin + s is rounded up, never down: 1 + 1e-17 becomes the double after 1.
  const double after_1 = std::nextafter(1.0, 2.0);
  const auto of = [](std::vector<double> c, double begin, double end) {
    std::vector<LocalSeries> series{{begin, end, std::move(c)}};
    return crossings(series);
  };
  EXPECT_THAT(of({-0.25, 1.0}, 1.0, 2.0), ElementsAre(Crossing{1.25, true}));
  EXPECT_THAT(of({1e-17, -1.0}, 1.0, 2.0), ElementsAre(Crossing{after_1, false}));
  EXPECT_THAT(of({-0.75 * eps, 1.0}, 1.0, 2.0), ElementsAre(Crossing{after_1, true}));
  EXPECT_THAT(of({-1.0, 1.0}, 1.0, 2.0), ElementsAre(Crossing{2.0, true}));
  EXPECT_THAT(of({-1.0, 1.0}, 1.0, std::nextafter(2.0, 0.0)), IsEmpty());
  EXPECT_THAT(of({-1.0, 1.0}, 1.0, 1.0), IsEmpty());
  EXPECT_THAT(of({-1.0, 1.0}, 0x1p-60, 1.0), IsEmpty());  // at 1 + 2^-60
}

TEST(Crossings, OfSeriesThatFollowEachOtherAreFoundOnce) {
  // s - 1 on [0, 1], then on [1, 2] from a value that rounding has moved: by one side, by the other, or not.
  for (const double end : {1.0 - eps, 1.0, 1.0 + eps})
    for (const double value : {-1e-16, 0.0, 1e-16}) {
      std::vector<LocalSeries> series{{0.0, end, {-1.0, 1.0}}, {end, 2.0, {value, 1.0}}};
      const auto found = crossings(series);
      ASSERT_EQ(found.size(), 1u) << end << ", " << value;
      EXPECT_TRUE(found[0].rising);
      EXPECT_NEAR(found[0].time, 1.0, 2 * eps);
    }
  std::vector<LocalSeries> from_zero{{0.0, 1.0, {0.0, 1.0}}};
  EXPECT_THAT(crossings(from_zero), IsEmpty());  // left, not crossed
}

TEST(Crossings, OfAnOscillatorAreThoseOfTheCosine) {
  // To degree 40 the cosine is known to eps up to s = 7. There its terms are as large as
  // 7^7/7! = 163, each rounded by eps/2: the roots are off by less than sum_k 7^k/k! eps/2 = e^7 eps/2.
  const auto found = crossings(piece_of(oscillator(), 40, 7.0), position);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].time, 0.5 * std::numbers::pi, std::exp(1.6) * eps / 2 + 2 * eps);
  EXPECT_NEAR(found[1].time, 1.5 * std::numbers::pi, std::exp(4.8) * eps / 2 + 4 * eps);
  EXPECT_FALSE(found[0].rising);
  EXPECT_TRUE(found[1].rising);
}

TEST(Crossings, OfAProductOfPositionsAndVelocities) {
  // x v = -sin(2t)/2 is zero at every quarter; at 0 it is left.
  const auto found = crossings(piece_of(oscillator(), 30, 2.0),
                               [](const auto&, const auto& x, const auto& v) { return x(0, 0) * v(0, 0); });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].time, 0.5 * std::numbers::pi, std::exp(3.2) * eps);
  EXPECT_TRUE(found[0].rising);
}

TEST(Crossings, OfAConstantAreNone) {
  const Piece piece = piece_of(oscillator(), 5, 1.0);
  EXPECT_THAT(crossings(piece, [](const auto&, const auto&, const auto&) { return 0.0; }), IsEmpty());
  EXPECT_THAT(crossings(piece, [](const auto&, const auto& x, const auto&) { return x(0, 0) - x(0, 0); }),
              IsEmpty());
  EXPECT_THAT(crossings(piece, [](const auto&, const auto&, const auto&) { return -3.0; }), IsEmpty());
}

TEST(Crossings, RefuseWhatDoesNotExist) {
  const Piece piece = piece_of(oscillator(), 5, 1.0);
  const auto message = [](auto... text) {
    return ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(text)...));
  };
  EXPECT_THAT([&] { crossings(piece, [](const auto&, const auto& x, const auto&) { return x(1, 0); }); },
              message("x(1, 0)", "1 particles in 1 dimensions"));
  EXPECT_THAT([&] { crossings(piece, [](const auto&, const auto&, const auto& v) { return v(0, -1); }); },
              message("v(0, -1)"));
  EXPECT_THAT(
      [&] { crossings(piece, [](const auto&, const auto& x, const auto&) { return sqrt(x(0, 0) - 2.0); }); },
      message("no series at t = 0"));
}

}  // namespace
}  // namespace jetlag::testing::observable_test
