// SPDX-License-Identifier: MIT
// Laws of the force laws: every member of the register has these tests, in each dimension in which it is defined, and so
// have some of more participants than the register knows.
#include <gmock/gmock.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "forces/laws_on_jets.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/tape/program.hpp"
#include "support/close.hpp"
#include "support/eigenvalues.hpp"
#include "support/random.hpp"

namespace jetlag::testing::force_laws_test {
namespace {

class ForceLaws : public ::testing::TestWithParam<LawOnJets> {
 protected:
  const LawOnJets& law = GetParam();
  const int participants = law.participants;

  /// Particles at random, each in the positive octant from the one before: they do not meet.
  Moving random_participants(int dimension, Uniform& draw) const {
    Moving p;
    for (int i = 0; i < participants; ++i) {
      for (int c = 0; c < dimension; ++c) {
        p.position.emplace_back(draw(0, 1) + 1.5 * i);
        p.velocity.emplace_back(draw(-1, 1));
      }
      p.mass.push_back(draw(0.5, 2));
    }
    p.time = draw(0, 1);
    return p;
  }

  static Parameters random_numbers(std::size_t count, Uniform& draw) {
    Parameters c(count);
    for (double& x : c) x = draw(0.5, 2);
    return c;
  }

  /// What is near a barrier is well beyond its gap and within its thickness, edges nearly parallel: rounding
  /// hides forces that are next to nothing.
  Parameters random_parameters(const LawInDimension& in, Uniform& draw) const {
    Parameters c = random_numbers(law.parameters, draw);
    const auto names = in.recorded(in.dimension).parameters;
    for (std::size_t j = 0; j < names.size(); ++j)
      c[j] *= names[j] == "gap" ? 0.0625 : names[j] == "thickness" ? 4 : names[j] == "parallel" ? 128 : 1;
    return c;
  }

  /// A well-shaped simplex at rest, of some material where the law has one, and the participants near it, displaced as a
  /// whole: the corners 0, 2 e_1, 2 e_2, ... moved by up to 0.3 keep the sign of their volume. One that is flat at rest has
  /// its last corner at -2 e_2 then, all moved in the plane.
  std::pair<Moving, Parameters> near_a_rest_shape(const LawInDimension& in, Uniform& draw) const {
    const Parameters c =
        in.at_rest == nullptr ? random_parameters(in, draw) : random_numbers(in.materials, draw);
    Moving p = random_participants(in.dimension, draw);
    std::vector<double> rest(p.position.size());
    for (int i = 0; i < participants; ++i)
      for (int axis = 0; axis < in.dimension; ++axis) {
        const bool is_out = in.flat_at_rest && axis == 2, is_last = in.flat_at_rest && i == 3;
        const double corner = is_last ? (axis == 1 ? -2.0 : 0.0) : i == axis + 1 ? 2.0 : 0.0;
        rest[i * in.dimension + axis] = is_out ? 0.0 : corner + draw(-0.3, 0.3);
        p.position[i * in.dimension + axis] = 0.5 + corner + draw(-0.3, 0.3);
      }
    return {p, in.at_rest == nullptr ? c : in.at_rest(rest, c)};
  }

  /// From where they are, along random polynomials.
  static Moving set_in_motion(Moving p) {
    Uniform draw(5);
    for (int k = 1; k <= degree; ++k)
      for (std::size_t i = 0; i < p.position.size(); ++i) {
        p.position[i][k] = draw(-1, 1) * std::ldexp(0.5, -k);
        p.velocity[i][k] = draw(-1, 1) * std::ldexp(0.5, -k);
      }
    p.time[1] = 1.0;
    return p;
  }

  /// The forces on all participants, one after the other, from those given.
  template <class T>
  std::vector<T> on_all(std::vector<T> forces, int dimension) const {
    if (law.external) return forces;
    std::vector<T> last(dimension, T(0.0));
    for (std::size_t i = 0; i < forces.size(); ++i) last[i % dimension] -= forces[i];
    forces.insert(forces.end(), last.begin(), last.end());
    return forces;
  }
  std::vector<Tracked> forces(const LawInDimension& in, const Moving& p, const Parameters& c) const {
    return on_all(in.given(p, c), in.dimension);
  }

