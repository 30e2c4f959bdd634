// SPDX-License-Identifier: MIT
// A law that is its own kernel and its tape compute the same coefficients.
#include "jetlag/forces/law_kernel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

#include "jetlag/forces/drag.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/motion/expansion.hpp"
#include "problems/laws.hpp"
#include "support/random.hpp"

namespace jetlag::testing::law_kernel_test {

/// All that a law may read, and operations that do not come in others: F depends on place, velocity, mass, time, parameters.
struct Pushed {
  static constexpr const char* name = "pushed";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"charge", "frequency"};
  static constexpr int unrolled_orders = 5;
  static constexpr std::array unrolled_dimensions{2};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& charge, const T& frequency) {
    using std::cos, std::exp, std::pow;
    const Vector<T, D>&x = p.position[0], v = p.velocity[0];
    Vector<T, D> f = T(-charge / (1.0 + x.squaredNorm())) * x;
    f[0] += p.mass[0] * cos(T(frequency * p.time)) - x[0] / (2.0 + pow(x[D - 1], 6)) + pow(frequency, 2);
    f[D - 1] -= exp(T(0.5 * x[0])) * v[0] + 3.0 / exp(x[0]) + pow(T(v.squaredNorm() + 1.0), -2.5);
    return f;
  }
};

/// Two forces, of which the third particle gets minus the sum: springs that harden.
struct Rod {
  static constexpr const char* name = "rod";
  static constexpr int participants = 3;
  static constexpr std::array parameters{"stiffness"};
  static constexpr int unrolled_orders = 5;
  static constexpr std::array unrolled_dimensions{1};

  template <class T, int D>
  static std::array<Vector<T, D>, 2> forces(const Participants<T, D, 3>& p, const T& stiffness) {
    const Vector<T, D> a = p.position[0] - p.position[2], b = p.position[1] - p.position[2];
    const Vector<T, D> bend = T(stiffness * a.dot(b)) * (a + b);
    return {T(-stiffness * a.squaredNorm()) * a - bend, bend - T(stiffness * b.squaredNorm()) * b};
  }
};

/// A component without a series beside another one, whose first coefficient is all there is.
struct Falling {
  static constexpr const char* name = "falling";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"stiffness", "gravity"};
  static constexpr int unrolled_orders = 5;
  static constexpr std::array unrolled_dimensions{2};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& stiffness, const T& gravity) {
    Vector<T, D> f;
    f[0] = -stiffness * p.position[0][0];
    f[1] = p.mass[0] * gravity;
    return f;
  }
};

/// Forces without a series, of which the other particle gets the opposite.
struct Steady {
  static constexpr const char* name = "steady";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"pull"};
  static constexpr int unrolled_orders = 5;
  static constexpr std::array unrolled_dimensions{1};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>&, const T& pull) {
    Vector<T, D> f;
    f[0] = pull;
    return f;
  }
};

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

struct Case {
  std::string name;
  System<double> system;
  int orders;  // that the kernel has
};

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&](const std::string& name, int dimension, std::vector<double> mass,
                       int orders) -> System<double>& {
    all.push_back({name, System<double>(dimension, std::move(mass)), orders});
    return all.back().system;
  };
  add("pendulum", 1, {1.0}, 20).add<problems::SineOfAngle>({{0}}, {{}});
  add("Henon and Heiles", 2, {1.0}, 20).add<problems::HenonHeiles>({{0}}, {{}});
  add("planet", 2, {1.0, 0.25}, 20).add<Gravity>({{0, 1}}, {{1.5}});
  System<double>& held = add("planet of a sun that is held", 3, {1.0, 0.25}, 20);
  held.add<Gravity>({{1, 0}}, {{1.5}});
  held.fix(0);
  add("pushed", 2, {1.75}, 5).add<Pushed>({{0}}, {{0.75, 1.25}});
  add("rod", 1, {1.0, 2.0, 0.5}, 5).add<Rod>({{2, 0, 1}}, {{1.5}});
  add("falling", 2, {1.25}, 5).add<Falling>({{0}}, {{2.0, -9.75}});
  add("steady", 1, {1.0, 3.0}, 5).add<Steady>({{0, 1}}, {{0.75}});
  return all;
}

