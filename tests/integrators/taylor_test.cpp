// SPDX-License-Identifier: MIT
// Taylor's method of a fixed degree: planets against Kepler's equation, and what a step costs.

#include "jetlag/integrators/taylor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/variance_target.hpp"
#include "jetlag/forces/drag.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/truncation/draws.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::taylor_test {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

TEST(Kepler, SolutionOfTheTestsHasThePublishedDigits) {
  // Positions and velocities in 75-digit arithmetic, e = .9, .99, .999.
  struct Case {
    double e, t, x, y, vx, vy;
  };
  for (const Case& c : {Case{.9, 20, -1.295266250987574367717139, 0.4003938963792321527297696,
                             -0.6775390924707565887476366, -0.1270838154278686187668703},
                        {.99, 10, -1.947930813572708947842054, -0.04048622324344129162115774,
                         0.1473036186692106124223787, -0.06935749035093105314037271},
                        {.99, 100, -0.9388973273317407724449242, -0.1408830418653661464724342,
                         1.05191133041805098489986, 0.007593064755590507594282895},
                        {.99, 1000, -1.320695160352823732570402, 0.1331305755538241558829508,
                         -0.7109733399769305556366436, -0.03514442335785163031050133},
                        {.999, 100, -0.9573122285019766715756194, -0.04467131067346636135677615,
                         1.042548759946955408877559, 0.001944863629836511556033418}}) {
    SCOPED_TRACE(::testing::Message() << "e = " << c.e << ", t = " << c.t);
    const KeplerPoint p = kepler(c.e, c.t);
    // The published e is decimal, ours the nearest double, 1e-16 off: x by as much, e' of v by 1/(1 - e cos
    // E) more; 80 bits of t at 1000 are 5e-17.
    EXPECT_NEAR(p.position.x(), c.x, 2e-15);
    EXPECT_NEAR(p.position.y(), c.y, 2e-15);
    EXPECT_NEAR(p.velocity.x(), c.vx, 2e-15);
    EXPECT_NEAR(p.velocity.y(), c.vy, 2e-15);
  }
}

/// The planet's run by degree 20 and Jorba-Zou: the largest relative energy error, and where it ends.
struct PlanetRun {
  double energy_error = 0;
  State<double> end;
};
PlanetRun run_planet(double e, double until) {
  const Problem scene = planet(e);
  EnergyMeter energy(scene.system);
  PlanetRun run;
  RunOptions options;
  options.observer.after_step = [&](const StepView& view) {
    run.energy_error = std::max(run.energy_error, std::abs(energy(view.state()).total() + 0.5) / 0.5);
    return true;
  };
  run.end = scene.start;
  EXPECT_EQ(
      Lockstep(taylor(scene.system, 20, std::make_unique<JorbaZou>())).run(run.end, until, options).outcome,
      Outcome::success);
  return run;
}

/// How far the planet may be off after t, as its energy is off by at most `energy_error`: the period goes
/// with |E|^(-3/2), so that the phase is off by 3/2 t of it. Along the orbit, at its present speed; rounding
/// of the start beside it.
double position_tolerance(double energy_error, double t, const KeplerPoint& truth) {
  return 1.5 * energy_error * t * truth.velocity.norm() + 1e-15;
}

TEST(Taylor, KeepsThePlanetsEnergyOverAHundredPeriods) {
  const double e = 0.5, until = 100 * two_pi;
  const PlanetRun run = run_planet(e, until);
  EXPECT_LT(run.energy_error, 1e-13);
  const KeplerPoint truth = kepler(e, until);
  EXPECT_LT((run.end.position.row(1) - truth.position).norm(), position_tolerance(1e-13, until, truth));
}

TEST(Taylor, FollowsAnOrbitOfEccentricityPointNinetyNine) {
  const double e = 0.99;
  for (double until : {10.0, 100.0}) {
    const PlanetRun run = run_planet(e, until);
    // 100 times closer to the sun than far away, kinetic and potential energy cancel to one hundredth.
    EXPECT_LT(run.energy_error, 1e-12);
    const KeplerPoint truth = kepler(e, until);
    EXPECT_LT((run.end.position.row(1) - truth.position).norm(), position_tolerance(1e-12, until, truth));
  }
}

TEST(Taylor, IsThePartialSumOfTheExponentialOnAnOscillator) {
  // One step of degree N: x + i v = sum (-i h)^n / n! to the last few bits.
  const double h = 0.5;
  for (int degree : {1, 2, 5, 8, 20}) {
    const Problem scene = oscillator();
    State<double> state = scene.start;
    Report report;
    taylor(scene.system, degree, std::make_unique<FixedStep>(h))->step(state, 1.0, report);
    std::complex<long double> sum = 1, term = 1;
    for (int n = 1; n <= degree; ++n)
      sum += term *= std::complex<long double>(0, -h) / static_cast<long double>(n);
    const double tolerance = 4 * std::numeric_limits<double>::epsilon();
    EXPECT_NEAR(state.position(0, 0), static_cast<double>(sum.real()), tolerance) << degree;
    EXPECT_NEAR(state.velocity(0, 0), static_cast<double>(sum.imag()), tolerance) << degree;
  }
}

TEST(Taylor, RefusesDegreesBelowOne) {
  EXPECT_THROW(taylor(oscillator().system, 0, std::make_unique<FixedStep>(0.1)), std::invalid_argument);
}

