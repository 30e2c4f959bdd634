// SPDX-License-Identifier: MIT
// Laws of the force laws: every member of the register has these tests, in 1, 2 and 3 dimensions.
#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/tape/program.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"
#include "support/random.hpp"

namespace jetlag::testing {
namespace {

template <class List>
struct AsTestTypes;
template <ForceLaw... L>
struct AsTestTypes<LawList<L...>> {
  using type = ::testing::Types<L...>;
};
struct NameOfLaw {
  template <class L>
  static std::string GetName(int) {
    return L::name;
  }
};

template <class L>
class ForceLaws : public ::testing::Test {
 protected:
  static constexpr int n = static_cast<int>(L::parameters.size());
  static constexpr int participants = L::participants;
  static constexpr bool has_energy = requires(Participants<double, 3, participants> p) {
    []<std::size_t... I>(const auto& q,
                         std::index_sequence<I...>) -> decltype(L::energy(q, ((void)I, 0.0)...)) {
      return {};
    }(p, std::make_index_sequence<n>{});
  };
  template <class T>
  using Parameters = std::array<T, n>;

  /// Particles at random, the second one in the positive octant from the first: they do not meet.
  template <int D>
  static Participants<double, D, participants> random_participants(Uniform& draw) {
    Participants<double, D, participants> p;
    for (int i = 0; i < participants; ++i) {
      for (int c = 0; c < D; ++c) {
        p.position[i][c] = draw(0, 1) + 1.5 * i;
        p.velocity[i][c] = draw(-1, 1);
      }
      p.mass[i] = draw(0.5, 2);
    }
    p.time = draw(0, 1);
    return p;
  }

  static Parameters<double> random_parameters(Uniform& draw) {
    Parameters<double> c;
    for (double& x : c) x = draw(0.5, 2);
    return c;
  }

  template <class T, int D>
  static Participants<T, D, participants> converted(const Participants<double, D, participants>& p) {
    Participants<T, D, participants> q;
    for (int i = 0; i < participants; ++i) {
      for (int c = 0; c < D; ++c) {
        q.position[i][c] = T(p.position[i][c]);
        q.velocity[i][c] = T(p.velocity[i][c]);
      }
      q.mass[i] = T(p.mass[i]);
    }
    q.time = T(p.time);
    return q;
  }

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, participants>& p, const Parameters<double>& c) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return Vector<T, D>(L::force(p, T(c[I])...));
    }(std::make_index_sequence<n>{});
  }

  template <class T, int D>
  static T energy(const Participants<T, D, participants>& p, const Parameters<double>& c) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return T(L::energy(p, T(c[I])...));
    }(std::make_index_sequence<n>{});
  }

  /// f(dimension as a constant, random participants, random parameters), several times in each dimension.
  template <class F>
  static void at_random_participants(F f) {
    Uniform draw(11);
    const auto in_dimension = [&]<int D>(std::integral_constant<int, D> dimension) {
      SCOPED_TRACE("dimension " + std::to_string(D));
      for (int i = 0; i < 10; ++i) f(dimension, random_participants<D>(draw), random_parameters(draw));
    };
    in_dimension(std::integral_constant<int, 1>{});
    in_dimension(std::integral_constant<int, 2>{});
    in_dimension(std::integral_constant<int, 3>{});
  }
};
TYPED_TEST_SUITE(ForceLaws, AsTestTypes<Forces>::type, NameOfLaw);

TYPED_TEST(ForceLaws, ForceIsMinusTheGradientOfTheEnergy) {
  if constexpr (!TestFixture::has_energy) {
    GTEST_SKIP() << TypeParam::name << " has no energy";
  } else {
    TestFixture::at_random_participants(
        []<int D>(std::integral_constant<int, D>, const auto& p, const auto& c) {
          using J = Jet<RunningError<double>, 1>;
          const auto still = TestFixture::template converted<J, D>(p);
          const Vector<J, D> force = TestFixture::template force<J, D>(still, c);
          for (int participant = 0; participant < TypeParam::participants; ++participant)
            for (int axis = 0; axis < D; ++axis) {
              auto moved = still;
              moved.position[participant][axis][1] = 1.0;  // coefficient 1 of the energy is its derivative
              const RunningError<double> slope = TestFixture::template energy<J, D>(moved, c)[1];
              const RunningError<double> expected = force[axis][0];
              EXPECT_THAT(slope, IsCloseTo(participant == 0 ? -expected : expected)) << "axis " << axis;
            }
        });
  }
}

TYPED_TEST(ForceLaws, TurningTheWorldTurnsTheForceBetweenTwo) {
  if constexpr (TypeParam::participants == 1) {
    GTEST_SKIP() << TypeParam::name << " acts on one particle and may know a direction";
  } else {
    TestFixture::at_random_participants(
        []<int D>(std::integral_constant<int, D>, const auto& p, const auto& c) {
          // Turned by half-angle tangents 1/3 and -3/4 in two planes; on a line, by half a turn. The rotation
          // is orthogonal to 50 digits, and a handful of operations lose less than five of them.
          Eigen::Matrix<Digits50, D, D> turn = Eigen::Matrix<Digits50, D, D>::Identity();
          if constexpr (D == 1) turn(0, 0) = -1;
          const auto turn_plane = [&](int a, int b, const Digits50& t) {
            Eigen::Matrix<Digits50, D, D> r = Eigen::Matrix<Digits50, D, D>::Identity();
            r(a, a) = r(b, b) = (1 - t * t) / (1 + t * t);
            r(a, b) = -2 * t / (1 + t * t);
            r(b, a) = 2 * t / (1 + t * t);
            turn = (r * turn).eval();
          };
          for (int axis = 0; axis + 1 < D; ++axis)
            turn_plane(axis, axis + 1, Digits50(axis == 0 ? 1 : -3) / (3 + axis));

          const auto before = TestFixture::template converted<Digits50, D>(p);
          auto after = before;
          for (int i = 0; i < 2; ++i) {
            after.position[i] = turn * before.position[i];
            after.velocity[i] = turn * before.velocity[i];
          }
          const Vector<Digits50, D> turned = turn * TestFixture::template force<Digits50, D>(before, c);
          EXPECT_THAT((TestFixture::template force<Digits50, D>(after, c)), IsCloseTo(turned, within(1e-45)));
        });
  }
}

