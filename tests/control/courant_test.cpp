// SPDX-License-Identifier: MIT
// The Courant limit: how fast springs can oscillate, and what steps that allows.

#include "jetlag/control/courant.hpp"

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/forces/drag.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/forces/uniform_field.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/eigenvalues.hpp"
#include "support/laws/laws_of_many.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::courant_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Without damping, for velocities of their own series: the limit on the imaginary axis.
double undamped_limit(const TruncationLaw& law) {
  return courant_limit(law, VelocitySeries::own_series, 1.0, 0.0);
}

TEST(CourantLimit, CountsTheVelocitysSeriesAndTheDamping) {
  const TruncationLaw law = geometric(3, 6, 0.5);
  using enum VelocitySeries;
  EXPECT_NEAR(undamped_limit(geometric(3, 4, 0.5)), 2.0, 1e-12);
  EXPECT_EQ(courant_limit(law, own_series, 246.3, 0.0), 0.0);
  EXPECT_NEAR(courant_limit(law, own_series, 246.295092, 0.2) / 246.295092, 0.00352, 3e-5);
  EXPECT_NEAR(courant_limit(law, derivative, 246.295092, 0.2) / 246.295092, 0.00225, 3e-5);
}

TEST(CommonDamping, IsThatOfDragWhereItIsTheSameForAllMovingParticles) {
  Problem scene = dumbbell(8.0, 1.0, 2.0);
  EXPECT_EQ(common_damping(scene.system), 0.0);
  scene.system.add<Drag>({{0}, {1}}, {{0.3}, {0.6}});
  EXPECT_DOUBLE_EQ(common_damping(scene.system), 0.3);
  scene.system.add<Drag>({{1}}, {{0.2}});  // and now particle 1 is slowed at a rate of 0.4
  EXPECT_EQ(common_damping(scene.system), 0.0);
  scene.system.fix(0);
  EXPECT_DOUBLE_EQ(common_damping(scene.system), 0.4);
}

/// F = -c v, by another name, and with one that says nothing of itself.
struct Damper {
  static constexpr const char* name = "damper";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"tau", "coefficient"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& tau, const T& c) {
    return T(-c / tau) * p.velocity[0];
  }
  static double damping(double tau, double c) { return c / tau; }
};
struct Friction {
  static constexpr const char* name = "friction";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"coefficient"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& c) {
    return T(-c * p.velocity[0].squaredNorm()) * p.velocity[0];
  }
};

TEST(CommonDamping, IsThatOfAnyLawThatStatesOne) {
  Problem scene = dumbbell(8.0, 1.0, 2.0);
  scene.system.add<Friction>({{0}, {1}}, {{0.3}, {0.6}});  // of one participant and one parameter, as drag
  scene.system.add<Tether>({{0}, {1}}, {{0.3}, {0.6}});
  EXPECT_EQ(common_damping(scene.system), 0.0);
  scene.system.add<Damper>({{0}, {1}}, {{2.0, 0.6}, {0.5, 0.3}});
  EXPECT_DOUBLE_EQ(common_damping(scene.system), 0.3);
  scene.system.add<Drag>({{0}, {1}}, {{0.1}, {0.2}});
  EXPECT_DOUBLE_EQ(common_damping(scene.system), 0.4);
}

// ---- frequencies ------------------------------------------------------------------------------------------

/// The fastest frequency at rest: eigenvalues of M^-1/2 K M^-1/2, K = sum over springs of k d d^T, without
/// the rows of fixed particles.
double fastest_frequency(const System<double>& system, const Coordinates<double>& rest) {
  const int d = system.dimension(), n = system.particles() * d;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
  for (const auto& elements : system.elements())
    for (std::size_t e = 0; e < elements.count(); ++e) {
      const int a = elements.particles[2 * e], b = elements.particles[2 * e + 1];
      const Eigen::VectorXd direction = (rest.row(b) - rest.row(a)).normalized().transpose();
      Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
      if (!system.fixed()[a]) row.segment(a * d, d) = direction / std::sqrt(system.mass()[a]);
      if (!system.fixed()[b]) row.segment(b * d, d) = -direction / std::sqrt(system.mass()[b]);
      stiffness += elements.parameters[2 * e] * row * row.transpose();
    }
  return std::sqrt(largest_eigenvalue(stiffness));
}

TEST(FrequencyBound, IsExactForOneSpring) {
  for (auto [k, a, b] : {std::tuple{1.0, 1.0, 1.0}, {5e3, 1.0, 1e-3}, {2.0, 3.0, 7.0}})
    EXPECT_DOUBLE_EQ(frequency_bound(dumbbell(k, a, b).system), std::sqrt(k * (1 / a + 1 / b)));
}

