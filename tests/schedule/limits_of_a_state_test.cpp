// SPDX-License-Identifier: MIT
// Clocks of particles and elements by the Courant limits of a state, where laws have no stiffness.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "jetlag/control/courant.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/integrators/implicit/explicit_implicit.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/model/lumped_mass.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/avi.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/subcycling.hpp"
#include "support/laws/elastic_box.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::limits_of_a_state_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A bar with one cell in its middle that is 100 times as stiff, hit at one end.
Problem bar() {
  const auto box = jetlag::box({0.7, 0.1, 0.1}, {7, 1, 1});
  std::vector<double> stiffer(box.tetrahedra.size(), 1.0);
  std::fill_n(stiffer.begin() + 3 * 6, 6, 100.0);
  Problem scene{elastic(box, 1e5, 0.3, 1000, stiffer), at_rest(box)};
  for (int i = 0; i < 4; ++i) scene.start.velocity.row(i) << 0.01, 0.02, 0.0;
  return scene;
}

double energy_error(const Problem& scene, const State<double>& end) {
  EnergyMeter energy(scene.system);
  return std::abs(energy(end).total() / energy(scene.start).total() - 1);
}

TEST(LimitsOfAState, AreTheStepsOfElements) {
  const Problem scene = bar();
  const auto omega = frequency_bounds_of_elements(scene.system, scene.start);
  const ElementSteps steps = courant_steps(scene.system, scene.start, 0.2);
  ASSERT_EQ(steps.size(), 1u);
  for (std::size_t e = 0; e < steps[0].size(); ++e) EXPECT_EQ(steps[0][e], 0.2 * 2.0 / omega[0][e]) << e;
  // 100 times stiffer: ten times shorter, but that it gets nearly all of the mass of its particles, of which those at the end
  // of the bar have half.
  EXPECT_GT(steps[0].front() / steps[0][3 * 6], 10 / std::sqrt(2.0) - 0.1);
  EXPECT_LT(steps[0].front() / steps[0][3 * 6], 10.0);
}

TEST(LimitsOfAState, LeaveSpringsTheirOwn) {
  const Problem cube = spring_cube(1);
  EXPECT_EQ(courant_steps(cube.system, cube.start, 0.2), courant_steps(cube.system, 0.2));
  EXPECT_EQ(courant_steps_of_particles(cube.system, cube.start, 0.2),
            courant_steps_of_particles(cube.system, 0.2));
  EXPECT_EQ(beyond_courant(cube.system, cube.start, 0.1), beyond_courant(cube.system, 0.1));
  Problem scene = bar();
  scene.system.add<Spring>({{0, 4}}, {{7.0, 0.1}});
  const double squared = 7.0 / scene.system.mass()[0] + 7.0 / scene.system.mass()[4];
  EXPECT_DOUBLE_EQ(courant_steps(scene.system, scene.start, 0.2)[1][0], 0.2 * 2.0 / std::sqrt(squared));
}

TEST(LimitsOfAState, AreRefusedWhereNothingBoundsALaw) {
  Problem scene = bar();
  EXPECT_THAT([&] { courant_steps(scene.system, 0.2); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("no stiffness is known of stvk")));
  EXPECT_THROW(courant_steps_of_particles(scene.system, 0.2), std::invalid_argument);
  {
    Problem viscous = bar();
    viscous.system.add_at_rest<KelvinVoigt>({{0, 2, 1, 4}}, viscous.start.position, {{1.0, 1.0}});
    EXPECT_THAT([&] { courant_steps(viscous.system, viscous.start, 0.2); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("kelvin_voigt depends on velocities")));
    EXPECT_THROW(courant_steps_of_particles(viscous.system, viscous.start, 0.2), std::invalid_argument);
  }
  scene.system.add<Gravity>({{0, 9}}, {{1.0}});
  EXPECT_THAT([&] { courant_steps(scene.system, scene.start, 0.2); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("no stiffness is known of gravity")));
}

TEST(LimitsOfAState, KeepTheEnergyOfVariationalClocks) {
  // Of order (f omega h)^2 < f^2, f = 0.2 of the limit; it does not grow: 0.5 s are some 9000 steps of the shortest clock.
  const Problem scene = bar();
  Avi avi(scene.system, courant_steps(scene.system, scene.start, 0.2));
  State<double> state = scene.start;
  ASSERT_EQ(avi.run(state, 0.5, {}).outcome, Outcome::success);
  EXPECT_LT(energy_error(scene, state), 0.04);
}

