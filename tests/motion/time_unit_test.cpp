// SPDX-License-Identifier: MIT
// A series may count time in a unit of its own: the same motion, and in range where seconds are not.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/halve_double.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/variance_target.hpp"
#include "jetlag/forces/drag.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::time_unit_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Springs, friction and a force that depends on the time.
Problem shaken_cube() {
  Problem scene = spring_cube(1);
  for (int i = 0; i < 8; ++i) {
    scene.system.add<Drag>({{i}}, {{0.25}});
    scene.system.add<Shaker>({{i}}, {{3.0}});
  }
  scene.start.time = 0.75;
  return scene;
}

TEST(TimeUnit, ScalesCoefficientsByItsPowersAndKeepsTheirBits) {
  const Problem scene = shaken_cube();
  Expansion<double> seconds(scene.system), other(scene.system);
  seconds.start(scene.start);
  seconds.grow_to(16);
  for (double unit : {0x1p-20, 0.5, 8.0, 0x1p20, -0.5, -2.0}) {  // a negative one counts backwards
    other.start(scene.start, unit);
    other.grow_to(16);
    EXPECT_EQ(other.time_unit(), unit);
    for (int k = 0; k <= 16; ++k) {
      const double power = std::pow(unit, k);
      EXPECT_EQ(other.position(k), power * seconds.position(k)) << unit << ", order " << k;
      if (k < 16) {
        EXPECT_EQ(other.velocity(k), power * seconds.velocity(k)) << unit << ", order " << k;
      }
    }
  }
}

TEST(TimeUnit, IsForgottenWhenASeriesStartsAnew) {
  const Problem scene = oscillator();
  Expansion<double> series(scene.system);
  series.start(scene.start, 8.0);
  series.start(scene.start);
  series.grow_to(2);
  EXPECT_EQ(series.time_unit(), 1.0);
  EXPECT_EQ(series.position(2)(0, 0), -0.5);
}

TEST(TimeUnit, IsFiniteAndNotZero) {
  const Problem scene = oscillator();
  Expansion<double> series(scene.system);
  for (double bad : {0.0, -0.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(series.start(scene.start, bad), std::invalid_argument) << bad;
}

/// A step of h w = 1 at rate w by degree 24, of which coefficient 24 is beyond doubles at both rates.
struct Step {
  State<double> end;
  Piece piece;
};
Step step_at(double w, VelocitySeries velocity) {
  const Problem scene = circular_oscillator(w);
  RandomTaylor integrator(scene.system, fixed_degree(24), std::make_unique<FixedStep>(1 / w),
                          {1, true, velocity});
  Step step{scene.start, {}};
  Report report;
  EXPECT_EQ(integrator.step(step.end, 1e300, report), 1 / w) << report.message;
  step.piece = integrator.piece();
  return step;
}

TEST(TimeUnit, OfAPieceIsThatOfItsPolynomials) {
  for (double w : {1e-16, 1.0, 1e16})
    for (VelocitySeries velocity : {VelocitySeries::own_series, VelocitySeries::derivative}) {
      const auto [end, piece] = step_at(w, velocity);
      EXPECT_EQ(piece.unit == 1, w == 1);
      const Piece later = piece.about(0.25 / w);
      for (double phase : {0.25, 0.5, 1.0})
        for (const Piece* p : {&piece, &later}) {
          // Powers of phases up to 1, Horner's rule on 25 terms below 1.
          const State<double> state = p->at(phase / w);
          EXPECT_NEAR(state.position(0, 0), std::cos(phase), 30 * eps) << w;
          EXPECT_NEAR(state.position(0, 1), std::sin(phase), 30 * eps) << w;
          EXPECT_NEAR(state.velocity(0, 0) / w, -std::sin(phase), 30 * eps) << w;
          EXPECT_NEAR(state.velocity(0, 1) / w, std::cos(phase), 30 * eps) << w;
        }
      EXPECT_NEAR(end.position(0, 0), std::cos(1.0), 30 * eps) << w;
      EXPECT_NEAR(evaluate(polynomials(piece, 0)[1], 1 / w / piece.unit), std::sin(1.0), 30 * eps) << w;
    }
}

/// h w of the first step of a control on a circle at rate w; its coefficients are beyond doubles at both ends.
double phase_of_first_step(double w, const TruncationLaw& law, std::unique_ptr<Control> control) {
  Problem scene = circular_oscillator(w);
  RandomTaylor integrator(scene.system, law, std::move(control));
  Report report;
  return w * integrator.step(scene.start, 1e300, report);
}

TEST(TimeUnit, DoesNotChangeTheStepOfAnyControl) {
  const TruncationLaw law = geometric(8, 24, 0.5);
  const auto phases = [&](double w) {
    return std::array{
        phase_of_first_step(w, law, std::make_unique<JorbaZou>()),
        phase_of_first_step(w, law, std::make_unique<HalveDouble>(2 / w, 2 / w, 1e-30, 1e-20, 8)),
        phase_of_first_step(w, law, std::make_unique<VarianceTarget>(2 / w, 2 / w, 1e-12, 1e-12))};
  };
  const auto truth = phases(1.0);
  for (double w : {1e-16, 1e16})
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(phases(w)[i], truth[i], 1e-12 * truth[i]) << w << ", control " << i;
}

TEST(TimeUnit, IsLeftAloneWhereASeriesEndsOrTheForceIsSingular) {
  // Free fall and rest look like underflow, coincident particles like overflow.
  for (double scale : {1e-3, 1.0, 1e3}) {
    Problem fall = free_fall();
    fall.start.position *= scale;
    RandomTaylor integrator(fall.system, fixed_degree(12), std::make_unique<JorbaZou>());
    Report report;
    EXPECT_EQ(integrator.step(fall.start, 2.0, report), 2.0);
    EXPECT_EQ(integrator.piece().unit, 1.0);
    EXPECT_EQ(integrator.work().element_coefficients, 1u);
  }
  Problem coincident = falling_together(0.0);
  RandomTaylor integrator(coincident.system, fixed_degree(12), std::make_unique<JorbaZou>());
  Report report;
  EXPECT_EQ(integrator.step(coincident.start, 2.0, report), 0.0);
  EXPECT_EQ(report.outcome, Outcome::non_finite);
}

}  // namespace
}  // namespace jetlag::testing::time_unit_test
