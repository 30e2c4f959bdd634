// SPDX-License-Identifier: MIT
// Laws of the force laws: every member of the register has these tests, in each dimension in which it is defined, and so
// have some of more participants than the register knows.
#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>
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
#include "support/laws_of_many.hpp"
#include "support/random.hpp"

namespace jetlag::testing {
namespace {

template <class List>
struct AsTestTypes;
template <ForceLaw... L>
struct AsTestTypes<LawList<L...>> {
  using type = ::testing::Types<L..., Angle, Bend, Tetrahedron, Anchors>;
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

  /// Particles at random, each in the positive octant from the one before: they do not meet.
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

  /// The forces on all participants, one after the other, shape (participants x D).
  template <class T, int D>
  static Eigen::Matrix<T, D * participants, 1> forces(const Participants<T, D, participants>& p,
                                                      const Parameters<double>& c) {
    const auto given = [&]<std::size_t... I>(std::index_sequence<I...>) {
      return forces_of<L>(p, T(c[I])...);
    }(std::make_index_sequence<n>{});
    Eigen::Matrix<T, D * participants, 1> all = Eigen::Matrix<T, D * participants, 1>::Constant(T(0.0));
    for (int i = 0; i < forces_given<L>; ++i) {
      all.template segment<D>(i * D) += given[i];
      if constexpr (!is_external<L>()) all.template tail<D>() -= given[i];
    }
    return all;
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
    if constexpr (is_defined_in<L>(1)) in_dimension(std::integral_constant<int, 1>{});
    if constexpr (is_defined_in<L>(2)) in_dimension(std::integral_constant<int, 2>{});
    if constexpr (is_defined_in<L>(3)) in_dimension(std::integral_constant<int, 3>{});
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
          const auto force = TestFixture::template forces<J, D>(still, c);
          for (int participant = 0; participant < TypeParam::participants; ++participant)
            for (int axis = 0; axis < D; ++axis) {
              auto moved = still;
              moved.position[participant][axis][1] = 1.0;  // coefficient 1 of the energy is its derivative
              const RunningError<double> slope = TestFixture::template energy<J, D>(moved, c)[1];
              const RunningError<double> expected = -force[participant * D + axis][0];
              EXPECT_THAT(slope, IsCloseTo(expected)) << "participant " << participant << ", axis " << axis;
            }
        });
  }
}

TYPED_TEST(ForceLaws, TurningTheWorldTurnsTheForceBetweenParticles) {
  if constexpr (is_external<TypeParam>()) {
    GTEST_SKIP() << TypeParam::name << " acts from outside and may know a direction";
  } else {
    TestFixture::at_random_participants([]<int D>(std::integral_constant<int, D>, const auto& p,
                                                  const auto& c) {
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
      for (int i = 0; i < TypeParam::participants; ++i) {
        after.position[i] = turn * before.position[i];
        after.velocity[i] = turn * before.velocity[i];
      }
      auto turned = TestFixture::template forces<Digits50, D>(before, c);
      for (int i = 0; i < TypeParam::participants; ++i)
        turned.template segment<D>(i * D) = (turn * turned.template segment<D>(i * D)).eval();
      EXPECT_THAT((TestFixture::template forces<Digits50, D>(after, c)), IsCloseTo(turned, within(1e-45)));
    });
  }
}

TYPED_TEST(ForceLaws, IsTheSameOnNumbersAndOnJets) {  // but for the order in which Eigen sums components
  TestFixture::at_random_participants(
      []<int D>(std::integral_constant<int, D>, const auto& p, const auto& c) {
        using Tracked = Jet<RunningError<double>, 3>;
        const auto on_numbers = TestFixture::template forces<double, D>(p, c);
        const auto on_jets =
            TestFixture::template forces<Tracked, D>(TestFixture::template converted<Tracked, D>(p), c);
        for (int i = 0; i < on_numbers.size(); ++i)
          EXPECT_THAT(on_jets[i], HasCoefficients([&](int k) { return k == 0 ? on_numbers[i] : 0.0; }));
      });
}

