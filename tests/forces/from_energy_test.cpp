// SPDX-License-Identifier: MIT
// A law that gives its energy alone moves its particles as the one whose forces are written by hand.
#include "problems/from_energy.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/ensembles/ensemble.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/schedule/avi.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/tape/program.hpp"
#include "support/engine_of_numbers.hpp"
#include "support/laws/jelly.hpp"
#include "support/random.hpp"
#include "support/running_error.hpp"

namespace jetlag::testing::from_energy_test {
namespace {

using problems::FromEnergy;

constexpr int degree = 16;
using Number = RunningError<double>;
using Series = std::vector<Number>;

/// A law twice: its forces by hand, and from its energy.
struct Twins {
  RecordedLaw by_hand, from_energy;
};
template <class L, int D>
void add_twins_in(std::vector<Twins>& all) {
  if constexpr (is_defined_in<L>(D)) {
    constexpr bool has_energy = requires(const Participants<double, D, L::participants>& p) {
      []<std::size_t... I>(const auto& q, std::index_sequence<I...>)
        requires(requires { L::energy(q, ((void)I, 0.0)...); })
      {}(p, std::make_index_sequence<L::parameters.size()>{});
    };
    if constexpr (jetlag::detail::has_force<L, D, Recorded> || jetlag::detail::has_forces<L, D, Recorded>)
      if constexpr (has_energy) all.push_back({record_law<L>(D), record_law<FromEnergy<L>>(D)});
  }
}
template <class L>
void add_twins(std::vector<Twins>& all) {
  if constexpr (!requires { L::material; }) {  // such laws need parameters of a rest shape: laws_test.cpp
    add_twins_in<L, 1>(all);
    add_twins_in<L, 2>(all);
    add_twins_in<L, 3>(all);
  }
}
std::vector<Twins> all_twins() {
  std::vector<Twins> all;
  Forces::for_each([&]<class L>(std::type_identity<L>) { add_twins<L>(all); });
  add_twins<AngleByHand>(all);
  add_twins<Bend>(all);
  add_twins<Tetrahedron>(all);
  add_twins<Anchors>(all);
  return all;
}

/// Each particle in the positive octant from the one before, so that they do not meet; or near the corners of a simplex, since
/// particles that are nearly in line lose the distances between them.
double place(const RecordedLaw& law, int participant, int axis, Uniform& draw) {
  if (law.participants > 2 && law.participants <= law.dimension + 1)
    return (participant == axis + 1 ? 2.0 : 0.0) + draw(-0.3, 0.3);
  return draw(0, 1) + 1.5 * participant;
}

std::vector<Number> random_numbers(std::size_t count, Uniform& draw) {
  std::vector<Number> all;
  for (std::size_t i = 0; i < count; ++i) all.emplace_back(draw(0.5, 2));
  return all;
}

/// Of the law, and masses. What is near a barrier is well beyond its gap and within its thickness, edges nearly parallel.
std::vector<Number> random_parameters(const RecordedLaw& law, std::size_t count, Uniform& draw) {
  auto all = random_numbers(count, draw);
  for (std::size_t j = 0; j < law.parameters.size(); ++j)
    all[j] *= Number(law.parameters[j] == "gap"         ? 0.0625
                     : law.parameters[j] == "thickness" ? 4.0
                     : law.parameters[j] == "parallel"  ? 64.0
                                                        : 1.0);
  return all;
}

/// The forces that a law gives along a motion, whose positions are series, component by component.
std::vector<Series> forces_along(const std::vector<Series>& positions, const std::vector<Number>& parameters,
                                 const RecordedLaw& law) {
  const Program program(law.force);
  Blocks<Number> blocks(program, 1, parameters, scalar_kernels<Number>());
  blocks.reserve(degree + 1);
  std::vector<Series> forces(program.outputs.size(), Series(degree + 1));
  for (int k = 0; k <= degree; ++k) {
    for (const auto& [place, input] : program.inputs) {
      const auto of = [&](int i) { return positions[i * law.dimension + input.component][k]; };
      Number x = of(input.participant);
      if (input.kind == Input::Kind::separation) x -= of(input.minus);
      *blocks.at(0, place, k) = x;
    }
    blocks.run(0, k);
    for (std::size_t i = 0; i < forces.size(); ++i)
      if (k == 0 || !program.is_static) forces[i][k] = *blocks.at(0, program.outputs[i], k);
  }
  return forces;
}

/// Equal within the bounds that both carry, which are small beside them.
void expect_close(const Number& a, const Number& b, double scale, const std::string& what) {
  EXPECT_LE(std::abs(a.value - b.value), a.error + b.error) << what << ": " << a << " and " << b;
  EXPECT_LE(a.error + b.error, 0x1p-26 * scale) << what << ": proves nothing";
}

TEST(FromEnergy, GivesTheForcesThatAreWrittenByHand) {  // to all orders, along polynomials
  Uniform draw(17);
  for (const auto& [by_hand, from_energy] : all_twins())
    for (int sample = 0; sample < 5; ++sample) {
      std::vector<Series> positions;
      for (int i = 0; i < by_hand.participants; ++i)
        for (int axis = 0; axis < by_hand.dimension; ++axis) {
          Series x{place(by_hand, i, axis, draw)};
          for (int k = 1; k <= degree; ++k) x.emplace_back(draw(-1, 1) * std::ldexp(0.5, -k));
          positions.push_back(x);
        }
      const auto parameters = random_parameters(by_hand, by_hand.force.parameters, draw);
      const auto expected = forces_along(positions, parameters, by_hand);
      const auto actual = forces_along(positions, parameters, from_energy);
      ASSERT_EQ(actual.size(), expected.size());
      for (std::size_t i = 0; i < actual.size(); ++i) {
        double scale = 0;
        for (const Number& x : expected[i]) scale = std::max(scale, std::abs(x.value));
        for (int k = 0; k <= degree; ++k)
          expect_close(actual[i][k], expected[i][k], scale,
                       by_hand.name + " in " + std::to_string(by_hand.dimension) + ", component " +
                           std::to_string(i) + ", order " + std::to_string(k));
      }
    }
}

TEST(FromEnergy, MovesASystemAlike) {  // the motion under one element, to all orders
  Uniform draw(18);
  for (const auto& [by_hand, from_energy] : all_twins()) {
    const int particles = by_hand.participants, dimension = by_hand.dimension;
    State<Number> state{0.0, Coordinates<Number>(particles, dimension),
                        Coordinates<Number>(particles, dimension)};
    std::vector<int> all;
    for (int i = 0; i < particles; ++i) {
      all.push_back(i);
      for (int axis = 0; axis < dimension; ++axis) {
        state.position(i, axis) = place(by_hand, i, axis, draw);
        state.velocity(i, axis) = draw(-0.25, 0.25);
      }
    }
    const auto mass = random_numbers(particles, draw),
               parameters = random_parameters(by_hand, by_hand.parameters.size(), draw);
    const auto expanded = [&](const RecordedLaw& law) {
      System<Number> system(dimension, mass);
      system.add(law, all, parameters);
      auto series = std::make_unique<Expansion<Number>>(system, degree, scalar_kernels<Number>());
      series->start(state);
      series->grow_to(degree);
      return series;
    };
    const auto expected = expanded(by_hand), actual = expanded(from_energy);
    for (int k = 0; k <= degree; ++k) {
      double scale = 10;  // of steep laws: bounds of 2^-16 of the largest coefficient
      for (const Number& x : expected->position(k).reshaped())
        scale = std::max(scale, 1024 * std::abs(x.value));
      for (int i = 0; i < particles; ++i)
        for (int axis = 0; axis < dimension; ++axis)
          expect_close(actual->position(k)(i, axis), expected->position(k)(i, axis), scale,
                       by_hand.name + " in " + std::to_string(dimension) + ", order " + std::to_string(k));
    }
  }
}

struct Viscous {  // no energy in truth
  static constexpr const char* name = "viscous";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"viscosity"};
  template <class T, int D>
  static T energy(const Participants<T, D, 1>& p, const T& c) {
    return c * p.velocity[0].dot(p.position[0]);
  }
};
TEST(FromEnergy, IsRefusedOfVelocities) {
  EXPECT_THAT([] { record_law<Viscous>(2); },
              ::testing::ThrowsMessage<std::invalid_argument>(
                  "viscous: forces from an energy that depends on velocities"));
}

/// E = k/2 (|x_0|^2 + |x_1|^2): of places, not of differences.
struct TetherBetween {
  static constexpr const char* name = "tether";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness"};
  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& k) {
    return T(0.5) * k * (p.position[0].squaredNorm() + p.position[1].squaredNorm());
  }
};
struct Tether : TetherBetween {
  static constexpr bool external = true;
};
TEST(FromEnergy, IsRefusedOfPlacesUnlessTheLawIsExternal) {  // the last would get minus what pulls the other
  EXPECT_THAT([] { record_law<TetherBetween>(2); },
              ::testing::ThrowsMessage<std::invalid_argument>(
                  ::testing::HasSubstr("tether: the energy of a law between particles must be written in "
                                       "differences")));
  System<double> system(1, {1.0, 1.0});
  system.add<Tether>({{0, 1}}, {{4.0}});
  Expansion<double> series(system, degree);
  State<double> state{0.0, Coordinates<double>(2, 1), Coordinates<double>::Zero(2, 1)};
  state.position << 1, 3;
  series.start(state);
  series.grow_to(2);
  EXPECT_EQ(series.position(2)(0, 0), -2.0);  // x'' = -4 x
  EXPECT_EQ(series.position(2)(1, 0), -6.0);
}