/// A random state in which no two particles meet; those that are held are at rest.
State<double> start_of(const System<double>& system) {
  Uniform draw(7);
  State<double> state{0.375, Coordinates<double>(system.particles(), system.dimension()),
                      Coordinates<double>(system.particles(), system.dimension())};
  for (int i = 0; i < system.particles(); ++i)
    for (int c = 0; c < system.dimension(); ++c) {
      state.position(i, c) = i + draw(0.1, 0.9);
      state.velocity(i, c) = system.fixed()[i] ? 0.0 : draw(-0.5, 0.5);
    }
  return state;
}

/// Every table that rounds products before they are added runs tapes.
Expansion<double> from_tape(const System<double>& system, int degree) {
  return Expansion<double>(system, degree, scalar_kernels<double>());
}

TEST(LawKernel, IsTheTape) {
  // Coefficient k of a value comes of k products in each of some ten operations, the sizes of whose terms are within 30 times that
  // of the sum in these motions; what is off in one order is in the terms of the next.
  for (const Case& each : cases()) {
    const int degree = each.orders + 1;
    Expansion<double> kernel(each.system, degree), tape = from_tape(each.system, degree);
    for (auto* series : {&kernel, &tape}) {
      series->start(start_of(each.system), 0.5);
      series->grow_to(degree);
    }
    for (int k = 0; k <= degree; ++k) {
      EXPECT_LE((kernel.position(k) - tape.position(k)).cwiseAbs().maxCoeff(),
                300 * (k + 1) * eps * tape.position_norm(k))
          << each.name << ", order " << k;
      if (k == degree) continue;
      EXPECT_LE((kernel.velocity(k) - tape.velocity(k)).cwiseAbs().maxCoeff(),
                300 * (k + 1) * eps * tape.velocity_norm(k))
          << each.name << ", order " << k;
    }
    EXPECT_EQ(kernel.element_coefficients(), tape.element_coefficients()) << each.name;
  }
}

TEST(LawKernel, RunsWhereProductsAreFused) {
  const bool runs = kernels<double>().fuses;
  for (const Case& each : cases()) {
    const RecordedLaw& law = each.system.elements().front().law;
    EXPECT_EQ(law.kernel.orders, detail::runs_law_kernels() ? each.orders : 0) << each.name;
    EXPECT_EQ(UnrolledMotion<double>(Model<double>(each.system), kernels<double>()).exists(), runs)
        << each.name;
    EXPECT_FALSE(UnrolledMotion<double>(Model<double>(each.system), scalar_kernels<double>()).exists())
        << each.name;
  }
}

TEST(LawKernel, IsNotForOtherSystems) {
  const auto has_kernel = [](const System<double>& system) {
    return UnrolledMotion<double>(Model<double>(system), kernels<double>()).exists();
  };
  System<double> of_three(2, {1.0, 1.0, 1.0});
  of_three.add<Gravity>({{0, 1}}, {{1.0}});
  EXPECT_FALSE(has_kernel(of_three)) << "a particle that takes no part";
  of_three.add<Gravity>({{1, 2}}, {{1.0}});
  EXPECT_FALSE(has_kernel(of_three)) << "two elements";
  System<double> with_drag(2, {1.0, 1.0});
  with_drag.add<Gravity>({{0, 1}}, {{1.0}});
  with_drag.add<Drag>({{0}}, {{0.5}});
  EXPECT_FALSE(has_kernel(with_drag)) << "two laws";
  System<double> on_a_line(1, {1.0, 1.0});
  on_a_line.add<Gravity>({{0, 1}}, {{1.0}});
  EXPECT_FALSE(has_kernel(on_a_line)) << "a dimension for which none was asked";
}

void expect_same_bits(const Expansion<double>& a, const Expansion<double>& b, const std::string& what) {
  ASSERT_EQ(a.order(), b.order()) << what;
  for (int k = 0; k <= a.order(); ++k) EXPECT_EQ(a.position(k), b.position(k)) << what << ", order " << k;
  for (int k = 0; k < a.order(); ++k) EXPECT_EQ(a.velocity(k), b.velocity(k)) << what << ", order " << k;
}

