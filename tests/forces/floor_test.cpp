// SPDX-License-Identifier: MIT
// A mass against a floor: how long it touches, how deep it gets, what it keeps.
#include "jetlag/forces/floor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"

namespace jetlag::testing {
namespace {

constexpr double mass = 2, stiffness = 50, height = 1, speed = 3;
constexpr double omega = 5;  // sqrt(stiffness / mass)

/// Beyond a surface that the state has just reached.
void over(State<double>& state) { state.position += 1e-15 * state.velocity; }

/// One particle above an inclined floor, n = (0.6, 0.8), flying into it with this speed and along it with 1.
template <class Law>
struct Throw {
  Throw() : system(2, {mass}), state{0.0, Coordinates<double>(1, 2), Coordinates<double>(1, 2)} {
    system.add<Law>({{0}}, {{stiffness, height, 0.6, 0.8, 0.0}});
    state.position << 1.1, 1.3;  // 0.7 above
    state.velocity << -0.6 * speed + 0.8, -0.8 * speed - 0.6;
  }
  double along_normal(const Coordinates<double>& x) const { return 0.6 * x(0, 0) + 0.8 * x(0, 1); }
  double along_surface(const Coordinates<double>& x) const { return 0.8 * x(0, 0) - 0.6 * x(0, 1); }

  /// Degree 20 in steps that end at the surface, where `surface` is asked for.
  std::vector<EventHit> run(double until, double step, bool surface) {
    std::vector<EventHit> hits;
    RunOptions options;
    if (surface)
      options.events = {{.name = "surface",
                         .g = [](const auto&, const auto& x,
                                 const auto&) { return 0.6 * x(0, 0) + 0.8 * x(0, 1) - height; },
                         .change = over}};
    options.hits = &hits;
    Lockstep lockstep(taylor(system, 20, std::make_unique<FixedStep>(step)));
    EXPECT_EQ(lockstep.run(state, until, options).outcome, Outcome::success);
    return hits;
  }

  System<double> system;
  State<double> state;
};

TEST(Floor, TakesPiRootOfMassOverStiffnessToThrowAMassBack) {
  // Degree 20 at omega h = 0.5 is exact: 0.5^21 / 21! = 1e-26. What remains are roundings of numbers up to 10, and of the
  // surface's time by speed and place: some 10 of 2e-15.
  Throw<Floor> thrown;
  EnergyMeter energy(thrown.system);
  const double before = energy(thrown.state).total();
  const auto hits = thrown.run(2.0, 0.1, true);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_NEAR(hits[0].time, 0.7 / speed, 2e-14);
  EXPECT_NEAR(hits[1].time - hits[0].time, std::numbers::pi / omega, 2e-14);
  EXPECT_NEAR(thrown.along_normal(thrown.state.velocity), speed, 2e-14);
  EXPECT_NEAR(thrown.along_surface(thrown.state.velocity), 1.0, 2e-14);
  EXPECT_NEAR(energy(thrown.state).total(), before, 1e-13);
}

TEST(Floor, IsEnteredAsDeepAsTheEnergyGoes) {
  // Half a contact after the surface: speed / omega, and for the quadratic law m v^2/2 = k s^3/3.
  Throw<Floor> linear;
  linear.run(0.7 / speed + 0.5 * std::numbers::pi / omega, 0.05, true);
  EXPECT_NEAR(linear.along_normal(linear.state.position), height - speed / omega, 2e-14);

  Throw<QuadraticFloor> quadratic;
  double lowest = height;
  const double deepest = std::cbrt(1.5 * mass * speed * speed / stiffness);
  RunOptions options;
  options.events = {
      {.name = "surface",
       .g = [](const auto&, const auto& x, const auto&) { return 0.6 * x(0, 0) + 0.8 * x(0, 1) - height; },
       .change = over},
      {.name = "turn",
       .g = [](const auto&, const auto&, const auto& v) { return 0.6 * v(0, 0) + 0.8 * v(0, 1); },
       .callback = [&](const EventHit& hit) { lowest = quadratic.along_normal(hit.state.position); }}};
  Lockstep lockstep(taylor(quadratic.system, 20, std::make_unique<FixedStep>(0.02)));
  ASSERT_EQ(lockstep.run(quadratic.state, 1.0, options).outcome, Outcome::success);
  EXPECT_NEAR(lowest, height - deepest, 2e-14);
}

TEST(Floor, CostsEnergyWhereStepsCrossTheSurface) {
  // As its header says: up to (omega h)^2 of the energy along n at each of two crossings, and no more.
  for (const double step : {0.02, 0.01, 0.005}) {
    double worst = 0;
    for (int shift = 0; shift < 20; ++shift) {
      Throw<Floor> thrown;
      EnergyMeter energy(thrown.system);
      thrown.state.position.row(0) += (shift / 20.0 * step * speed) * Eigen::RowVector2d(0.6, 0.8);
      const double before = energy(thrown.state).total();
      thrown.run(2.0, step, false);
      worst = std::max(worst, std::abs(energy(thrown.state).total() - before));
    }
    const double along_normal = 0.5 * mass * speed * speed, bound = along_normal * std::pow(omega * step, 2);
    EXPECT_LE(worst, 2 * bound) << step;
    EXPECT_GE(worst, 0.5 * bound) << step;  // one of 20 shifts comes near
  }
}

TEST(Floor, HasASeriesAtItsSurface) {
  Throw<Floor> thrown;
  thrown.state.position << 0.6, 0.8;
  ASSERT_EQ(thrown.along_normal(thrown.state.position), height);
  Expansion<double> series(thrown.system);
  series.start(thrown.state);
  series.grow_to(8);
  for (int k = 2; k <= 8; ++k) EXPECT_TRUE(series.position(k).isZero(0.0)) << k;
}

}  // namespace
}  // namespace jetlag::testing