/// E = k/2 |d|^2 by way of the length; of max(-n . x, 0)^(5/2); and one that changes with the time.
struct Roundabout {
  static constexpr const char* name = "roundabout";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"stiffness"};
  template <class T, int D>
  static T energy(const Participants<T, D, 1>& p, const T& k) {
    using jetlag::max, jetlag::pow, jetlag::cos;
    const T length = p.position[0].norm();
    return T(0.5) * k * length * length + pow(max(T(-p.position[0][0]), T(0.0)), 2.5) +
           p.position[0][0] * cos(p.time);
  }
};
TEST(FromEnergy, ExistsWhereOnlyTheWayToTheEnergyDoesNot) {  // at the origin; x'' = -4 x - cos t
  System<double> system(2, {1.0});
  system.add<Roundabout>({{0}}, {{4.0}});
  Expansion<double> series(system, degree);
  series.start({0.0, Coordinates<double>::Zero(1, 2), Coordinates<double>::Zero(1, 2)});
  series.grow_to(2);
  EXPECT_EQ(series.position(2)(0, 0), -0.5);
  EXPECT_EQ(series.position(2)(0, 1), 0.0);
}
TEST(FromEnergy, MakesItsChoices) {  // x'' = -4 x + 5/2 (-x)^(3/2) - 1 at x = -1/4 < 0, -4 x - 1 at x = 1/4
  for (const double x : {-0.25, 0.25}) {
    System<double> system(2, {1.0});
    system.add<Roundabout>({{0}}, {{4.0}});
    Expansion<double> series(system, degree);
    series.start({0.0, (Coordinates<double>(1, 2) << x, 0.0).finished(), Coordinates<double>::Zero(1, 2)});
    series.grow_to(degree);
    EXPECT_EQ(series.position(2)(0, 0), (x < 0 ? 1.0 + 2.5 * 0.125 - 1.0 : -2.0) / 2);
    EXPECT_TRUE(std::isfinite(series.position(degree)(0, 0)));
  }
}

