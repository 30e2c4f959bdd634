// SPDX-License-Identifier: MIT
// What rest shapes and materials are accepted, and what follows from them.
#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/forces/solids/lame.hpp"
#include "jetlag/model/lumped_mass.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "support/close.hpp"

namespace jetlag::testing::rest_shapes_test {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

auto refused(const char* who, const char* what) {
  return ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(who), HasSubstr(what)));
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Two tetrahedra on the corners 0, e_x, e_y, e_z and (1, 1, 1).
const std::vector<std::array<int, 4>> two{{0, 1, 2, 3}, {1, 2, 3, 4}};
Coordinates<double> corners() {
  Coordinates<double> x(5, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1;
  return x;
}
template <class L>
void add(const std::vector<std::array<int, 4>>& elements, const Coordinates<double>& rest,
         const std::vector<std::array<double, 2>>& material) {
  System<> system(3, std::vector<double>(5, 1.0));
  system.add_at_rest<L>(elements, rest, material);
}

TEST(RestShape, IsRefusedInsideOut) {
  EXPECT_THAT([] { add<Stvk>({{0, 1, 2, 3}, {2, 1, 3, 4}}, corners(), {{3, 2}}); },
              refused("stvk 1: volume -0.333333 m^3", "exchange two of its vertices"));
  System<> plane(2, std::vector<double>(3, 1.0));
  Coordinates<double> clockwise(3, 2);
  clockwise << 0, 0, 0, 1, 1, 0;
  EXPECT_THAT([&] { plane.add_at_rest<PlaneStvk>({{0, 1, 2}}, clockwise, {{3, 2, 1}}); },
              refused("plane_stvk 0: area -0.5 m^2", "exchange two"));
}

TEST(RestShape,
     IsRefusedWhereItIsFlat) {  // heights of 1e-13 of the edges, in either order; 1e-11 is a sliver
  for (const double height : {1e-13, 0.0, -1e-13}) {
    auto flat = corners();
    flat.row(4) = (flat.row(1) + flat.row(2) + flat.row(3)) / 3;
    flat.row(4).array() += height;
    EXPECT_THAT([&] { add<NeoHookean>(two, flat, {{3, 2}}); },
                refused("neo_hookean 1: flat at rest", "1e-12"));
    flat.row(4).array() += 1e-11 - height;
    EXPECT_NO_THROW(add<NeoHookean>(two, flat, {{3, 2}}));
  }
  auto huge = corners();  // of no importance in which unit
  huge *= 1e30;
  EXPECT_NO_THROW(add<NeoHookean>(two, huge, {{3, 2}}));
}

TEST(RestShape, IsRefusedWhereItIsNotFinite) {
  auto rest = corners();
  rest(4, 1) = nan;
  EXPECT_THAT([&] { add<Stvk>(two, rest, {{3, 2}}); }, refused("stvk 1", "finite"));
  EXPECT_THAT([&] { add<KelvinVoigt>(two, rest, {{3, 2}}); }, refused("kelvin_voigt 1", "finite"));
}

TEST(RestShape, IsOfTheParticlesOfTheSystem) {
  EXPECT_THAT([] { add<Stvk>(two, corners().topRows(4), {{3, 2}}); }, refused("stvk", "shape (5, 3)"));
  EXPECT_THAT([] { add<Stvk>({{0, 1, 2, 5}}, corners(), {{3, 2}}); },
              refused("stvk 0", "particle 5 does not exist"));
  EXPECT_THAT([] { add<Stvk>({{0, 1, 2, 2}}, corners(), {{3, 2}}); },
              refused("stvk 0", "paired with itself"));
  System<> plane(2, std::vector<double>(5, 1.0));
  EXPECT_THAT([&] { plane.add_at_rest<Stvk>(two, corners(), {{3, 2}}); }, refused("stvk", "dimension 2"));
}

TEST(Material, IsOneForAllOrOneForEach) {
  EXPECT_NO_THROW(add<Stvk>(two, corners(), {{3, 2}, {4, 2}}));
  EXPECT_THAT([] { add<Stvk>(two, corners(), {{3, 2}, {4, 2}, {5, 2}}); },
              refused("stvk", "each of 2 elements"));
  System<> one_for_all(3, std::vector<double>(5, 1.0)), one_for_each = one_for_all;
  one_for_all.add_at_rest<Stvk>(two, corners(), {{3, 2}});
  one_for_each.add_at_rest<Stvk>(two, corners(), {{3, 2}, {3, 2}});
  EXPECT_EQ(one_for_all.elements()[0].parameters, one_for_each.elements()[0].parameters);
}

TEST(Material, IsRefusedWhereItIsNotElastic) {
  EXPECT_THAT([] { add<Stvk>(two, corners(), {{3, 2}, {3, 0}}); },
              refused("stvk 1", "lame_mu must be > 0, got 0 Pa"));
  EXPECT_THAT([] { add<NeoHookean>(two, corners(), {{-2, 3}}); }, refused("neo_hookean 0", "got -2 Pa"));
  EXPECT_THAT([] { add<StableNeoHookean>(two, corners(), {{nan, 3}}); },
              refused("stable_neo_hookean 0", "lame_lambda"));
  EXPECT_THAT([] { add<KelvinVoigt>(two, corners(), {{0, -1}}); }, refused("kelvin_voigt 0", "viscosity_mu"));
  EXPECT_NO_THROW(add<KelvinVoigt>(two, corners(), {{0, 0}}));
  System<> plane(2, std::vector<double>(3, 1.0));
  Coordinates<double> triangle(3, 2);
  triangle << 0, 0, 1, 0, 0, 1;
  EXPECT_THAT([&] { plane.add_at_rest<PlaneNeoHookean>({{0, 1, 2}}, triangle, {{3, 2, 0}}); },
              refused("plane_neo_hookean 0", "thickness must be > 0"));
}

TEST(Lame,
     AreThoseOfLinearElasticity) {  // E = mu (3 lambda + 2 mu)/(lambda + mu), nu = lambda/(2 (lambda + mu))
  for (const double nu : {-0.9, 0.0, 0.3, 0.499}) {
    const auto [lambda, mu] = lame(7.0, nu);
    // 1 - 2 nu and the sums below lose up to 1 / (1 - 2 nu) = 500 ulps.
    EXPECT_NEAR(mu * (3 * lambda + 2 * mu) / (lambda + mu), 7.0, 7e3 * 0x1p-53);
    EXPECT_NEAR(lambda / (2 * (lambda + mu)), nu, 1e3 * 0x1p-53);
  }
  EXPECT_THAT([] { lame(0.0, 0.3); }, refused("young must be > 0", "got 0 Pa"));
  EXPECT_THAT([] { lame(1.0, 0.5); }, refused("poisson", "0.5 is incompressible"));
  for (const double nu : {-1.0, nan}) EXPECT_THAT([nu] { lame(1.0, nu); }, refused("poisson", "> -1"));
}

TEST(LumpedMasses, AreThatOfTheBodyInEqualParts) {
  const auto mesh =
      jetlag::box({1.0, 1.5, 0.5}, {2, 3, 1});  // cubes of 1/8 m^3 in six, each a quarter to its vertices
  const auto mass = lumped_masses(mesh.position, mesh.tetrahedra, 960.0);
  double sum = 0;
  for (const double m : mass) sum += m;
  EXPECT_NEAR(sum, 720, 720 * 72 * 0x1p-53);
  EXPECT_NEAR(mass[0], 6 * 960.0 / 8 / 6 / 4, 30 * 16 * 0x1p-53);  // at the diagonal of its cube: all six
  EXPECT_THAT([&] { lumped_masses(mesh.position, mesh.tetrahedra, -1.0); },
              refused("density", "got -1 kg/m^3"));
  EXPECT_THAT([&] { lumped_masses<4>(mesh.position, {{0, 1, 2, 99}}, 1.0); },
              refused("element 0", "no vertex 99"));
  EXPECT_THAT([&] { lumped_masses<4>(mesh.position, {{0, 1, 1, 2}}, 1.0); }, refused("element 0", "flat"));
  Coordinates<double> lost = mesh.position;
  lost(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { lumped_masses(lost, mesh.tetrahedra, 1.0); }, refused("element 0", "must be finite"));
  Coordinates<double> triangle(4, 2);
  triangle << 0, 0, 1, 0, 0, 1, 5, 5;
  EXPECT_THAT(lumped_masses<3>(triangle, {{0, 1, 2}}, 6.0, 0.5), ::testing::ElementsAre(0.5, 0.5, 0.5, 0.0));
}

/// Nothing acts in a body at rest: sums of numbers near lambda V H |d| = 3e5 Pa of edges near 1 m.
template <class L>
void expect_rest() {
  SCOPED_TRACE(L::name);
  const auto mesh = jetlag::box({1.0, 1.0, 1.0}, {2, 2, 2});
  System<> system(3, std::vector<double>(27, 1.0));
  const auto [lambda, mu] = lame(1e5, 0.3);
  system.add_at_rest<L>(mesh.tetrahedra, mesh.position, {{lambda, mu}});
  Expansion<> motion(system);
  motion.start({0.0, mesh.position, Coordinates<>::Zero(27, 3)});
  motion.grow();
  EXPECT_LT(motion.position_norm(2), 1e-12 * 1e5);
}
TEST(RestShape, IsWhereNothingActs) {
  expect_rest<Stvk>();
  expect_rest<NeoHookean>();
  expect_rest<StableNeoHookean>();
  expect_rest<PolynomialNeoHookean>();
  expect_rest<KelvinVoigt>();
}

}  // namespace
}  // namespace jetlag::testing::rest_shapes_test