TYPED_TEST(ForceLaws, IsTheSameOnJetsAndOnATape) {
  constexpr int degree = 8;
  TestFixture::at_random_participants(
      []<int D>(std::integral_constant<int, D>, const auto& p, const auto& c) {
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
        const auto on_jets = TestFixture::template forces<Tracked, D>(moving, c);

        std::vector<double> parameters(c.begin(), c.end());
        parameters.insert(parameters.end(), p.mass.begin(), p.mass.end());
        const Program program(record_law<TypeParam>(D).force);
        Blocks<double> blocks(program, 1, parameters, scalar_kernels<double>());
        blocks.reserve(degree + 1);
        std::array<std::vector<RunningError<double>>, D * forces_given<TypeParam>> on_tape;
        for (int k = 0; k <= degree; ++k) {
          for (const auto& [place, input] : program.inputs) {
            const auto position = [&](int i) { return moving.position[i][input.component][k].value; };
            double& to = *blocks.at(0, place, k);
            switch (input.kind) {
              case Input::Kind::time: to = moving.time[k].value; break;
              case Input::Kind::position: to = position(input.participant); break;
              case Input::Kind::separation: to = position(input.participant) - position(input.minus); break;
              case Input::Kind::velocity: to = moving.velocity[input.participant][input.component][k].value;
            }
          }
          blocks.run(0, k);
          for (std::size_t i = 0; i < on_tape.size(); ++i)
            on_tape[i].push_back(program.is_static && k > 0 ? 0.0 : *blocks.at(0, program.outputs[i], k));
        }
        for (std::size_t i = 0; i < on_tape.size(); ++i)
          EXPECT_THAT(on_jets[static_cast<int>(i)], IsCloseTo(on_tape[i])) << "component " << i;
      });
}

TYPED_TEST(ForceLaws, PushesEqualParticlesSoThatTheSumIsZero) {  // to the last bit
  if constexpr (is_external<TypeParam>()) {
    GTEST_SKIP() << TypeParam::name << " acts from outside";
  } else {
    TestFixture::at_random_participants(
        []<int D>(std::integral_constant<int, D>, const auto& p, const auto& c) {
          constexpr int n = TypeParam::participants;
          System<> system(D, std::vector<double>(n, p.mass[0]));
          std::array<int, n> all;
          for (int i = 0; i < n; ++i) all[i] = i;
          system.add<TypeParam>({all}, {c});
          State<> state{0.0, Coordinates<>(n, D), Coordinates<>(n, D)};
          for (int i = 0; i < n; ++i) {
            state.position.row(i) = p.position[i];
            state.velocity.row(i) = p.velocity[i];
          }
          Expansion<> series(system);
          series.start(state);
          series.grow_to(12);
          for (int k = 2; k <= 12; ++k)
            for (int axis = 0; axis < D; ++axis) {
              const auto x = series.position(k).col(axis);
              // Coefficients are the forces times a number: of several each is rounded by itself.
              if constexpr (n == 2)
                EXPECT_EQ(x(0), -x(1)) << "order " << k;
              else
                EXPECT_NEAR(x.sum(), 0, 2 * n * x.cwiseAbs().sum() * 0x1p-53) << "order " << k;
            }
        });
  }
}

TYPED_TEST(ForceLaws, OfSeveralForcesSumUpToZeroInTheirOrder) {
  if constexpr (is_external<TypeParam>()) {
    GTEST_SKIP() << TypeParam::name << " acts from outside";
  } else {
    TestFixture::at_random_participants(
        []<int D>(std::integral_constant<int, D>, const auto& p, const auto& c) {
          constexpr int n = TypeParam::participants;
          System<> system(D, std::vector<double>(n, 1.0));  // 2 x_2 = F / m is then exact
          std::array<int, n> all;
          for (int i = 0; i < n; ++i) all[i] = i;
          system.add<TypeParam>({all}, {c});
          State<> state{0.0, Coordinates<>(n, D), Coordinates<>(n, D)};
          for (int i = 0; i < n; ++i) {
            state.position.row(i) = p.position[i];
            state.velocity.row(i) = p.velocity[i];
          }
          Expansion<> series(system);
          series.start(state);
          series.grow();
          for (int axis = 0; axis < D; ++axis) {
            double sum = 0;
            for (int i = 0; i < n; ++i) sum += series.position(2)(i, axis);
            EXPECT_EQ(sum, 0.0);
          }
        });
  }
}