// ---- in methods ------------------------------------------------------------------------------------------

/// How far two bodies of jelly, one by hand and one from energies, are from each other in the end.
template <class Method>
double distance_after(double until, Method method) {
  const auto end_of = [&](const Problem& scene) {
    State<double> state = scene.start;
    const auto schedule = method(scene.system);
    const Report report = schedule->run(state, until, {});
    EXPECT_EQ(report.outcome, Outcome::success) << report.message;
    return state;
  };
  const auto a = end_of(jelly()),
             b = end_of(jelly<FromEnergy<Spring>, FromEnergy<Tetrahedron>, FromEnergy<AngleByHand>>());
  EXPECT_GT((a.position - jelly().start.position).cwiseAbs().maxCoeff(), 0.1);  // the test is not idle
  return std::max((a.position - b.position).cwiseAbs().maxCoeff(),
                  (a.velocity - b.velocity).cwiseAbs().maxCoeff());
}

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(FromEnergy, MovesAlikeInLockstep) {  // some 40 steps, each of which rounds numbers near 1 of 8 particles
  EXPECT_LT(
      distance_after(2.0,
                     [](const auto& system) {
                       return std::make_unique<Lockstep>(taylor(system, 16, std::make_unique<JorbaZou>(0.1)));
                     }),
      40 * 8 * eps);
}

TEST(FromEnergy,
     MovesAlikeOnClocksOfTheirOwn) {  // some 100 steps of a particle, each wrong by the tolerance at most
  BlockSteps::Options options;
  options.tolerance = 1e-11;
  EXPECT_LT(distance_after(
                2.0, [&](const auto& system) { return std::make_unique<BlockSteps>(system, 10, options); }),
            100 * options.tolerance);
}

TEST(FromEnergy, MovesAlikeUnderImpulses) {  // 200 steps, in each of which a particle has some 8 impulses
  EXPECT_LT(
      distance_after(
          2.0, [](const auto& system) { return std::make_unique<Avi>(system, equal_steps(system, 0.01)); }),
      200 * 8 * 8 * eps);
}

TEST(FromEnergy, MovesAlikeInLanes) {
  const auto end_of = [](const Problem& scene) {
    std::vector<State<double>> starts(9, scene.start);
    for (std::size_t i = 1; i < starts.size(); ++i) starts[i].velocity *= 1 + 0.01 * static_cast<double>(i);
    Ensemble ensemble(scene.system, 16, starts);
    ensemble.advance_to(2.0);
    return std::array{ensemble.state(0), ensemble.state(8)};
  };
  const auto a = end_of(jelly()),
             b = end_of(jelly<FromEnergy<Spring>, FromEnergy<Tetrahedron>, FromEnergy<AngleByHand>>());
  for (int i = 0; i < 2; ++i) EXPECT_LT((a[i].position - b[i].position).cwiseAbs().maxCoeff(), 40 * 8 * eps);
}

}  // namespace
}  // namespace jetlag::testing::from_energy_test