TEST(FrequencyBound, IsNotBelowTheFastestFrequencyOfANetwork) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Problem scene = spring_cube(seed);
    if (seed % 2 == 0) scene.system.fix(static_cast<int>(seed % 8));
    const double truth = fastest_frequency(scene.system, scene.start.position),
                 bound = frequency_bound(scene.system);
    EXPECT_GE(bound, truth) << "seed " << seed;
    EXPECT_LE(bound, 3 * truth) << "seed " << seed;  // and is of use: at most sqrt(7 springs at a particle)
  }
}

TEST(FrequencyBound, TakesFixedParticlesAsInfinitelyHeavy) {
  Problem scene = dumbbell(8.0, 1.0, 2.0);
  scene.system.fix(0);
  EXPECT_DOUBLE_EQ(frequency_bound(scene.system), 2.0);
  scene.system.fix(1);
  EXPECT_EQ(frequency_bound(scene.system), 0.0);
}

TEST(FrequencyBound, IsZeroWithoutStiffness) {
  EXPECT_EQ(frequency_bound(free_fall().system), 0.0);
  EXPECT_EQ(frequency_bound(planet(0.5).system), 0.0);
}

TEST(FrequencyBound, HoldsForElementsOfThree) {
  // Rows of particles that are bent and stretched, linear: K is exact. Sum over elements of k a a^T, a = (1, 1, -2).
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::uint64_t drawn = 0;
    const auto random = [&](double low, double high) {
      return low + (high - low) * uniform(seed, 0, drawn++);
    };
    const int n = 9;
    std::vector<double> mass(n);
    for (double& m : mass) m = std::exp(random(-3, 3));
    System<double> system(1, mass);
    if (seed % 2 == 0) system.fix(static_cast<int>(seed % n));
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
    const auto add = [&](const std::vector<std::pair<int, double>>& a, double k) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
      for (const auto& [i, factor] : a)
        if (!system.fixed()[i]) row(i) = factor / std::sqrt(mass[i]);
      stiffness += k * row * row.transpose();
    };
    for (int i = 0; i + 2 < n; ++i) {
      const double bend = std::exp(random(-3, 3)), stretch = std::exp(random(-3, 3));
      system.add<Bend>({{i, i + 2, i + 1}}, {{bend}});
      add({{i, 1}, {i + 2, 1}, {i + 1, -2}}, bend);
      system.add<Spring>({{i, i + 1}}, {{stretch, 1.0}});
      add({{i, 1}, {i + 1, -1}}, stretch);
    }
    const double truth = std::sqrt(largest_eigenvalue(stiffness));
    EXPECT_GE(frequency_bound(system), truth * (1 - 1e-12)) << "seed " << seed;
    EXPECT_LE(frequency_bound(system), 3 * truth) << "seed " << seed;
    const std::vector<double> bounds = frequency_bounds(system);
    EXPECT_EQ(*std::ranges::max_element(bounds), frequency_bound(system));
  }
}

/// F = c d |d|^2, whose stiffness nobody has said.
struct Hardening {
  static constexpr const char* name = "hardening";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"constant"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& constant) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return T(constant * d.squaredNorm()) * d;
  }
};

TEST(FrequencyBound, SaysWhichForceItDoesNotBound) {
  Problem scene = dumbbell(8.0, 1.0, 2.0);
  scene.system.add<UniformField>({{0}}, {{1.0, 0.0, 0.0}});  // acts everywhere alike
  scene.system.add<Drag>({{0}}, {{0.1}});
  EXPECT_EQ(unbounded_force(scene.system), "");
  scene.system.add<Gravity>({{0, 1}}, {{1e-9}});              // says itself that it is not counted
  EXPECT_EQ(frequency_bound(scene.system), std::sqrt(12.0));  // that of the spring alone
  EXPECT_EQ(unbounded_force(scene.system), "gravity");
  EXPECT_NO_THROW(require_bounded(scene.system));
}

TEST(FrequencyBound, IsNoLimitBesideAForceOfUnknownStiffness) {
  Problem scene = dumbbell(8.0, 1.0, 2.0);
  scene.system.add<Hardening>({{0, 1}}, {{1.0}});
  EXPECT_EQ(frequency_bound(scene.system), std::sqrt(12.0));
  EXPECT_EQ(unbounded_force(scene.system), "hardening");
  const auto names_it = ThrowsMessage<std::invalid_argument>(HasSubstr("no stiffness is known of hardening"));
  EXPECT_THAT([&] { require_bounded(scene.system); }, names_it);
  EXPECT_THAT(
      [&] { courant_steps_of_particles(scene.system, fixed_degree(4), VelocitySeries::own_series, 0.5); },
      names_it);
}

// ---- the crop ---------------------------------------------------------------------------------------------