TYPED_TEST(ForceLaws, AreNoStifferThanTheySay) {
  TestFixture::at_random_participants(
      []<int D>(std::integral_constant<int, D>, const auto& p, const auto& random) {
        const RecordedLaw law = record_law<TypeParam>(D);
        if (law.stiffness == nullptr) return;
        auto c = random;
        double squared = 0;  // of a normal, which must be of length 1
        for (std::size_t j = 0; j < law.parameters.size(); ++j)
          if (law.parameters[j].starts_with("normal_") && j < 2 + D) squared += c[j] * c[j];
        for (std::size_t j = 0; j < law.parameters.size(); ++j)
          if (law.parameters[j].starts_with("normal_")) c[j] /= std::sqrt(squared);
        using J = Jet<double, 1>;
        const double k = law.stiffness(c.data());
        for (int participant = 0; participant < TypeParam::participants; ++participant) {
          Eigen::MatrixXd tangent(D, D);
          for (int axis = 0; axis < D; ++axis) {
            auto moved = TestFixture::template converted<J, D>(p);
            moved.position[participant][axis][1] = 1.0;
            const auto f = TestFixture::template forces<J, D>(moved, c);
            for (int row = 0; row < D; ++row) tangent(row, axis) = -f[participant * D + row][1];
          }
          // Symmetric, as the second derivative of an energy; sums of a few products of numbers near k.
          const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(tangent);
          EXPECT_LE(solver.eigenvalues().maxCoeff(), k * (1 + 64 * 0x1p-53)) << participant;
        }
      });
}

TYPED_TEST(ForceLaws, SlowAParticleByTheirDamping) {
  TestFixture::at_random_participants(
      []<int D>(std::integral_constant<int, D>, const auto& p, const auto& c) {
        const RecordedLaw law = record_law<TypeParam>(D);
        if (law.damping == nullptr) return;
        using J = Jet<double, 1>;
        for (int axis = 0; axis < D; ++axis) {
          auto moved = TestFixture::template converted<J, D>(p);
          moved.velocity[0][axis][1] = 1.0;
          const auto f = TestFixture::template forces<J, D>(moved, c);
          for (int row = 0; row < D; ++row) EXPECT_EQ(f[row][1], row == axis ? -law.damping(c.data()) : 0.0);
        }
      });
}

TYPED_TEST(ForceLaws, NamesItsParameters) {
  const int dimension = is_defined_in<TypeParam>(2) ? 2 : 3;
  const RecordedLaw law = record_law<TypeParam>(dimension);
  EXPECT_EQ(law.name, TypeParam::name);
  EXPECT_EQ(law.participants, TypeParam::participants);
  EXPECT_EQ(law.parameters.size(), TypeParam::parameters.size());
  EXPECT_EQ(law.given, TypeParam::participants - (is_external<TypeParam>() ? 0 : 1));
  EXPECT_EQ(law.force.outputs.size(), static_cast<std::size_t>(law.given * dimension));
  EXPECT_EQ(law.energy.has_value(), TestFixture::has_energy);
  for (const auto& name : law.parameters) EXPECT_FALSE(name.empty());
}

TEST(ForceLaw, IsRefusedInADimensionInWhichItIsNotDefined) {
  for (const int dimension : {1, 2}) {
    System<> system(dimension, std::vector<double>(4, 1.0));
    EXPECT_THAT([&] { (system.add<Tetrahedron>({{0, 1, 2, 3}}, {{1.0, 1.0}})); },
                ::testing::ThrowsMessage<std::invalid_argument>("tetrahedron is not defined in dimension " +
                                                                std::to_string(dimension)));
  }
  EXPECT_EQ(record_law<Tetrahedron>(3).dimension, 3);
  EXPECT_EQ(record_law<Angle>(2).dimension, 2);
}

TEST(ForceLaw, IsRefusedWhereAParticleTakesPartTwice) {
  System<> system(3, std::vector<double>(4, 1.0));
  for (const std::array<int, 4>& members : {std::array{0, 1, 2, 0}, {0, 1, 1, 2}, {0, 1, 2, 2}})
    EXPECT_THROW(system.add<Tetrahedron>({members}, {{1.0, 1.0}}), std::invalid_argument);
}

TEST(ForceLaw, StatesWhichStiffnessAndDampingItHas) {
  const double parameters[] = {3.0, 0.5, 0, 0, 0};
  EXPECT_EQ(record_law<Spring>(3).stiffness(parameters), 3.0);
  EXPECT_EQ(record_law<Floor>(3).stiffness(parameters), 3.0);
  EXPECT_EQ(record_law<Bend>(3).stiffness(parameters), 12.0);
  EXPECT_EQ(record_law<Drag>(3).damping(parameters), 3.0);
  EXPECT_EQ(record_law<Gravity>(3).stiffness, nullptr);
  EXPECT_EQ(record_law<QuadraticFloor>(3).stiffness, nullptr);
  EXPECT_EQ(record_law<Spring>(3).damping, nullptr);
}

}  // namespace
}  // namespace jetlag::testing