TYPED_TEST(ForceLaws, IsTheSameOnNumbersAndOnJets) {  // but for the order in which Eigen sums components
  TestFixture::at_random_participants(
      []<int D>(std::integral_constant<int, D>, const auto& p, const auto& c) {
        using Tracked = Jet<RunningError<double>, 3>;
        const Vector<double, D> on_numbers = TestFixture::template force<double, D>(p, c);
        const auto on_jets =
            TestFixture::template force<Tracked, D>(TestFixture::template converted<Tracked, D>(p), c);
        for (int axis = 0; axis < D; ++axis)
          EXPECT_THAT(on_jets[axis], HasCoefficients([&](int k) { return k == 0 ? on_numbers[axis] : 0.0; }));
      });
}

TYPED_TEST(ForceLaws, IsTheSameOnJetsAndOnATape) {
  constexpr int degree = 8;
  TestFixture::at_random_participants([]<int D>(std::integral_constant<int, D>, const auto& p,
                                                const auto& c) {
    using Tracked = Jet<RunningError<double>, degree>;
    auto moving = TestFixture::template converted<Tracked, D>(p);  // along polynomials
    Uniform draw(5);
    for (int k = 1; k <= degree; ++k)
      for (int i = 0; i < TypeParam::participants; ++i)
        for (int axis = 0; axis < D; ++axis) {
          moving.position[i][axis][k] = draw(-1, 1) * std::ldexp(0.5, -k);
          moving.velocity[i][axis][k] = draw(-1, 1) * std::ldexp(0.5, -k);
        }
    moving.time[1] = 1.0;
    const Vector<Tracked, D> on_jets = TestFixture::template force<Tracked, D>(moving, c);

    std::vector<double> parameters(c.begin(), c.end());
    parameters.insert(parameters.end(), p.mass.begin(), p.mass.end());
    const Program program(record_law<TypeParam>(D).force);
    Blocks<double> blocks(program, 1, parameters, scalar_kernels<double>());
    blocks.reserve(degree + 1);
    std::array<std::vector<RunningError<double>>, D> on_tape;
    for (int k = 0; k <= degree; ++k) {
      for (const auto& [place, input] : program.inputs) {
        const auto position = [&](int i) { return moving.position[i][input.component][k].value; };
        double& to = *blocks.at(0, place, k);
        switch (input.kind) {
          case Input::Kind::time: to = moving.time[k].value; break;
          case Input::Kind::position: to = position(input.participant); break;
          case Input::Kind::separation:
            to = position(input.participant) - position(1 - input.participant);
            break;
          case Input::Kind::velocity: to = moving.velocity[input.participant][input.component][k].value;
        }
      }
      blocks.run(0, k);
      for (int axis = 0; axis < D; ++axis)
        on_tape[axis].push_back(program.is_static && k > 0 ? 0.0 : *blocks.at(0, program.outputs[axis], k));
    }
    for (int axis = 0; axis < D; ++axis)
      EXPECT_THAT(on_jets[axis], IsCloseTo(on_tape[axis])) << "axis " << axis;
  });
}

TYPED_TEST(ForceLaws, PushesTwoEqualParticlesOppositely) {  // so their sum is zero to the last bit
  if constexpr (TypeParam::participants == 1) {
    GTEST_SKIP() << TypeParam::name << " acts on one particle";
  } else {
    TestFixture::at_random_participants(
        []<int D>(std::integral_constant<int, D>, const auto& p, const auto& c) {
          System<> system(D, {p.mass[0], p.mass[0]});
          system.add<TypeParam>({{0, 1}}, {c});
          State<> state{0.0, Coordinates<>(2, D), Coordinates<>(2, D)};
          for (int i = 0; i < 2; ++i) {
            state.position.row(i) = p.position[i];
            state.velocity.row(i) = p.velocity[i];
          }
          Expansion<> series(system);
          series.start(state);
          series.grow_to(12);
          for (int k = 2; k <= 12; ++k)
            for (int axis = 0; axis < D; ++axis)
              EXPECT_EQ(series.position(k)(0, axis), -series.position(k)(1, axis)) << "order " << k;
        });
  }
}

TYPED_TEST(ForceLaws, NamesItsParameters) {
  const RecordedLaw law = record_law<TypeParam>(2);
  EXPECT_EQ(law.name, TypeParam::name);
  EXPECT_EQ(law.participants, TypeParam::participants);
  EXPECT_EQ(law.parameters.size(), TypeParam::parameters.size());
  EXPECT_EQ(law.force.outputs.size(), 2u);
  EXPECT_EQ(law.energy.has_value(), TestFixture::has_energy);
  for (const auto& name : law.parameters) EXPECT_FALSE(name.empty());
  EXPECT_LT(law.stiffness_parameter, static_cast<int>(law.parameters.size()));
}

}  // namespace
}  // namespace jetlag::testing