TEST(LawKernel, GrowsOrderByOrderAsAtOnce) {
  for (const Case& each : cases()) {
    Expansion<double> step_by_step(each.system, each.orders + 1), at_once(each.system, each.orders + 1);
    step_by_step.start(start_of(each.system));
    at_once.start(start_of(each.system));
    for (int order = 1; order <= each.orders + 1; ++order) step_by_step.grow_to(order);
    at_once.grow_to(each.orders + 1);
    expect_same_bits(step_by_step, at_once, each.name);
  }
}

TEST(LawKernel, GivesWayToTheTapeBeyondItsOrders) {
  for (const Case& each : cases()) {
    const int degree = each.orders + 6;
    Expansion<double> series(each.system, 8), tape(each.system, degree);
    series.start(start_of(each.system));
    series.grow_to(each.orders + 1);
    series.grow_to(degree);
    tape.start(start_of(each.system));
    tape.grow_to(degree);
    expect_same_bits(series, tape, each.name);
  }
}

/// Gravity without a kernel.
struct RecordedGravity {
  static constexpr const char* name = "recorded gravity";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"constant"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& constant) {
    return Gravity::force(p, constant);
  }
};

TEST(LawKernel, WhatComesAfterDoesNotDependOnWhatWentBefore) {
  // A series that has gone beyond the kernel's orders, and one from a state with rests: the next one has the bits of the first.
  for (const Case& each : cases()) {
    Expansion<double> series(each.system, 8), fresh(each.system, 8);
    State<double> state = start_of(each.system);
    fresh.start(state);
    fresh.grow_to(each.orders);
    series.start(state);
    series.grow_to(each.orders + 4);
    state.position_rest = 0x1p-54 * state.position;
    state.velocity_rest = 0.0 * state.velocity;
    series.start(state);
    series.grow_to(8);
    series.start(start_of(each.system));
    series.grow_to(each.orders);
    expect_same_bits(series, fresh, each.name);
  }
}

/// A law whose histories are more or less by a parameter.
struct Powered {
  static constexpr const char* name = "powered";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"exponent"};
  static constexpr int unrolled_orders = 4;
  static constexpr std::array unrolled_dimensions{1};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& exponent) {
    using std::pow;
    return T(pow(T(p.position[0][0]), exponent)) * p.position[0];
  }
  /// Its own word on where it has a kink keeps the root from being watched.
  template <int D>
  static Vector<double, D> kink(const Positions<D, 1>& x, double) {
    return x[0];
  }
};

TEST(LawKernel, CountsHistoriesForTheParametersAtHand) {
  for (const double exponent : {1.0, 0.75, 7.0}) {
    System<double> system(1, {1.0});
    system.add<Powered>({{0}}, {{exponent}});
    Expansion<double> kernel(system, 5), tape = from_tape(system, 5);
    for (auto* series : {&kernel, &tape}) {
      series->start(start_of(system));
      series->grow_to(5);
    }
    for (int k = 0; k <= 5; ++k)
      EXPECT_LE((kernel.position(k) - tape.position(k)).cwiseAbs().maxCoeff(),
                300 * (k + 1) * eps * tape.position_norm(k))
          << exponent << ", order " << k;
  }
}

TEST(LawKernel, LeavesWhatPositionsHaveBeyondANumberToTheTape) {
  System<double> planet(2, {1.0, 0.25}), recorded(2, {1.0, 0.25});
  planet.add<Gravity>({{0, 1}}, {{1.5}});
  recorded.add<RecordedGravity>({{0, 1}}, {{1.5}});
  const State<double> whole = start_of(planet);
  State<double> with_rest = whole;
  with_rest.position_rest = 0x1p-54 * whole.position;
  with_rest.velocity_rest = 0.0 * whole.velocity;
  Expansion<double> series(planet, 12), tape(recorded, 12);
  for (const State<double>* state :
       std::initializer_list<const State<double>*>{&with_rest, &whole, &with_rest}) {
    for (auto* each : {&series, &tape}) {
      each->start(*state);
      each->grow_to(12);
    }
    if (state == &with_rest) expect_same_bits(series, tape, "with rests");
  }
}

}  // namespace
}  // namespace jetlag::testing::law_kernel_test
