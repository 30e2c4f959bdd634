// SPDX-License-Identifier: MIT
// Explicit and implicit particles in one step: the limit is that of the explicit ones.
#include "jetlag/integrators/implicit/explicit_implicit.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "jetlag/control/courant.hpp"
#include "jetlag/forces/drag.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "schedule/avi/avi_for_tests.hpp"

namespace jetlag::testing::explicit_implicit_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Wall, ten unit masses (1 to 10), wall, all at 0; linear springs of 1, the last five of `stiff`.
Problem half_stiff_chain(double stiff = 1e4) {
  std::vector<double> stiffness(11, stiff);
  std::fill_n(stiffness.begin(), 6, 1.0);
  return line(std::vector<double>(10, 1.0), stiffness);
}

/// Masses first .. 10.
std::vector<bool> from(int first) {
  std::vector<bool> implicit(12, false);
  std::fill(implicit.begin() + first, implicit.begin() + 11, true);
  return implicit;
}

double radius(const Problem& chain, double h, const std::vector<bool>& implicit) {
  return spectral_radius(
      chain, [&] { return Lockstep(std::make_unique<ExplicitImplicit>(chain.system, h, implicit)); }, h);
}

// ---- stability ---------------------------------------------------------------------------------------------

// The explicit masses 1 .. 5 with masses 0 and 6 held: frequencies 2 sin(j pi / 12), the fastest sqrt(2 + sqrt(3)).
const double limit = 2 / std::sqrt(2 + std::sqrt(3.0));

TEST(ExplicitImplicit, IsStableUpToTheLimitOfTheExplicitParticles) {
  // Reference: 75-digit arithmetic. Where two eigenvalues have met at -1 the radius grows by 0.0045 for a millionth of h.
  const Problem chain = half_stiff_chain();
  EXPECT_NEAR(limit, 1.035276180410083, 1e-15);
  EXPECT_NEAR(radius(chain, 0.99999 * limit, from(6)), 1.0, 1e-12);
  EXPECT_NEAR(radius(chain, 1.00001 * limit, from(6)), 1.0089588, 1e-7);
  EXPECT_NEAR(radius(chain, 1.001 * limit, from(6)), 1.093457, 1e-6);
  for (const double share : {0.01, 0.1, 0.3, 0.5, 0.77, 0.9})
    EXPECT_NEAR(radius(chain, share * limit, from(6)), 1.0, 1e-12) << share;
}

TEST(ExplicitImplicit, GainsAHundredfoldOnLeapfrog) {
  const Problem chain = half_stiff_chain();
  const double fully_explicit = 0.0104221671;  // 2 / omega of the whole chain, 75 digits
  EXPECT_NEAR(radius(chain, 0.9999 * fully_explicit, from(11)), 1.0, 1e-12);
  EXPECT_GT(radius(chain, 1.0001 * fully_explicit, from(11)), 1.01);
  EXPECT_NEAR(limit / fully_explicit, 99.3, 0.05);
}

TEST(ExplicitImplicit, HasALimitThatDoesNotDependOnTheImplicitStiffness) {
  for (const double stiff : {1.0, 1e2, 1e6}) {
    const Problem chain = half_stiff_chain(stiff);
    EXPECT_NEAR(radius(chain, 0.999 * limit, from(6)), 1.0, 1e-11) << stiff;
    if (stiff > 1) {
      EXPECT_GT(radius(chain, 1.001 * limit, from(6)), 1.01) << stiff;
    }
  }
}