TEST(LimitsOfAState, AreTheStepsOfParticles) {
  const Problem scene = bar();
  const auto omega = frequency_bounds(scene.system, scene.start);
  const ParticleSteps steps = courant_steps_of_particles(scene.system, scene.start, 0.5);
  for (std::size_t i = 0; i < steps.size(); ++i) EXPECT_EQ(steps[i], 0.5 * 2.0 / omega[i]);
  const double between = 2 * omega[0];
  const auto implicit = beyond_courant(scene.system, scene.start, 2.0 / between);
  for (std::size_t i = 0; i < steps.size(); ++i) EXPECT_EQ(implicit[i], omega[i] > between) << i;
  EXPECT_THAT(implicit, ::testing::Contains(true));
  // Without resonance: h times powers of two, of which none exceeds 2 / omega of the whole.
  const double fastest = frequency_bound(scene.system, scene.start), h = std::ranges::min(steps) / 8;
  const ParticleSteps eighths(steps.size(), 8 * h);
  ParticleSteps mixed = eighths;
  mixed[0] = h;
  for (const double step : without_resonance(scene.system, scene.start, mixed)) {
    EXPECT_EQ(std::exp2(std::round(std::log2(step / h))) * h, step);
    EXPECT_LT(step * fastest, 2.0);
  }
}

TEST(LimitsOfAState, BoundTheStepsOfBlocks) {
  // Degree 4, tolerance of no account. The bound of the start, 5 % more: the bar hardly deforms.
  const Problem scene = bar();
  BlockSteps::Options options;
  options.tolerance = 1.0;
  options.courant = 0.8;
  options.max_step = 1.0;
  const auto omega = frequency_bounds(scene.system, scene.start);
  BlockSteps schedule(scene.system, 4, options);
  RunOptions run;
  double longest = 0, shortest = 1;
  run.observer.on_update = [&](const Update& update) {
    longest = std::max(longest, update.step);
    shortest = std::min(shortest, update.step);
    EXPECT_LE(update.step * omega[update.particle], 0.8 * std::sqrt(8.0) / 1.05 * (1 + 1e-8));
  };
  State<double> state = scene.start;
  ASSERT_EQ(schedule.run(state, 0.5, run).outcome, Outcome::success);
  EXPECT_GE(longest / shortest, 4.0);
  EXPECT_LT(energy_error(scene, state), 0.04);
}

/// A bar between two heavy blocks that fly apart: some 2000 steps to where it is longest, 1.9 times as long and its fastest
/// frequency half as high again, and back.
Problem stretched_bar() {
  const auto box = jetlag::box({0.4, 0.1, 0.1}, {4, 1, 1});
  std::vector<double> mass = lumped_masses(box.position, box.tetrahedra, 1000.0);
  for (int end : {0, 16})
    for (int i = end; i < end + 4; ++i) mass[i] *= 40'000;
  System<double> system(3, mass);
  const Lame<double> of = lame(1e5, 0.3);
  system.add_at_rest<Stvk>(box.tetrahedra, box.position,
                           std::vector<std::array<double, 2>>(box.tetrahedra.size(), {of.lambda, of.mu}));
  Problem scene{std::move(system), at_rest(box)};
  for (Eigen::Index i = 0; i < box.position.rows(); ++i)
    scene.start.velocity(i, 0) = 0.13 * (box.position(i, 0) / 0.2 - 1);
  return scene;
}

TEST(LimitsOfAState, FollowWhatStiffens) {
  // The bound of the start is two thirds of that where the bar is longest. Bounds lie above the frequencies, so that the energy
  // would hold here even so: what is looked at are the bound and the steps.
  const Problem scene = stretched_bar();
  BlockSteps::Options options;
  options.tolerance = 100.0;
  options.courant = 0.8;
  options.max_step = 1.0;
  for (const bool blocks : {true, false}) {
    std::unique_ptr<Schedule> schedule;
    if (blocks)
      schedule = std::make_unique<BlockSteps>(scene.system, 4, options);
    else
      schedule = std::make_unique<Asynchronous>(scene.system, 4, Asynchronous::Options{options});
    RunOptions run;
    double first = 0, shortest = 1, longest = 0;
    run.observer.on_update = [&](const Update& update) {
      if (update.particle != 9) return;  // in the middle
      if (first == 0) first = update.step;
      shortest = std::min(shortest, update.step);
    };
    State<double> state = scene.start;
    const double length = 0.4;
    for (int n = 1; n <= 24; ++n) {
      ASSERT_EQ(schedule->run(state, 0.25 * n, run).outcome, Outcome::success) << blocks << " " << n;
      // Of a state not long before: 50 updates of a particle are some 0.07 s. It stays while it is a bound and its square is
      // at most 1.05 / 0.8 times too large.
      const double said = schedule->courant_frequency().value().bound,
                   now = frequency_bound(scene.system, state);
      EXPECT_GT(said / now, 0.95) << n;
      EXPECT_LT(said / now, 1.05 * std::sqrt(1.05 / 0.8)) << n;
      longest = std::max(longest, (state.position(16, 0) - state.position(0, 0)) / length);
    }
    EXPECT_GT(longest, 1.8);
    EXPECT_LE(shortest, first / 1.6);
    EXPECT_LT(energy_error(scene, state), 0.01) << blocks;
    EXPECT_GT(schedule->courant_frequency().value().refreshed, 20u);
  }
}

}  // namespace
}  // namespace jetlag::testing::limits_of_a_state_test
