// SPDX-License-Identifier: MIT
// One tetrahedron 0, e_x, e_y, e_z on a fixed base: its apex, of 1 kg, is a nonlinear oscillator z'' = -W'(z) / 6 whose
// period is an integral over its energy. The periods were found by quadrature in 80 bits.
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <string>

#include "forces/solids/bodies.hpp"
#include "jetlag/integrators/particle_taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/scenes/mesh.hpp"

namespace jetlag::testing::oscillator_test {
using namespace solids;

namespace {

template <class L>
System<double> oscillator(const Lame<double>& lame) {
  Mesh one;
  one.position = Coordinates<double>::Zero(4, 3);
  one.position.bottomRows(3) = Eigen::Matrix3d::Identity();
  one.tetrahedra = {{0, 1, 2, 3}};
  auto system = body_of<L>(one, lame);
  for (int i = 0; i < 3; ++i) system.fix(i);
  return system;
}
State<double> apex_at(double z, double speed) {
  State<double> state{0.0, Coordinates<double>::Zero(4, 3), Coordinates<double>::Zero(4, 3)};
  state.position.bottomRows(3) = Eigen::Matrix3d::Identity();
  state.position(3, 2) = z;
  state.velocity(3, 2) = speed;
  return state;
}
/// In 400 steps of degree 20 a period: they err by less than rounding, which adds up to some 400 2^-53 of a state near 1.
State<double> moved(const System<double>& system, State<double> state, double period, double until) {
  ParticleTaylorOptions<double> options;
  options.degree = 20;
  options.step = period / 400;
  const auto report = ParticleTaylor<double>(system, options).run(state, until);
  EXPECT_EQ(report.outcome, Outcome::success) << report.message;
  return state;
}

template <class L>
void expect_period(const Lame<double>& lame, double z, double speed, double period) {
  SCOPED_TRACE(std::string(L::name) + " from z = " + std::to_string(z) + ", v = " + std::to_string(speed));
  const auto system = oscillator<L>(lame);
  const auto start = apex_at(z, speed), end = moved(system, start, period, period);
  EXPECT_NEAR(end.position(3, 2), z, 1e-12);
  EXPECT_NEAR(end.velocity(3, 2), speed, 1e-12);
  EXPECT_NEAR(end.position.row(3).head(2).norm(), 0, 1e-13);  // it moves along z
  EnergyMeter energy{Model<double>(system)};
  EXPECT_NEAR(energy(end).total(), energy(start).total(), 1e-13);
}

// The constants of the laws are 3 and 2: of stable_neo_hookean l = lambda + 5 mu/6, m = 4 mu/3, of the polynomial one
// l = lambda + mu.
constexpr Lame<double> plain{3, 2}, stable{1.75, 1.5}, polynomial{1, 2};

TEST(Oscillator, OfStvkHasItsPeriodAndTurns) {
  constexpr double period = 8.097503516627714, low = 0.272359872645, high = 1.387739204524;
  expect_period<Stvk>(plain, 1, 0.5, period);
  const auto end = moved(oscillator<Stvk>(plain), apex_at(high, 0), period, period / 2);
  EXPECT_NEAR(end.position(3, 2), low, 2e-11);  // given to 5e-13, steeper above than below
}
TEST(Oscillator, OfStvkGoesOverTheBarrierAndComesBack) {
  expect_period<Stvk>(plain, 1, 0.6, 14.453281188076754);
  const auto half =
      moved(oscillator<Stvk>(plain), apex_at(1, 0.6), 14.453281188076754, 14.453281188076754 / 2);
  EXPECT_LT(half.position(3, 2), -0.9);  // inside out
}
TEST(Oscillator, OfNeoHookeanHasItsPeriod) { expect_period<NeoHookean>(plain, 1, 0.5, 5.767769979363951); }
TEST(Oscillator, OfStableNeoHookeanHasItsPeriod) {
  expect_period<StableNeoHookean>(stable, 1, 0.5, 7.073719478147732);
}
TEST(Oscillator, OfPolynomialNeoHookeanIsHarmonic) {  // m/6 + l/6 = 5/6 N/m, from inside out too
  const double period = boost::math::constants::two_pi<double>() * std::sqrt(1.2);
  for (const double speed : {0.2, 0.5, 3.0})
    expect_period<PolynomialNeoHookean>(polynomial, 1, speed, period);
  expect_period<PolynomialNeoHookean>(polynomial, -0.5, 0, period);
}

TEST(Oscillator, OfNeoHookeanIsNotFiniteInsideOut) {
  const auto report = [&] {
    auto state = apex_at(-0.5, 0.1);
    return ParticleTaylor<double>(oscillator<NeoHookean>(plain), {}).run(state, 1.0);
  }();
  EXPECT_EQ(report.outcome, Outcome::non_finite) << report.message;
}

/// A small vibration of the apex decays as exp(-b omega^2 t / 2), omega^2 = (lambda + 2 mu)/6, for b omega << 1.
TEST(Oscillator, WithViscosityDecays) {
  const double b = 1e-2, omega_2 = 7.0 / 6, decay = b * omega_2 / 2;
  auto system = oscillator<Stvk>(plain);
  Coordinates<double> rest = apex_at(1, 0).position;
  system.add_at_rest<KelvinVoigt>({{0, 1, 2, 3}}, rest, {{b * plain.lambda, b * plain.mu}});
  const double damped = std::sqrt(omega_2 - decay * decay), swing = 1e-4;
  const double periods = 20, until = periods * boost::math::constants::two_pi<double>() / damped;
  const auto end = moved(system, apex_at(1 + swing, -decay * swing), until / periods, until);
  // x = swing exp(-decay t)(cos + ...): of the linear equation exactly; amplitudes change the rate by less than 1e-4.
  EXPECT_NEAR((end.position(3, 2) - 1) / swing, std::exp(-decay * until), 1e-4 * std::exp(-decay * until));
  EXPECT_GT(decay * until, 0.5);
}

}  // namespace
}  // namespace jetlag::testing::oscillator_test
