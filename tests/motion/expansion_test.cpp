// SPDX-License-Identifier: MIT
// The series of the motion of a system: against 50 digits, what it conserves, and how it grows.
#include "jetlag/motion/expansion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/motion/first_order.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"
#include "support/engine_of_numbers.hpp"
#include "support/random.hpp"

namespace jetlag::testing::expansion_test {
namespace {

/// Particles on a shaken grid of 3 x 3 x 3, all neighbours within 1.6 joined by springs near their rest
/// length.
struct Network {
  std::vector<double> mass;
  State<> state;
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 2>> springs;  // stiffness, rest length
  static constexpr double drag = 0.25;
  static constexpr std::array<double, 3> field{0.5, -9.75, 1.25};

  explicit Network(std::uint64_t seed) : state{0.0, Coordinates<>(27, 3), Coordinates<>(27, 3)} {
    Uniform draw(seed);
    for (int i = 0; i < 27; ++i) {
      mass.push_back(draw(0.5, 2));
      const double grid[] = {i % 3 + 0.0, i / 3 % 3 + 0.0, i / 9 + 0.0};
      for (int c = 0; c < 3; ++c) {
        state.position(i, c) = grid[c] + draw(-0.2, 0.2);
        state.velocity(i, c) = draw(-1, 1);
      }
    }
    for (int i = 0; i < 27; ++i)
      for (int j = i + 1; j < 27; ++j) {
        const double distance = (state.position.row(j) - state.position.row(i)).norm();
        if (distance > 1.6) continue;
        pairs.push_back({i, j});
        springs.push_back({draw(1, 50), distance * draw(0.8, 1.2)});
      }
  }

  int particles() const { return static_cast<int>(mass.size()); }

  System<> only_springs() const {
    System<> system(3, mass);
    system.add<Spring>(pairs, springs);
    return system;
  }

