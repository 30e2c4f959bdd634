// SPDX-License-Identifier: MIT
// Barriers of contact between particles with clocks of their own.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "jetlag/contact/contact_barrier.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/forces/uniform_field.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/lockstep.hpp"

namespace jetlag::testing::contact_clocks_test {
namespace {

constexpr double tolerance = 1e-9;

enum class Clocks { one, blocks, free };

std::unique_ptr<Schedule> schedule(Clocks clocks, const System<double>& system, int degree) {
  if (clocks == Clocks::one)
    return std::make_unique<Lockstep>(taylor(system, degree, std::make_unique<LastTwo>(tolerance)));
  if (clocks == Clocks::blocks) {
    BlockSteps::Options options;
    options.tolerance = tolerance;
    return std::make_unique<BlockSteps>(system, degree, options);
  }
  Asynchronous::Options options;
  options.tolerance = tolerance;
  return std::make_unique<Asynchronous>(system, degree, options);
}

struct Ending {
  State<double> end;
  double energy_error;                   // relative
  std::uint64_t of_first, of_last, all;  // updates
};

/// 32 unit masses in a chain of springs of 100 N/m that meets a wall at 2 m/s. Only its first mass touches it.
Ending chain_against_wall(Clocks clocks) {
  constexpr int masses = 32;
  System<double> system(1, std::vector<double>(masses + 1, 1.0));
  system.fix(masses);
  State<double> state{0.0, Coordinates<double>(masses + 1, 1),
                      Coordinates<double>::Constant(masses + 1, 1, -2.0)};
  for (int i = 0; i < masses; ++i) state.position(i, 0) = 0.5 + i;
  state.position(masses, 0) = 0;
  state.velocity(masses, 0) = 0;
  for (int i = 0; i + 1 < masses; ++i) system.add<Spring>({{i, i + 1}}, {{100.0, 1.0}});
  add(system, ContactBarrier{.surface = Surface({}, {}, {0, masses}),
                             .rest = state.position,
                             .thickness = 0.1,
                             .stiffness = 1e4});
  const auto method = schedule(clocks, system, 12);
  EnergyMeter energy(system);
  const double before = energy(state).total();
  const Report report = method->run(state, 2.0, {});
  EXPECT_EQ(report.outcome, Outcome::success) << report.message;
  Ending run{state, std::abs(energy(state).total() / before - 1), 0, 0, method->work().updates};
  if (const auto* of_particles = dynamic_cast<const ParticleClocks*>(method.get())) {
    run.of_first = of_particles->updates_of(0);
    run.of_last = of_particles->updates_of(masses - 1);
  }
  return run;
}

TEST(ContactOnClocks, CostsThoseThatTouchAndNotTheOthers) {
  // What a position errs by is some tolerances a step of the first mass; the bounds were measured by prototypes: 5e-7, energies
  // 1e-7, the last mass moves freely but for what the chain tells it.
  const Ending one = chain_against_wall(Clocks::one);
  for (const Clocks clocks : {Clocks::blocks, Clocks::free}) {
    const Ending run = chain_against_wall(clocks);
    EXPECT_LE((run.end.position - one.end.position).cwiseAbs().maxCoeff(), 5e-7);
    EXPECT_LE(run.energy_error, 2e-7);
    EXPECT_LE(run.of_last, 3u);
    EXPECT_GE(run.of_first, 100u);
    EXPECT_LE(2 * run.all, one.all);
  }
}

/// Masses 1 and 3 that meet at 1 and -1/2 m/s in the plane, the first one 0.03 m beside the other's way.
TEST(ContactOnClocks, TurnsTwoThatMeetByTheAngleOfTheQuadrature) {
  for (const Clocks clocks : {Clocks::blocks, Clocks::free}) {
    System<double> system(2, {1.0, 3.0});
    State<double> state{0.0, Coordinates<double>{{0, .03}, {1, 0}}, Coordinates<double>{{1, 0}, {-0.5, 0}}};
    add(system,
        ContactBarrier{
            .surface = Surface({}, {}, {0, 1}), .rest = state.position, .thickness = 0.1, .stiffness = 1000});
    const auto method = schedule(clocks, system, 12);
    const Report report = method->run(state, 4.0, {});
    ASSERT_EQ(report.outcome, Outcome::success) << report.message;
    // Some 30 steps of 1e-9 m, over contacts of 0.05 s.
    EXPECT_NEAR(state.velocity(0, 0), -.9181347100470267, 6e-7);
    EXPECT_NEAR(state.velocity(0, 1), .7978485644021795, 6e-7);
  }
}

/// A point that slides over the end of an edge: another region, a kink of the third derivative, on the way.
TEST(ContactOnClocks, FollowsRegions) {
  for (const Clocks clocks : {Clocks::blocks, Clocks::free}) {
    System<double> system(2, {1.0, 1.0, 1.0});
    system.fix(0);
    system.fix(1);
    system.add<UniformField>({{2}}, {{0.0, -9.81, 0.0}});
    State<double> state{0.0, Coordinates<double>{{0, 0}, {1, 0}, {.5, .095}},
                        Coordinates<double>{{0, 0}, {0, 0}, {1, -.3}}};
    add(system, ContactBarrier{.surface = Surface({}, {{0, 1}}, {2}),
                               .rest = state.position,
                               .thickness = 0.1,
                               .stiffness = 1000});
    const auto method = schedule(clocks, system, 12);
    const Report report = method->run(state, 0.8, {});
    ASSERT_EQ(report.outcome, Outcome::success) << report.message;
    // 60 steps of 1e-9 m; errors of a bounce grow with the way from there.
    EXPECT_NEAR(state.position(2, 0), 1.328662787104, 1e-6);
    EXPECT_NEAR(state.position(2, 1), -.239149334704, 1e-6);
  }
}

}  // namespace
}  // namespace jetlag::testing::contact_clocks_test