std::unique_ptr<Control> cropped_to(double safety, double limit, double omega, double step) {
  return std::make_unique<Courant>(std::make_unique<FixedStep>(step), safety, limit, omega);
}

/// The energy of the stretching after 10^4 steps, over that at the start.
double energy_ratio(const Problem& scene, std::unique_ptr<Integrator> integrator) {
  EnergyMeter energy(scene.system);
  Lockstep lockstep(std::move(integrator));
  State<double> state = scene.start;
  RunOptions options;
  options.max_steps = 10'000;
  const Report report = lockstep.run(state, std::numeric_limits<double>::infinity(), options);
  if (report.outcome == Outcome::non_finite) return std::numeric_limits<double>::infinity();
  return energy(state).total() / energy(scene.start).total();
}

TEST(Courant, KeepsTheStiffestSpringStableAndNoStepMuchLongerWould) {
  // One spring, of known frequency: 0.1 % below the limit the energy falls, 0.1 % above it grows.
  const Problem scene = dumbbell(5e3, 1.0, 2.0);
  const double omega = frequency_bound(scene.system);
  for (int degree : {3, 4, 7, 8}) {
    const double limit = undamped_limit(fixed_degree(degree));
    EXPECT_LT(energy_ratio(scene, taylor(scene.system, degree, cropped_to(0.999, limit, omega, 1.0))), 1.0)
        << degree;
    const double beyond = 1.001 * limit;
    EXPECT_GT(energy_ratio(scene, taylor(scene.system, degree, cropped_to(1.0, beyond, omega, 1.0))), 1.01)
        << degree;
  }
}

TEST(Courant, KeepsADampedSpringStableAtADegreeThatNeedsDamping) {
  // Degree 6 gives energy at every step, drag takes it: 0.1 % below and 0.5 % above the step where they are even.
  Problem scene = dumbbell(5e3, 1.0, 2.0);
  scene.system.add<Drag>({{0}, {1}}, {{0.5}, {1.0}});
  const double omega = frequency_bound(scene.system), damping = common_damping(scene.system);
  const double limit = courant_limit(fixed_degree(6), VelocitySeries::own_series, omega, damping);
  EXPECT_LT(energy_ratio(scene, taylor(scene.system, 6, cropped_to(0.999, limit, omega, 1.0))), 1.0);
  EXPECT_GT(energy_ratio(scene, taylor(scene.system, 6, cropped_to(1.0, 1.005 * limit, omega, 1.0))), 1.01);
}

TEST(Courant, KeepsANetworkStable) {
  for (std::uint64_t seed : {1, 2, 3}) {
    const Problem scene = spring_cube(seed);
    const double limit = undamped_limit(fixed_degree(4)), omega = frequency_bound(scene.system);
    // All the energy is above that of the centre of mass, which no method changes: it must not grow.
    EXPECT_LE(energy_ratio(scene, taylor(scene.system, 4, cropped_to(1.0, limit, omega, 1.0))), 1.0)
        << "seed " << seed;
  }
}

TEST(Courant, CropsOnlyStepsThatAreTooLong) {
  const Problem scene = dumbbell(4.0, 2.0, 2.0);  // omega = 2
  Expansion<double> series(scene.system);
  series.start(scene.start);
  const TruncationLaw law = fixed_degree(4);
  EXPECT_EQ(cropped_to(0.5, 3.0, 2.0, 10.0)->propose({series, law}), 0.75);
  EXPECT_EQ(cropped_to(0.5, 3.0, 2.0, 0.5)->propose({series, law}), 0.5);
  EXPECT_EQ(cropped_to(0.5, 3.0, 2.0, 10.0)->clone()->propose({series, law}), 0.75);
  EXPECT_EQ(cropped_to(0.5, 3.0, 0.0, 10.0)->propose({series, law}), 10.0);  // nothing oscillates
}

/// Two particles that fly apart, at a distance of 1 m now. omega^2 = 3 c d^2 (1/m_0 + 1/m_1): 6 at d = 1.
Problem flight(double speed) {
  Problem scene{System<double>(2, {1.0, 1.0}), {0.0, Coordinates<double>(2, 2), Coordinates<double>(2, 2)}};
  scene.start.position << 0, 0, 0.6, 0.8;
  scene.start.velocity << 0, 0, 0.6 * speed, 0.8 * speed;
  scene.system.add<Hardening>({{0, 1}}, {{1.0}});
  return scene;
}