  System<> with_drag_and_field() const {
    System<> system = only_springs();
    std::vector<std::array<int, 1>> all;
    for (int i = 0; i < particles(); ++i) all.push_back({i});
    system.add<Drag>(all, {{drag}});
    system.add<UniformField>(all, {field});
    return system;
  }
};

Expansion<> grown(const System<>& system, const State<>& state, int order,
                  const KernelTable<double>& table = kernels<double>()) {
  Expansion<> series(system, order, table);
  series.start(state);
  series.grow_to(order);
  return series;
}

// ---- truth ------------------------------------------------------------------------------------------------

/// The series of a network by recurrences that share nothing with the library's rules: the inverse distance
/// is u = s^{-1/2} in one recurrence, no square root, no quotient.         Source: s u' = -1/2 s' u.
///     d = x_j - x_i,   s_n = sum_k d_k . d_{n-k},   u_0 = s_0^{-1/2},
///     u_n = (1 / (n s_0)) sum_{j=1..n} (-j/2 - (n - j)) s_j u_{n-j},   F_n = k (d_n - L sum_k d_k u_{n-k}),
///     v_{n+1} = ((F_n - c v_n) / m + g [n = 0]) / (n + 1),   x_{n+1} = v_n / (n + 1).
/// Returns coefficient n of every position, n = 0 .. order, in 50 digits.
std::vector<Coordinates<Digits50>> network_by_hand(const Network& network, int order) {
  using Series = std::vector<Coordinates<Digits50>>;
  const int particles = network.particles();
  const Coordinates<Digits50> zero = Coordinates<Digits50>::Constant(particles, 3, Digits50(0));
  Series x(order + 1, zero), v(order + 1, zero);
  for (int i = 0; i < particles; ++i)
    for (int c = 0; c < 3; ++c) {
      x[0](i, c) = network.state.position(i, c);
      v[0](i, c) = network.state.velocity(i, c);
    }
  const std::size_t springs = network.pairs.size();
  std::vector<std::vector<Digits50>> s(springs), u(springs);
  std::vector<std::vector<std::array<Digits50, 3>>> d(springs);
  for (int n = 0; n < order; ++n) {
    Coordinates<Digits50> force = zero;
    for (std::size_t e = 0; e < springs; ++e) {
      const auto [i, j] = network.pairs[e];
      const auto [stiffness, rest_length] = network.springs[e];
      d[e].push_back({x[n](j, 0) - x[n](i, 0), x[n](j, 1) - x[n](i, 1), x[n](j, 2) - x[n](i, 2)});
      Digits50 sum = 0;
      for (int k = 0; k <= n; ++k)
        for (int c = 0; c < 3; ++c) sum += d[e][k][c] * d[e][n - k][c];
      s[e].push_back(sum);
      if (n == 0) {
        u[e].push_back(1 / sqrt(sum));
      } else {
        sum = 0;
        for (int k = 1; k <= n; ++k) sum += (Digits50(-k) / 2 - (n - k)) * s[e][k] * u[e][n - k];
        u[e].push_back(sum / (n * s[e][0]));
      }
      for (int c = 0; c < 3; ++c) {
        sum = 0;
        for (int k = 0; k <= n; ++k) sum += d[e][k][c] * u[e][n - k];
        const Digits50 f = stiffness * (d[e][n][c] - rest_length * sum);
        force(i, c) += f;
        force(j, c) -= f;
      }
    }
    for (int i = 0; i < particles; ++i)
      for (int c = 0; c < 3; ++c) {
        const Digits50 g = n == 0 ? network.field[c] : 0.0;
        v[n + 1](i, c) = ((force(i, c) - network.drag * v[n](i, c)) / network.mass[i] + g) / (n + 1);
        x[n + 1](i, c) = v[n](i, c) / (n + 1);
      }
  }
  return x;
}

TEST(Expansion, OfASpringNetworkHasThirteenDigitsOnEveryInstructionSet) {
  // Errors are measured against the largest component of their order: a force is a sum over springs and
  // orders whose terms cancel, so a small component inherits the rounding of the large ones. 1e-13 is 450
  // eps; at order 16 a coefficient is a sum of some 26 springs times 16 terms that themselves come from 15
  // such sums.
  constexpr int order = 16;
  const Network network(1);
  ASSERT_GT(network.pairs.size(), 3 * 32u);  // several blocks of lanes
  const auto truth = network_by_hand(network, order);
  for (const auto* table : available_kernels()) {
    const auto series = grown(network.with_drag_and_field(), network.state, order, *table);
    for (int k = 0; k <= order; ++k) {
      Digits50 error = 0, largest = 0;
      for (int i = 0; i < network.particles(); ++i)
        for (int c = 0; c < 3; ++c) {
          error = std::max<Digits50>(error, abs(series.position(k)(i, c) - truth[k](i, c)));
          largest = std::max<Digits50>(largest, abs(truth[k](i, c)));
        }
      EXPECT_LE(error, 1e-13 * largest) << table->instruction_set << ", order " << k;
    }
  }
}

// ---- what a motion conserves ------------------------------------------------------------------------------

/// Springs and gravity among eight bodies: nothing from outside.
struct Isolated {
  System<> system;
  State<> state;
  std::vector<std::array<int, 2>> pairs;
  Isolated() : system(3, std::vector<double>(8, 1.0)), state{0.0, Coordinates<>(8, 3), Coordinates<>(8, 3)} {
    Uniform draw(2);
    std::vector<double> mass;
    for (int i = 0; i < 8; ++i) mass.push_back(draw(0.5, 2));
    system = System<>(3, mass);
    for (int i = 0; i < 8; ++i) {
      for (int j = i + 1; j < 8; ++j) pairs.push_back({i, j});
      for (int c = 0; c < 3; ++c) {
        state.position(i, c) = (i >> c & 1) * 2.0 + draw(-0.3, 0.3);
        state.velocity(i, c) = draw(-1, 1);
      }
    }
    system.add<Spring>(pairs, {{2.0, 1.5}});
    system.add<Gravity>(pairs, {{3.0}});
  }
};

TEST(Expansion, HasNoMomentumBeyondTheFirstOrder) {
  // sum_i m_i x_{i,k} = 0 for k >= 2: every force has its opposite. What is left is rounding: 28 pairs twice
  // over add to a force, each addition and each product with 1/m and m rounds once: 100 eps of sum_i |m_i
  // x_{i,k}|.
  const Isolated world;
  const auto series = grown(world.system, world.state, 16);
  for (int k = 2; k <= 16; ++k)
    for (int c = 0; c < 3; ++c) {
      double sum = 0, size = 0;
      for (int i = 0; i < 8; ++i) {
        sum += world.system.mass()[i] * series.position(k)(i, c);
        size += std::abs(world.system.mass()[i] * series.position(k)(i, c));
      }
      EXPECT_LE(std::abs(sum), 100 * 0x1p-52 * size) << "order " << k;
    }
}

TEST(Expansion, HasNoAngularMomentumBeyondTheZerothOrder) {
  // coefficient k of sum_i m_i x_i ^ v_i is zero for k >= 1; the bound as above, times k + 1 for its sum
  const Isolated world;
  const auto series = grown(world.system, world.state, 16);
  for (int k = 1; k < 16; ++k)
    for (int c = 0; c < 3; ++c) {
      double sum = 0, size = 0;
      for (int i = 0; i < 8; ++i)
        for (int j = 0; j <= k; ++j) {
          const int a = (c + 1) % 3, b = (c + 2) % 3;
          const double m = world.system.mass()[i];
          const double plus = m * series.position(j)(i, a) * series.velocity(k - j)(i, b);
          const double minus = m * series.position(j)(i, b) * series.velocity(k - j)(i, a);
          sum += plus - minus;
          size += std::abs(plus) + std::abs(minus);
        }
      EXPECT_LE(std::abs(sum), 100 * (k + 1) * 0x1p-52 * size) << "order " << k;
    }
}

TEST(Expansion, HasNoEnergyBeyondTheZerothOrder) {  // the energy as a jet is a constant
  constexpr int degree = 5;  // the bounds that numbers carry grow about tenfold with each order
  using Number = RunningError<double>;
  using J = Jet<Number, degree>;
  const Isolated world;
  System<Number> system(3, {world.system.mass().begin(), world.system.mass().end()});
  system.add<Spring>(world.pairs, {{2.0, 1.5}});
  system.add<Gravity>(world.pairs, {{3.0}});
  Expansion<Number> series(system, degree + 1);
  series.start({0.0, world.state.position.cast<Number>(), world.state.velocity.cast<Number>()});
  series.grow_to(degree + 1);
  std::vector<Vector<J, 3>> x(8), v(8);
  J energy;
  for (int i = 0; i < 8; ++i) {
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k <= degree; ++k) {
        x[i][c][k] = series.position(k)(i, c);
        v[i][c][k] = series.velocity(k)(i, c);
      }
    energy += J(0.5 * world.system.mass()[i]) * v[i].squaredNorm();
  }
  for (const auto& [i, j] : world.pairs) {
    const Participants<J, 3, 2> p{{x[i], x[j]}, {v[i], v[j]}, {system.mass()[i], system.mass()[j]}, {}};
    energy += Spring::energy(p, J(2.0), J(1.5)) + Gravity::energy(p, J(3.0));
  }
  EXPECT_THAT(energy, IsCloseTo(J(energy[0])));
}

TEST(Expansion, OfTheReversedMotionAlternatesInSign) {  // forces of positions only: x(-t), bit for bit
  const Network network(3);
  State<> reversed = network.state;
  reversed.velocity = -reversed.velocity;
  const auto forth = grown(network.only_springs(), network.state, 12);
  const auto back = grown(network.only_springs(), reversed, 12);
  for (int k = 0; k <= 12; ++k)
    EXPECT_TRUE(back.position(k) ==
                (k % 2 ? Coordinates<>(-forth.position(k)) : Coordinates<>(forth.position(k))))
        << "order " << k;
}

TEST(Expansion, LeavesAFixedParticleWhereItIs) {
  const Network network(4);
  System<> system = network.with_drag_and_field();
  State<> state = network.state;
  for (const int i : {0, 13, 26}) {
    system.fix(i);
    state.velocity.row(i).setZero();
  }
  const auto series = grown(system, state, 10);
  for (const int i : {0, 13, 26}) {
    EXPECT_EQ(series.position(0).row(i), state.position.row(i));
    for (int k = 1; k <= 10; ++k) EXPECT_TRUE(series.position(k).row(i).isZero(0)) << "order " << k;
    for (int k = 0; k <= 9; ++k) EXPECT_TRUE(series.velocity(k).row(i).isZero(0)) << "order " << k;
  }
  EXPECT_FALSE(series.position(2).row(1).isZero(0));  // the others move
}

TEST(Expansion, HasTheVelocityAsDerivativeOfThePosition) {  // x_{k+1} = v_k / (k + 1), two roundings apart
  const Network network(5);
  const auto series = grown(network.with_drag_and_field(), network.state, 12);
  for (int k = 0; k < 12; ++k)
    for (int i = 0; i < network.particles(); ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_THAT((k + 1) * series.position(k + 1)(i, c), IsCloseTo(series.velocity(k)(i, c), ulps(3)));
}

// ---- how it grows -----------------------------------------------------------------------------------------

void expect_same_bits(const Expansion<>& a, const Expansion<>& b) {
  ASSERT_EQ(a.order(), b.order());
  for (int k = 0; k <= a.order(); ++k) EXPECT_TRUE(a.position(k) == b.position(k)) << "position, order " << k;
  for (int k = 0; k < a.order(); ++k) EXPECT_TRUE(a.velocity(k) == b.velocity(k)) << "velocity, order " << k;
}

TEST(Expansion, ResumedIsTheFreshOne) {  // bit for bit, with and without room made beforehand
  const Network network(6);
  for (const auto* table : available_kernels()) {
    const auto at_once = grown(network.with_drag_and_field(), network.state, 20, *table);
    Expansion<> step_by_step(network.with_drag_and_field(), 2, *table);
    step_by_step.start(network.state);
    while (step_by_step.order() < 20) step_by_step.grow();
    expect_same_bits(step_by_step, at_once);
    Expansion<> resumed(network.with_drag_and_field(), 9, *table);
    resumed.start(network.state);
    resumed.grow_to(7);
    resumed.grow_to(7);
    resumed.grow_to(11);
    resumed.grow_to(20);
    expect_same_bits(resumed, at_once);
  }
}

TEST(Expansion, StartedAnewForgetsWhatItKnew) {
  const Network network(7), other(8);
  System<> system = network.with_drag_and_field();
  Expansion<> used(system);
  used.start(other.state);
  used.grow_to(15);
  used.start(network.state);
  EXPECT_EQ(used.order(), 1);
  used.grow_to(12);
  expect_same_bits(used, grown(system, network.state, 12));
}

TEST(Expansion, KeepsNoReferenceToTheSystem) {
  const Network network(9);
  auto system = std::make_unique<System<>>(network.only_springs());
  Expansion<> series(*system);
  system.reset();
  series.start(network.state);
  series.grow_to(8);
  expect_same_bits(series, grown(network.only_springs(), network.state, 8));
}

TEST(Expansion, PaysNothingForForcesThatAreNotListed) {
  const Network network(10);
  System<> with_empty_lists = network.only_springs();
  with_empty_lists.add<Drag>({}, {});
  with_empty_lists.add<Gravity>({}, {{1.0}});
  const auto a = grown(network.only_springs(), network.state, 12);
  const auto b = grown(with_empty_lists, network.state, 12);
  EXPECT_EQ(a.bytes(), b.bytes());
  EXPECT_EQ(a.element_coefficients(), b.element_coefficients());
  expect_same_bits(a, b);
}

TEST(Expansion, CountsElementsTimesOrders) {  // F_0 .. F_{N-2} for order N; a uniform field has F_0 only
  const Network network(11);
  const std::size_t springs = network.pairs.size(), particles = network.mass.size();
  EXPECT_EQ(grown(network.only_springs(), network.state, 12).element_coefficients(), 11 * springs);
  EXPECT_EQ(grown(network.with_drag_and_field(), network.state, 12).element_coefficients(),
            11 * (springs + particles) + particles);
}

TEST(Expansion, HoldsTheBytesOfFiveHistoriesForASpring) {
  // one lane: 5 histories of the orders 0 .. degree - 2, the statics, two orders of the scratch, the operands of each
  // instruction; 2 particles: rows of four for x, v, the reciprocal masses and what they push in a unit of time, and two indices of rows
  System<> one(3, {1.0, 1.0});
  one.add<Spring>({{0, 1}}, {{1.0, 1.0}});
  constexpr int degree = 8;
  const Program program(record_law<Spring>(3).force);
  EXPECT_EQ(program.histories, 5);
  const std::size_t numbers =
      5 * (degree - 1) + program.statics + 2 * program.scratches + 2 * 4 * (2 * (degree + 1) + 2);
  std::size_t operands = 0;
  for (const auto& instruction : program.instructions) operands += instruction.operands.size();
  EXPECT_EQ(Expansion<>(one, degree, scalar_kernels<double>()).bytes(),
            numbers * sizeof(double) + operands * sizeof(Operand<double>) + 2 * 2 * sizeof(int));
}

}  // namespace
}  // namespace jetlag::testing::expansion_test