TEST(ExplicitImplicit, HasNoDriftOfTheEnergy) {
  // 1e5 steps at 0.99 of the limit, velocities of all frequencies: the largest energy of the last tenth of the run is
  // that of the first. What it oscillates by is (h omega / 2)^2 of the potential energy: a factor 1 / (1 - 0.98) at most.
  const Problem chain = half_stiff_chain();
  State<double> state = chain.start;
  for (int i = 1; i < 11; ++i) state.velocity(i, 0) = std::sin(1.0 + i * i);
  EnergyMeter energy(chain.system);
  const double begin = energy(state).total();
  double first = 0, last = 0;
  int step = 0;
  RunOptions options;
  options.observer.after_step = [&](const StepView& view) {
    const double total = energy(view.state()).total() / begin;
    if (++step <= 10'000) first = std::max(first, total);
    if (step > 90'000) last = std::max(last, total);
    return true;
  };
  Lockstep run(std::make_unique<ExplicitImplicit>(chain.system, 0.99 * limit, from(6)));
  ASSERT_EQ(run.run(state, 1e5 * 0.99 * limit, options).outcome, Outcome::success);
  EXPECT_LT(first, 51.0);
  EXPECT_NEAR(last / first, 1.0, 0.02);
}

TEST(ExplicitImplicit, FindsTheParticlesThatCannotBeExplicit) {
  // By the stiffness at both ends of their links, over masses: 4 for masses 1 .. 4, 10003 and more for those from 5 on.
  const Problem chain = half_stiff_chain();
  EXPECT_EQ(beyond_courant(chain.system, 0.999), from(5));
  EXPECT_EQ(beyond_courant(chain.system, 1.001), from(1));
  EXPECT_EQ(beyond_courant(chain.system, 0.009), from(11));
  EXPECT_NEAR(radius(chain, 0.999, beyond_courant(chain.system, 0.999)), 1.0, 1e-12);
}

// ---- the scheme --------------------------------------------------------------------------------------------

State<double> after(const Problem& scene, std::unique_ptr<Integrator> method, double until) {
  State<double> state = scene.start;
  EXPECT_EQ(Lockstep(std::move(method)).run(state, until, {}).outcome, Outcome::success);
  return state;
}

TEST(ExplicitImplicit, IsNewmarkWhereAllAreImplicitAndLeapfrogWhereNoneIs) {
  // Roundings of numbers below 2 in 40 steps, and what Newton's method leaves, as much.
  const Problem cube = spring_cube(3);
  const State<double> all =
      after(cube, std::make_unique<ExplicitImplicit>(cube.system, 0.05, std::vector<bool>(8, true)), 2.0);
  const State<double> none =
      after(cube, std::make_unique<ExplicitImplicit>(cube.system, 0.05, std::vector<bool>(8, false)), 2.0);
  const State<double> newmark = after(cube, std::make_unique<Newmark>(cube.system, 0.05), 2.0),
                      leapfrog = after(cube, std::make_unique<Leapfrog>(cube.system, 0.05), 2.0);
  EXPECT_LT((all.position - newmark.position).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((none.position - leapfrog.position).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_GT((all.position - none.position).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ExplicitImplicit, SolvesItsEquationsForForcesThatAreNotLinear) {
  // x_1 - x_0 - h v_0 = h^2/2 ((1 - 2 beta) a_0 + 2 beta a_1),  v_1 - v_0 = h/2 (a_0 + a_1), forces written down.
  Problem chain = ten_masses();
  for (int i = 0; i < 10; ++i) chain.start.position(i, 0) += 0.05 * std::cos(3.0 * i);
  const double h = 0.1;
  std::vector<bool> implicit(10, false);
  implicit[3] = implicit[4] = implicit[9] = true;
  ExplicitImplicit method(chain.system, h, implicit);
  State<double> state = chain.start;
  Report report;
  ASSERT_EQ(method.step(state, 1.0, report), h) << report.message;
  const auto a = [](const Coordinates<double>& x) {
    Coordinates<double> sum = 0.0 * x;
    for (int i = 0; i < 9; ++i) {
      const double s = x(i + 1, 0) - x(i, 0) - 1, f = (i % 2 == 0 ? 1.0 : 100.0) * (s + s * s * s);
      sum(i, 0) += f;
      sum(i + 1, 0) -= f;
    }
    return sum;
  };
  const Coordinates<double> a_0 = a(chain.start.position), a_1 = a(state.position);
  for (int i = 0; i < 10; ++i) {
    // Positions near 10 to 2e-15, forces of 100 of their differences.
    const double beta = implicit[i] ? 0.25 : 0.0;
    EXPECT_NEAR(state.position(i, 0) - chain.start.position(i, 0) - h * chain.start.velocity(i, 0),
                h * h / 2 * ((1 - 2 * beta) * a_0(i, 0) + 2 * beta * a_1(i, 0)), 1e-14);
    EXPECT_NEAR(state.velocity(i, 0) - chain.start.velocity(i, 0), h / 2 * (a_0(i, 0) + a_1(i, 0)), 1e-13);
  }
}

TEST(ExplicitImplicit, MeetsDragByTheTrapezoidalRuleForBothKinds) {
  // v_1 = (1 - c h/2) / (1 + c h/2) v_0, even where c h is large.
  System<double> system(1, {1.0, 1.0});
  system.add<Drag>({{0}, {1}}, {{100.0}});
  ExplicitImplicit method(system, 0.25, {false, true});
  State<double> state{0.0, Coordinates<double>::Zero(2, 1), Coordinates<double>::Ones(2, 1)};
  Report report;
  ASSERT_EQ(method.step(state, 1.0, report), 0.25) << report.message;
  for (const int i : {0, 1})
    EXPECT_NEAR(state.velocity(i, 0), -11.5 / 13.5, 100 * std::numeric_limits<double>::epsilon());
}

TEST(ExplicitImplicit, SolvesForTheImplicitParticlesOnly) {
  // Eleven linear links: at the beginning of the step, then twice, as the second change is rounding, the forces, and what
  // the implicit masses change of the others; and of the three links that touch these two, forces and a column for each
  // of the two masses.
  const Problem chain = half_stiff_chain();
  ExplicitImplicit method(chain.system, 0.009, from(9));
  State<double> state = chain.start;
  state.velocity(5, 0) = 1;
  Report report;
  ASSERT_EQ(method.step(state, 1.0, report), 0.009);
  EXPECT_EQ(method.work().element_coefficients, 11u * (1 + 2 * (1 + 1)) + 3u * 2 * (1 + 2));
}

TEST(ExplicitImplicit, RefusesWhatIsNone) {
  const Problem chain = half_stiff_chain();
  EXPECT_THROW(ExplicitImplicit(chain.system, 0.0, from(6)), std::invalid_argument);
  EXPECT_THAT([&] { ExplicitImplicit(chain.system, 0.1, {true, false}); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("each of 12 particles")));
}

}  // namespace
}  // namespace jetlag::testing::explicit_implicit_test