TEST(Courant, TakesTheBoundOfAStateAnewAfterSomeSteps) {
  const TruncationLaw law = fixed_degree(4);
  const double limit = undamped_limit(law);
  Problem scene = flight(0.0);
  Courant control(std::make_unique<FixedStep>(10.0), 0.5, scene.system, law, VelocitySeries::own_series, 3);
  Expansion<double> series(scene.system);
  double distance = 1, at_bound = 1;
  for (int n = 0; n < 9; ++n) {
    scene.start.position *= 1.25;  // before the first step, too
    distance *= 1.25;
    if (n % 3 == 0) at_bound = distance;
    series.start(scene.start, n == 6 ? 0.25 : 1.0);  // the unit of time is of no account
    const double truth = 0.5 * limit / (1.05 * std::sqrt(6.0) * at_bound);
    const auto copy = control.clone();
    EXPECT_NEAR(control.propose({series, law}), truth, 1e-14 * truth);  // some 50 roundings
    EXPECT_NEAR(copy->propose({series, law}), truth, 1e-14 * truth);    // goes on where the first one was
    const CourantFrequency said = control.courant_frequency().value();
    EXPECT_NEAR(said.bound, std::sqrt(6.0) * at_bound, 1e-14 * said.bound);
    EXPECT_EQ(said.refreshed, n / 3);
  }
}

TEST(Courant, ShortensStepsAsALawStiffens) {
  // 200 steps; the spring is 4 m long when it turns: v^2/4 = d^4/4, v = 16 m/s.
  const Problem scene = flight(16.0);
  const TruncationLaw law = fixed_degree(4);
  Lockstep lockstep(taylor(scene.system, 4,
                           std::make_unique<Courant>(std::make_unique<FixedStep>(10.0), 0.1, scene.system,
                                                     law, VelocitySeries::own_series, 1)));
  State<double> state = scene.start;
  RunOptions options;
  options.max_steps = 200;
  std::vector<double> steps;
  options.observer.after_step = [&](const StepView& step) {
    steps.push_back(step.end() - step.begin());
    return true;
  };
  lockstep.run(state, std::numeric_limits<double>::infinity(), options);
  EXPECT_LT(*std::ranges::min_element(steps), steps.front() / 3.5);
  EXPECT_EQ(lockstep.courant_frequency().value().refreshed, steps.size() - 1);
}

TEST(Courant, IsThatOfAllStatesWhereEveryLawHasAStiffness) {
  const Problem scene = dumbbell(4.0, 2.0, 2.0);  // omega = 2
  Expansion<double> series(scene.system);
  series.start(scene.start);
  const TruncationLaw law = fixed_degree(4);
  Courant control(std::make_unique<FixedStep>(10.0), 0.5, scene.system, law, VelocitySeries::own_series);
  EXPECT_EQ(control.propose({series, law}), 0.5 * undamped_limit(law) / 2.0);
  EXPECT_EQ(control.courant_frequency().value().bound, 2.0);
  EXPECT_EQ(control.courant_frequency().value().refreshed, 0u);
  EXPECT_FALSE(FixedStep(1.0).courant_frequency().has_value());
}

TEST(Courant, GivesParticlesStepsOfAState) {
  Problem scene = flight(0.0);
  const TruncationLaw law = fixed_degree(4);
  const auto steps = [&](const State<double>& state) {
    return courant_steps_of_particles(scene.system, state, law, VelocitySeries::own_series, 0.5);
  };
  const double truth = 0.5 * undamped_limit(law) / (1.05 * std::sqrt(6.0));
  for (const double step : steps(scene.start)) EXPECT_NEAR(step, truth, 1e-14 * truth);  // some 50 roundings
  const Problem springs = spring_cube(1);
  EXPECT_EQ(courant_steps_of_particles(springs.system, springs.start, law, VelocitySeries::own_series, 0.5),
            courant_steps_of_particles(springs.system, law, VelocitySeries::own_series, 0.5));
}

TEST(Courant, RefusesWhatCannotBeStable) {
  EXPECT_THAT([] { cropped_to(0.5, undamped_limit(fixed_degree(6)), 1.0, 1.0); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("unstable")));
  const auto of_states = [](int degree, double safety, int refresh) {
    const Problem scene = flight(0.0);
    Courant(std::make_unique<FixedStep>(1.0), safety, scene.system, fixed_degree(degree),
            VelocitySeries::own_series, refresh);
  };
  EXPECT_NO_THROW(of_states(4, 0.5, 1));
  EXPECT_THAT([&] { of_states(6, 0.5, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("unstable")));
  EXPECT_THROW(of_states(4, 1.5, 1), std::invalid_argument);
  EXPECT_THAT([&] { of_states(4, 0.5, 0); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("courant_refresh must be >= 1, got 0")));
  for (double safety : {0.0, -1.0, 1.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THAT([safety] { cropped_to(safety, 2.0, 1.0, 1.0); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("courant must be in (0, 1]")));
}

}  // namespace
}  // namespace jetlag::testing::courant_test