  /// f(the law, random participants at rest, random parameters), several times in each dimension.
  using Test = std::function<void(const LawInDimension& in, const Moving& p, const Parameters& c)>;
  void at_random_participants(const Test& f) const {
    Uniform draw(23);  // a seed of which no component is so near zero that rounding hides it
    for (const LawInDimension& in : law.in_dimensions) {
      SCOPED_TRACE("dimension " + std::to_string(in.dimension));
      for (int i = 0; i < 10; ++i) {
        // Particles at random are nearly in line, where angles are lost.
        if (in.at_rest != nullptr || (participants > 2 && participants <= in.dimension + 1)) {
          const auto [p, c] = near_a_rest_shape(in, draw);
          f(in, p, c);
          continue;
        }
        const Parameters c = random_parameters(in, draw);
        f(in, random_participants(in.dimension, draw), c);
      }
    }
  }

  /// One element, whose participants are all particles, of the masses given.
  System<> system_of(const LawInDimension& in, const Parameters& c, double mass) const {
    System<> system(in.dimension, std::vector<double>(participants, mass));
    std::vector<int> all(participants);
    for (int i = 0; i < participants; ++i) all[i] = i;
    system.add(in.recorded(in.dimension), all, c);
    return system;
  }
  State<> state_of(const LawInDimension& in, const Moving& p) const {
    State<> state{0.0, Coordinates<>(participants, in.dimension), Coordinates<>(participants, in.dimension)};
    for (int i = 0; i < participants * in.dimension; ++i) {
      state.position.data()[i] = p.position[i][0].value;
      state.velocity.data()[i] = p.velocity[i][0].value;
    }
    return state;
  }
};
/// Those that have an energy, and those that act between particles: who acts from outside may know a direction.
class ForceLawsWithEnergy : public ForceLaws {};
class InternalForceLaws : public ForceLaws {};

template <class F>
std::vector<LawOnJets> laws_where(F which) {
  std::vector<LawOnJets> found = all_laws();
  std::erase_if(found, [&](const LawOnJets& law) { return !which(law); });
  return found;
}
const auto name_of = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(, ForceLaws, ::testing::ValuesIn(all_laws()), name_of);
INSTANTIATE_TEST_SUITE_P(, ForceLawsWithEnergy,
                         ::testing::ValuesIn(laws_where([](const auto& law) { return law.has_energy; })),
                         name_of);
INSTANTIATE_TEST_SUITE_P(, InternalForceLaws,
                         ::testing::ValuesIn(laws_where([](const auto& law) { return !law.external; })),
                         name_of);

TEST_P(ForceLawsWithEnergy, ForceIsMinusTheGradientOfTheEnergy) {
  at_random_participants([&](const LawInDimension& in, const Moving& still, const Parameters& c) {
    const auto force = forces(in, still, c);
    for (std::size_t i = 0; i < force.size(); ++i) {
      auto moved = still;
      moved.position[i][1] = 1.0;  // coefficient 1 of the energy is its derivative
      const Number slope = in.energy(moved, c)[1], expected = -force[i][0];
      EXPECT_THAT(slope, IsCloseTo(expected))
          << "participant " << i / in.dimension << ", axis " << i % in.dimension;
    }
  });
}

/// An orthogonal matrix, wrong by the rounding that its numbers carry.
using Turn = std::array<std::array<Number, 3>, 3>;

/// By half-angle tangents 1/3 and -3/4 in two planes; on a line, by half a turn.
Turn turn_in(int dimension) {
  Turn turn{};
  for (int i = 0; i < 3; ++i) turn[i][i] = dimension == 1 ? -1.0 : 1.0;
  for (int a = 0; a + 1 < dimension; ++a) {
    const Number t = Number(a == 0 ? 1 : -3) / Number(3 + a), one = 1.0;
    const Number cos = (one - t * t) / (one + t * t), sin = (t + t) / (one + t * t);
    for (int column = 0; column < 3; ++column) {
      const Number x = turn[a][column], y = turn[a + 1][column];
      turn[a][column] = cos * x - sin * y;
      turn[a + 1][column] = sin * x + cos * y;
    }
  }
  return turn;
}
std::vector<Tracked> turned(const Turn& turn, const std::vector<Tracked>& vectors, int dimension) {
  std::vector<Tracked> all(vectors.size());
  for (int i = 0; i < static_cast<int>(vectors.size()); ++i)
    for (int c = 0; c < dimension; ++c)
      all[i] += Tracked(turn[i % dimension][c]) * vectors[i - i % dimension + c];
  return all;
}

TEST_P(InternalForceLaws, TurningTheWorldTurnsTheForceBetweenParticles) {  // along the whole motion
  at_random_participants([&](const LawInDimension& in, const Moving& p, const Parameters& c) {
    const Turn turn = turn_in(in.dimension);
    const Moving before = set_in_motion(p);
    Moving after = before;
    after.position = turned(turn, before.position, in.dimension);
    after.velocity = turned(turn, before.velocity, in.dimension);
    const auto expected = turned(turn, forces(in, before, c), in.dimension);
    const auto actual = forces(in, after, c);
    for (std::size_t i = 0; i < actual.size(); ++i)
      EXPECT_THAT(actual[i], IsCloseTo(expected[i])) << "component " << i;
  });
}

TEST_P(ForceLaws, IsTheSameOnNumbersAndOnJets) {  // but for the order in which Eigen sums components
  at_random_participants([&](const LawInDimension& in, const Moving& p, const Parameters& c) {
    const auto on_numbers = on_all(in.given_on_numbers(p, c), in.dimension);
    const auto on_jets = forces(in, p, c);
    ASSERT_EQ(on_numbers.size(), on_jets.size());
    for (std::size_t i = 0; i < on_numbers.size(); ++i)
      EXPECT_THAT(on_jets[i], IsCloseTo(Tracked(on_numbers[i]))) << "component " << i;
  });
}

TEST_P(ForceLaws, IsTheSameOnJetsAndOnATape) {
  at_random_participants([&](const LawInDimension& in, const Moving& p, const Parameters& c) {
    const Moving moving = set_in_motion(p);
    const auto on_jets = in.given(moving, c);

    Parameters parameters = c;
    parameters.insert(parameters.end(), p.mass.begin(), p.mass.end());
    const Program program(in.recorded(in.dimension).force);
    Blocks<double> blocks(program, 1, parameters, scalar_kernels<double>());
    blocks.reserve(degree + 1);
    std::vector<Tracked> on_tape(on_jets.size());
    ASSERT_EQ(program.outputs.size(), on_tape.size());
    for (int k = 0; k <= degree; ++k) {
      for (const auto& [place, input] : program.inputs) {
        const auto of = [&](const std::vector<Tracked>& vectors, int i) {
          return vectors[i * in.dimension + input.component][k].value;
        };
        double& to = *blocks.at(0, place, k);
        switch (input.kind) {
          case Input::Kind::time: to = moving.time[k].value; break;
          case Input::Kind::position: to = of(moving.position, input.participant); break;
          case Input::Kind::separation:
            to = of(moving.position, input.participant) - of(moving.position, input.minus);
            break;
          case Input::Kind::velocity: to = of(moving.velocity, input.participant);
        }
      }
      blocks.run(0, k);
      for (std::size_t i = 0; i < on_tape.size(); ++i)
        on_tape[i][k] = program.is_static && k > 0 ? 0.0 : *blocks.at(0, program.outputs[i], k);
    }
    for (std::size_t i = 0; i < on_tape.size(); ++i)
      EXPECT_THAT(on_jets[i], IsCloseTo(on_tape[i])) << "component " << i;
  });
}

TEST_P(InternalForceLaws, PushesEqualParticlesSoThatTheSumIsZero) {  // to the last bit
  at_random_participants([&](const LawInDimension& in, const Moving& p, const Parameters& c) {
    const System<> system = system_of(in, c, p.mass[0]);
    Expansion<> series(system);
    series.start(state_of(in, p));
    series.grow_to(12);
    for (int k = 2; k <= 12; ++k)
      for (int axis = 0; axis < in.dimension; ++axis) {
        const Eigen::VectorXd x = series.position(k).col(axis);
        // Coefficients are the forces times a number: of several each is rounded by itself.
        if (participants == 2)
          EXPECT_EQ(x(0), -x(1)) << "order " << k;
        else
          EXPECT_NEAR(x.sum(), 0, 2 * participants * x.cwiseAbs().sum() * 0x1p-53) << "order " << k;
      }
  });
}

TEST_P(InternalForceLaws, OfSeveralForcesSumUpToZeroInTheirOrder) {
  at_random_participants([&](const LawInDimension& in, const Moving& p, const Parameters& c) {
    const System<> system = system_of(in, c, 1.0);  // 2 x_2 = F / m is then exact
    Expansion<> series(system);
    series.start(state_of(in, p));
    series.grow();
    for (int axis = 0; axis < in.dimension; ++axis) {
      double sum = 0;
      for (int i = 0; i < participants; ++i) sum += series.position(2)(i, axis);
      EXPECT_EQ(sum, 0.0);
    }
  });
}

TEST_P(ForceLaws, AreNoStifferThanTheySay) {
  at_random_participants([&](const LawInDimension& in, const Moving& still, const Parameters& random) {
    const int d = in.dimension;
    const RecordedLaw recorded = in.recorded(d);
    if (recorded.stiffness == nullptr) return;
    auto c = random;
    const auto& names = recorded.parameters;
    double squared = 0;  // of a normal, which must be of length 1
    for (std::size_t j = 0; j < names.size(); ++j)
      if (names[j].starts_with("normal_") && static_cast<int>(j) < 2 + d) squared += c[j] * c[j];
    for (std::size_t j = 0; j < names.size(); ++j)
      if (names[j].starts_with("normal_")) c[j] /= std::sqrt(squared);
    const double k = recorded.stiffness(c.data());
    for (int participant = 0; participant < participants; ++participant) {
      Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(d, d);
      for (int axis = 0; axis < d; ++axis) {
        auto moved = still;
        moved.position[participant * d + axis][1] = 1.0;
        const auto f = forces(in, moved, c);
        for (int row = 0; row < d; ++row) tangent(row, axis) = -f[participant * d + row][1].value;
      }
      // Symmetric, as the second derivative of an energy; sums of a few products of numbers near k.
      EXPECT_LE(largest_eigenvalue(tangent), k * (1 + 64 * 0x1p-53)) << participant;
    }
  });
}

TEST_P(ForceLaws, SlowAParticleByTheirDamping) {
  at_random_participants([&](const LawInDimension& in, const Moving& still, const Parameters& c) {
    const RecordedLaw recorded = in.recorded(in.dimension);
    if (recorded.damping == nullptr) return;
    for (int axis = 0; axis < in.dimension; ++axis) {
      auto moved = still;
      moved.velocity[axis][1] = 1.0;
      const auto f = forces(in, moved, c);
      for (int row = 0; row < in.dimension; ++row)
        EXPECT_EQ(f[row][1].value, row == axis ? -recorded.damping(c.data()) : 0.0);
    }
  });
}

TEST_P(ForceLaws, NamesItsParameters) {
  for (const LawInDimension& in : law.in_dimensions) {
    SCOPED_TRACE("dimension " + std::to_string(in.dimension));
    const RecordedLaw recorded = in.recorded(in.dimension);
    EXPECT_EQ(recorded.name, law.name);
    EXPECT_EQ(recorded.participants, participants);
    EXPECT_EQ(recorded.parameters.size(), law.parameters);
    EXPECT_EQ(recorded.given, participants - (law.external ? 0 : 1));
    EXPECT_EQ(recorded.force.outputs.size(), static_cast<std::size_t>(recorded.given * in.dimension));
    EXPECT_EQ(recorded.energy.has_value(), law.has_energy);
    for (const auto& name : recorded.parameters) EXPECT_FALSE(name.empty());
  }
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
}  // namespace jetlag::testing::force_laws_test
