// SPDX-License-Identifier: MIT
// Features that all move: their series, and whole contacts, against another barrier (ByGram) in 50 digits.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "forces/contact/stencils.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/digits50.hpp"
#include "support/engine_of_numbers.hpp"

namespace jetlag::testing::moving_features_test {
namespace {

using namespace contact;

/// Free vertices of 1, 2, 3, .. kg whose features come at each other at 3 m/s, each vertex with another velocity beside.
template <class L, int D>
struct Thrown {
  static constexpr int P = L::participants;
  std::vector<double> parameters;
  State<double> state{0.0, Coordinates<double>(P, D), Coordinates<double>(P, D)};

  Thrown(double power, double y, double gap, Uniform& draw) {
    const auto stencil = stencil_at<L, D>(gap + 0.1 * y, draw);
    parameters = parameters_for<L, D>(stencil, gap, power);
    for (int i = 0; i < P; ++i) {
      const bool is_first = i < (is_of_edges<L> ? 2 : 1);
      state.position.row(i) = stencil.position[i];
      for (int c = 0; c < D; ++c)
        state.velocity(i, c) = (is_first ? -3.0 : 0.0) * stencil.normal[c] + draw(-0.2, 0.2);
    }
  }
  template <class T, class Law>
  System<T> system() const {
    std::vector<T> mass, c(parameters.begin(), parameters.end());
    std::vector<int> all(P);
    std::iota(all.begin(), all.end(), 0);
    for (int i = 0; i < P; ++i) mass.emplace_back(i + 1);
    System<T> system(D, mass);
    system.add(record_law<Law>(D), all, c);
    return system;
  }
  State<Digits50> exact() const {
    return {Digits50(0), state.position.template cast<Digits50>(), state.velocity.template cast<Digits50>()};
  }
};
template <class L, int D>
std::string named(double power) {
  return std::string(L::name) + " in " + std::to_string(D) + ", power " + std::to_string(power);
}

/// Sums of up to some 40 products for each of 12 orders; u carries 2^-52 |m|^2/u, some 1e-13 of a force that goes with u^-8.
template <class L, int D>
void expect_series(double power) {
  constexpr int degree = 12;
  Uniform draw(41 + D);
  const Thrown<L, D> thrown(power, 0.6, power == 2 ? 0.02 : 0.0, draw);
  Expansion<double> series(thrown.template system<double, L>(), degree);
  Expansion<Digits50> expected(thrown.template system<Digits50, ByGram<L>>(), degree);
  series.start(thrown.state);
  expected.start(thrown.exact());
  series.grow_to(degree);
  expected.grow_to(degree);
  for (int k = 2; k <= degree; ++k) {
    const Coordinates<double> right = expected.position(k).template cast<double>();
    EXPECT_LE((series.position(k) - right).cwiseAbs().maxCoeff(), 1e-11 * right.cwiseAbs().maxCoeff())
        << named<L, D>(power) << ", order " << k;
  }
}
TEST(MovingFeatures, HaveTheSeriesOfTheirEnergy) {
  for (const double power : {1.0, 2.0, 3.0, 7.0})
    for_each_barrier([power]<class L, int D>() { expect_series<L, D>(power); });
  for_each_log_barrier([]<class L, int D>() { expect_series<L, D>(7); });
}

/// From y = .98 on until the features leave each other again, and not beyond the thickness: some 10 steps. Rounding as in the
/// series above moves the end by 1e-15 times what a contact amplifies, some tens.
template <class L, int D>
void expect_contact(double power, double gap) {
  const std::string name = named<L, D>(power);
  Uniform draw(43 + D);
  const Thrown<L, D> thrown(power, 0.98, gap, draw);
  const System<double> system = thrown.template system<double, L>();
  constexpr double until = 0.016;
  State<double> state = thrown.state;
  EnergyMeter energy{Model<double>(system)};
  const double before = energy(state).total();
  const auto p = momentum(system, state), l = angular_momentum(system, state);
  const Report report = Lockstep(taylor(system, 20, std::make_unique<JorbaZou>(until))).run(state, until, {});
  ASSERT_EQ(report.outcome, Outcome::success) << report.message;

  State<Digits50> exact = thrown.exact();
  ParticleTaylorOptions<Digits50> options;
  options.degree = 30;  // leaves out exp(-60) of the largest term
  ParticleTaylor<Digits50> method(thrown.template system<Digits50, ByGram<L>>(), options);
  const Report of_exact = method.run(exact, Digits50(until));
  ASSERT_EQ(of_exact.outcome, Outcome::success) << of_exact.message;

  EXPECT_LE((state.position - exact.position.template cast<double>()).cwiseAbs().maxCoeff(), 1e-12) << name;
  EXPECT_NEAR(energy(state).total(), before, 1e-13 * before) << name;
  const auto size = system.mass().size() * 3.0 * 3.0;  // kg m/s: of 3 vertices and more at up to 3 m/s
  EXPECT_LE((momentum(system, state) - p).norm(), 1e-15 * size) << name;
  EXPECT_LE((angular_momentum(system, state) - l).norm(), 1e-14 * size) << name;  // on a line there is none
  // A contact has been: velocities have changed by more than a tenth of what they were.
  EXPECT_GT((state.velocity - thrown.state.velocity).cwiseAbs().maxCoeff(), 0.3) << name;
}
TEST(MovingFeatures, AreThrownAtEachOtherAsIn50Digits) {
  for_each_barrier([]<class L, int D>() { expect_contact<L, D>(7, 0.0); });
  for_each_barrier([]<class L, int D>() { expect_contact<L, D>(3, 0.02); });
}

}  // namespace
}  // namespace jetlag::testing::moving_features_test