// ---- what it costs ----------------------------------------------------------------------------------------

Work work_of(const System<double>& system, const State<double>& start, TruncationLaw law,
             std::unique_ptr<Control> control, RandomTaylor::Options options, int steps) {
  RandomTaylor integrator(system, std::move(law), std::move(control), options);
  State<double> state = start;
  Report report;
  for (int i = 0; i < steps; ++i) EXPECT_GT(integrator.step(state, 0.125, report), 0.0);
  return integrator.work();
}

TEST(Work, IsTheDegreeForEachElementAndStep) {
  // Velocities from their own series need coefficient N + 1 of x, and so N coefficients of the force; from
  // the derivative of x, one less.
  const Problem scene = spring_cube(1);  // 28 springs, 8 particles
  for (int degree : {2, 6, 11}) {
    const Work own = work_of(scene.system, scene.start, fixed_degree(degree),
                             std::make_unique<FixedStep>(0.125), {1, true, VelocitySeries::own_series}, 10);
    EXPECT_EQ(own.element_coefficients, 28u * 10 * degree);
    EXPECT_EQ(own.coefficients, 8u * 10 * degree);
    EXPECT_EQ(own.degrees, 8u * 10 * degree);
    EXPECT_EQ(own.mean_degree(), degree);
    const Work derived =
        work_of(scene.system, scene.start, fixed_degree(degree), std::make_unique<FixedStep>(0.125),
                {1, true, VelocitySeries::derivative}, 10);
    EXPECT_EQ(derived.element_coefficients, 28u * 10 * (degree - 1));
    EXPECT_EQ(derived.coefficients, 8u * 10 * (degree - 1));
    EXPECT_EQ(derived.degrees, 8u * 10 * degree);
  }
}

TEST(Work, CountsAForceThatDoesNotChangeOnceAStep) {
  // A uniform field has one coefficient, whatever the degree; drag has as many as the velocity.
  const Problem fall = free_fall();
  EXPECT_EQ(work_of(fall.system, fall.start, fixed_degree(9), std::make_unique<FixedStep>(0.125), {}, 10)
                .element_coefficients,
            10u);
  Problem dragged = free_fall();
  dragged.system.add<Drag>({{0}}, {{0.5}});
  EXPECT_EQ(
      work_of(dragged.system, dragged.start, fixed_degree(9), std::make_unique<FixedStep>(0.125), {}, 10)
          .element_coefficients,
      10u + 10u * 9);
}

TEST(Work, DoesNotGrowWithAControlThatReadsWhatIsNeededAnyway) {
  const Problem scene = spring_cube(2);
  const Work fixed =
      work_of(scene.system, scene.start, fixed_degree(12), std::make_unique<JorbaZou>(0.125), {}, 10);
  EXPECT_EQ(fixed.element_coefficients, 28u * 10 * 12);
}

TEST(Work, IsThatOfTheDrawnDegreesWhereAControlForecastsTheTail) {
  const Problem scene = spring_cube(3);
  const Work work = work_of(scene.system, scene.start, geometric(3, 9, 0.5),
                            std::make_unique<VarianceTarget>(0.125, 0.125, 1e-3, 1e-3), {}, 100);
  EXPECT_EQ(work.element_coefficients * 8,
            work.degrees * 28);        // the control reads x_4, which K = 3 needs as well
  EXPECT_LT(work.mean_degree(), 5.0);  // 3.98 + 5 sqrt(1.9 / 100) at most
}

TEST(Work, IsTheMeanDegreeWithOneDrawForAll) {
  const Problem scene = spring_cube(4);
  const TruncationLaw law = geometric(3, 9, 0.5);
  const int steps = 2000;
  const Work work = work_of(scene.system, scene.start, law, std::make_unique<FixedStep>(0.0625), {}, steps);
  EXPECT_EQ(work.element_coefficients * 8, work.degrees * 28);  // no order above K is computed
  EXPECT_EQ(work.coefficients, work.degrees);
  // K - 3 is geometric of variance (1-p)/p^2 = 2 at most: 5 sigma.
  EXPECT_NEAR(work.mean_degree(), law.mean(), 5 * std::sqrt(2.0 / steps)) << "seed 1";
}

TEST(Work, IsTheLargestDegreeOfAllWithADrawForEachParticle) {
  Problem scene = spring_cube(5);
  scene.system.fix(2);
  scene.start.velocity.row(2).setZero();
  const TruncationLaw law = geometric(3, 9, 0.5);
  const int steps = 2000;
  const Work work =
      work_of(scene.system, scene.start, law, std::make_unique<FixedStep>(0.0625), {1, false}, steps);
  std::uint64_t largest = 0, sum = 0;
  for (int step = 0; step < steps; ++step) {
    int k = 0;
    for (int i = 0; i < 8; ++i)
      if (i != 2) {
        const int drawn = law.draw(uniform(1, i, step));
        k = std::max(k, drawn);
        sum += drawn;
      }
    largest += k;
  }
  EXPECT_EQ(work.element_coefficients, 28u * largest) << "seed 1";
  EXPECT_EQ(work.coefficients, 7u * largest) << "seed 1";
  EXPECT_EQ(work.degrees, sum) << "seed 1";
  EXPECT_EQ(work.updates, 7u * steps);
}

}  // namespace
}  // namespace jetlag::testing::taylor_test
