// SPDX-License-Identifier: MIT
// Solids in scenes: their elements are those that the library makes of the same numbers, and what cannot be is refused.
#include <gmock/gmock.h>

#include "jetlag/forces/forces.hpp"
#include "jetlag/forces/solids/lame.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/model/lumped_mass.hpp"
#include "jetlag/runs/run_scene.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "jetlag/scenes/scene.hpp"
#include "scenes/solid_scenes.hpp"

namespace jetlag::testing::solids_in_scenes_test {
namespace {

using solid_scenes::Json, solid_scenes::scene, solid_scenes::rubber, solid_scenes::box_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Json unit_box = box_of({1, 1, 1}, {2, 2, 2}, {{"density", 960}});

template <ForceLaw L>
void expect_elements(const Elements<double>& found, const Mesh& mesh,
                     const std::vector<std::array<int, L::participants>>& cells,
                     const std::vector<std::array<double, L::material.size()>>& material) {
  System<> by_hand(static_cast<int>(mesh.position.cols()), std::vector<double>(mesh.position.rows(), 1.0));
  by_hand.add_at_rest<L>(cells, mesh.position, material);
  EXPECT_EQ(found.law.name, L::name);
  EXPECT_EQ(found.particles, by_hand.elements()[0].particles);
  EXPECT_EQ(found.parameters, by_hand.elements()[0].parameters);
}

template <ForceLaw L>
void expect_solid(const Json& force) {
  SCOPED_TRACE(force.dump());
  const Mesh mesh = box({1, 1, 1}, {2, 2, 2});
  const auto [lambda, mu] = lame(1e5, 0.3);
  const Scene read = scene(unit_box, {force});
  ASSERT_EQ(read.system->elements().size(), 1u);
  expect_elements<L>(read.system->elements()[0], mesh, mesh.tetrahedra, {{lambda, mu}});
}

TEST(SolidsInScenes, AreThoseOfTheLibrary) {
  expect_solid<NeoHookean>(rubber("neo_hookean"));
  expect_solid<StableNeoHookean>(rubber("stable_neo_hookean"));
  expect_solid<PolynomialNeoHookean>(rubber("stable_neo_hookean", {{"barrier", false}}));
  expect_solid<Stvk>(rubber("stvk"));
  expect_solid<Corotated>(rubber("corotated"));
  const auto [lambda, mu] = lame(1e5, 0.3);
  expect_solid<Stvk>({{"type", "stvk"}, {"lame", {lambda, mu}}});
}

template <ForceLaw L>
void expect_plane_solid(const Json& force, const Lame<double>& of) {
  SCOPED_TRACE(force.dump());
  const Mesh mesh = rectangle({2, 1}, {4, 2});
  const Scene read = scene(box_of({2, 1}, {4, 2}), {force}, 2);
  ASSERT_EQ(read.system->elements().size(), 1u);
  expect_elements<L>(read.system->elements()[0], mesh, mesh.triangles, {{of.lambda, of.mu, 0.01}});
  EXPECT_EQ(read.shape.surface, mesh.triangles);
}

TEST(SolidsInScenes, LieInThePlaneAsStrainOrStress) {
  const Lame<double> of = lame(1e5, 0.3);
  const Json thin = {{"thickness", 0.01}};
  expect_plane_solid<PlaneNeoHookean>(rubber("neo_hookean", thin), of);
  expect_plane_solid<PlaneStableNeoHookean>(rubber("stable_neo_hookean", thin), of);
  expect_plane_solid<PlanePolynomialNeoHookean>(
      rubber("stable_neo_hookean", {{"thickness", 0.01}, {"barrier", false}}), of);
  expect_plane_solid<PlaneStvk>(rubber("stvk", thin), of);
  expect_plane_solid<PlaneCorotated>(rubber("corotated", thin), of);
  expect_plane_solid<PlaneStvk>(rubber("stvk", {{"thickness", 0.01}, {"plane", "stress"}}), plane_stress(of));
}

TEST(SolidsInScenes, HaveViscosityBesideThem) {
  const Mesh mesh = box({1, 1, 1}, {2, 2, 2});
  const auto [lambda, mu] = lame(1e5, 0.3);
  const Scene damped = scene(unit_box, {rubber("stvk", {{"damping_time", 0.002}})});
  ASSERT_EQ(damped.system->elements().size(), 2u);
  expect_elements<KelvinVoigt>(damped.system->elements()[1], mesh, mesh.tetrahedra,
                               {{0.002 * lambda, 0.002 * mu}});
  const Scene given = scene(unit_box, {rubber("stvk", {{"viscosity", {{"bulk_like", 3}, {"shear", 2}}}})});
  expect_elements<KelvinVoigt>(given.system->elements()[1], mesh, mesh.tetrahedra, {{3.0, 2.0}});
}

TEST(SolidsInScenes, HaveMassesByDensity) {
  const Mesh mesh = box({1, 1, 1}, {2, 2, 2});
  EXPECT_EQ(scene(unit_box, {}).system->mass(), lumped_masses(mesh.position, mesh.tetrahedra, 960.0));
  const Mesh plane = rectangle({2, 1}, {4, 2});
  EXPECT_EQ(scene(box_of({2, 1}, {4, 2}, {{"density", 960}, {"thickness", 0.1}}), {}, 2).system->mass(),
            lumped_masses(plane.position, plane.triangles, 960.0, 0.1));
}

TEST(SolidsInScenes, AreChosenByPlace) {  // each element is inside or outside, by its middle
  const Json core = {{0.4, -1, -1}, {2, 2, 2}};
  const Scene read = scene(unit_box, {rubber("stvk", {{"elements", {{"inside", core}}}, {"young", 1e7}}),
                                      rubber("stvk", {{"elements", {{"outside", core}}}})});
  const Mesh mesh = box({1, 1, 1}, {2, 2, 2});
  std::vector<std::array<int, 4>> inside, outside;
  for (const auto& t : mesh.tetrahedra) {
    double middle = 0;
    for (const int i : t) middle += mesh.position(i, 0) / 4;
    (middle > 0.4 ? inside : outside).push_back(t);
  }
  ASSERT_FALSE(inside.empty() || outside.empty());
  const auto hard = lame(1e7, 0.3), soft = lame(1e5, 0.3);
  expect_elements<Stvk>(read.system->elements()[0], mesh, inside, {{hard.lambda, hard.mu}});
  expect_elements<Stvk>(read.system->elements()[1], mesh, outside, {{soft.lambda, soft.mu}});
}

TEST(SolidsInScenes, MayBeListed) {
  const Json positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const Json cells = {{0, 1, 2, 3}, {4, 2, 1, 3}};
  const Scene by_force = scene({{"position", positions}}, {rubber("stvk", {{"elements", cells}})});
  const Scene by_mesh =
      scene({{"position", positions}, {"tetrahedra", cells}, {"density", 24}}, {rubber("stvk")});
  EXPECT_EQ(by_force.system->elements()[0].parameters, by_mesh.system->elements()[0].parameters);
  EXPECT_EQ(by_force.shape.tetrahedra, by_mesh.shape.tetrahedra);
  EXPECT_EQ(by_force.shape.surface, by_mesh.shape.surface);
  EXPECT_EQ(by_force.shape.surface.size(), 6u);
  EXPECT_THAT(by_mesh.system->mass(), ElementsAre(1, 3, 3, 3, 2));  // V = 1/6 and 1/3, a quarter to each
}

/// A cube that begins squeezed to half its height: nothing but its energy at rest, V (lambda/8 (H:e)^2 + mu/4 tr (H e)^2)
/// with one strain e = 1/4 - 1.
TEST(SolidsInScenes, MayRestElsewhere) {
  Json rest = Json::array(), squeezed = Json::array();
  const Mesh mesh = box({1, 1, 1}, {1, 1, 1});
  for (const auto& x : mesh.position.rowwise()) {
    rest.push_back({x[0], x[1], x[2]});
    squeezed.push_back({x[0], x[1] / 2, x[2]});
  }
  const Scene read =
      scene({{"position", squeezed}, {"rest", rest}, {"tetrahedra", mesh.tetrahedra}, {"density", 1}},
            {{{"type", "stvk"}, {"lame", {3, 2}}}});
  const double e = 0.25 - 1;
  EXPECT_NEAR(EnergyMeter(*read.system)(read.initial).total(), (3.0 / 8 + 2.0 / 4) * e * e, 1e-14);
  EXPECT_NEAR(read.system->mass()[0], 6.0 / 6 / 4, 1e-15);  // of the volume at rest
}

Coordinates<double> forces_at_start(const Scene& read) {
  const RunResult result = run_scene(read);
  return (result.summary.velocity - read.initial.velocity) / result.summary.time;
}

TEST(LoadsInScenes, GoOverTheFacesThatAreChosen) {
  // A dead load on the end of a bar: t A in all, in equal parts of each face's area.
  const Json end = {{"inside", {{0.99, 0, 0}, {1.01, 1, 1}}}};
  const Scene pulled = scene(unit_box, {{{"type", "traction"}, {"faces", end}, {"stress", {3, 0, -2}}}});
  const auto& parameters = pulled.system->elements()[0].parameters;
  double x = 0, y = 0, z = 0;
  for (std::size_t n = 0; n < parameters.size(); n += 3) {
    x += 3 * parameters[n];
    y += 3 * parameters[n + 1];
    z += 3 * parameters[n + 2];
  }
  EXPECT_NEAR(x, 3, 1e-15 * 24);
  EXPECT_EQ(y, 0);
  EXPECT_NEAR(z, -2, 1e-15 * 24);
  // Pressure from outside on a closed surface: nothing moves as a whole, each face is pushed in.
  const Scene squeezed = scene(unit_box, {{{"type", "pressure"}, {"pressure", 1000}}});
  EXPECT_THAT(squeezed.warnings, ElementsAre(HasSubstr("what the pressure works is missing")));
  const auto push = forces_at_start(squeezed);
  const Eigen::Map<const Eigen::VectorXd> mass(squeezed.system->mass().data(), 27);
  EXPECT_LT((mass.transpose() * push).norm(), 1e-12 * 6000);
  EXPECT_GT(push(0, 0), 0);   // the lowest corner
  EXPECT_LT(push(26, 0), 0);  // the highest
  const Scene open = scene(unit_box, {{{"type", "pressure"}, {"faces", end}, {"pressure", 1000}}});
  EXPECT_THAT(open.warnings, ElementsAre(AllOf(HasSubstr("forces[0].faces"), HasSubstr("open"))));
  EXPECT_LT(forces_at_start(open)(26, 0), 0);  // turned as seen from outside
}

TEST(LoadsInScenes, OfListedFacesAreTurnedOutwards) {
  const Scene boundary = scene(unit_box, {{{"type", "pressure"}, {"pressure", 1}}});
  const auto& all = boundary.system->elements()[0].particles;
  Json faces = Json::array();
  for (std::size_t n = 0; n < all.size(); n += 3)
    faces.push_back({all[n + 1], all[n], all[n + 2]});  // inwards
  const Scene listed = scene(unit_box, {{{"type", "pressure"}, {"faces", faces}, {"pressure", 1}}});
  EXPECT_EQ(listed.system->elements()[0].particles, all);
}

TEST(SpinInScenes, TurnsAboutTheCentreOfMass) {
  const Scene read =
      scene(box_of({1, 2, 3}, {1, 2, 1},
                   {{"density", 1}, {"velocity", {{"spin", {0, 0, 2}}, {"drift", {1, 0, 0}}}}}),
            {});
  // v = (1, 0, 0) + (0, 0, 2) x (x - (1/2, 1, 3/2)); at the lowest corner (0, 0, 0): (1 + 2, -1, 0).
  EXPECT_EQ(Eigen::RowVector3d(read.initial.velocity.row(0)), Eigen::RowVector3d(3, -1, 0));
  const Eigen::VectorXd p = momentum(*read.system, read.initial);
  EXPECT_NEAR(p[0], 6, 1e-14);  // mass times drift
  EXPECT_NEAR(p[1], 0, 1e-14);
  const Scene plane = scene(box_of({1, 1}, {1, 1}, {{"velocity", {{"spin", 3}, {"about", {0, 0}}}}}), {}, 2);
  EXPECT_EQ(Eigen::RowVector2d(plane.initial.velocity.row(3)), Eigen::RowVector2d(-3, 3));
}

TEST(DragInScenes, MayBeARate) {
  const Json particles = {{"position", {{0, 0, 0}, {1, 0, 0}}}, {"mass", {2, 5}}};
  EXPECT_EQ(
      scene(particles, {{{"type", "drag"}, {"rate", 0.5}}}).system->elements()[0].parameters,
      scene(particles, {{{"type", "drag"}, {"coefficient", {1.0, 2.5}}}}).system->elements()[0].parameters);
}

TEST(FixedEnds, LieAlongTheirAxis) {
  const Scene read = scene(box_of({1, 1, 1}, {1, 1, 1}, {{"fix_axis", "x"}, {"fix_below", 0}}), {});
  for (int i = 0; i < 8; ++i) EXPECT_EQ(read.system->fixed()[i], read.initial.position(i, 0) == 0) << i;
}

/// As the shear goes to zero, so does what is left of viscosity in plane stress: 2 lambda mu / (lambda + 2 mu).
TEST(SolidsInScenes, HaveNoViscosityInPlaneStressWithoutShear) {
  const Scene none =
      scene(box_of({2, 1}, {4, 2}),
            {rubber("stvk", {{"plane", "stress"}, {"viscosity", {{"bulk_like", 10}, {"shear", 0}}}})}, 2);
  EXPECT_EQ(none.system->elements().size(), 1u);
}

TEST(SolidsInScenes, TakeTheThicknessOfTheirMass) {
  const Json of_mass = box_of({2, 1}, {4, 2}, {{"density", 960}, {"thickness", 0.1}});
  EXPECT_EQ(scene(of_mass, {rubber("stvk")}, 2).system->elements()[0].parameters,
            scene(of_mass, {rubber("stvk", {{"thickness", 0.1}})}, 2).system->elements()[0].parameters);
  EXPECT_THAT(scene(of_mass, {rubber("stvk", {{"thickness", 0.2}})}, 2).warnings,
              ElementsAre(AllOf(HasSubstr("forces[0].thickness: 0.2 m"), HasSubstr("0.1 m"))));
}

TEST(SolidsInScenes, AddTheMassesOfBodiesAndSheets) {
  const Scene read = scene({{"position", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                            {"tetrahedra", {{0, 1, 2, 3}}},
                            {"triangles", {{0, 1, 2}}},
                            {"density", 24},
                            {"thickness", 0.5}},
                           {});
  EXPECT_THAT(read.system->mass(), ElementsAre(3, 3, 3, 1));  // 24/6/4 each, and 24/2 * 0.5 / 3
  EXPECT_EQ(read.shape.surface.size(), 5u);
}

TEST(GustsInScenes, AreTooFastForLongSteps) {
  const auto swings = [](double frequency) {
    return scene({{"position", {{0, 0, 0}}}},
                 {{{"type", "oscillating_field"}, {"acceleration", {0, 0, 1}}, {"frequency", frequency}}})
        .warnings;
  };
  EXPECT_THAT(swings(100), IsEmpty());  // steps of 1e-3 s
  EXPECT_THAT(swings(200), ElementsAre(AllOf(HasSubstr("control.step: 0.001 s"), HasSubstr("200 1/s"))));
}

TEST(SolidsInScenes, WarnOfWhatIsNotWhatWasMeant) {
  EXPECT_THAT(scene(unit_box, {rubber("stvk")}).warnings, IsEmpty());
  EXPECT_THAT(scene(unit_box, {rubber("stvk", {{"poisson", 0.49}})}).warnings,
              ElementsAre(AllOf(HasSubstr("forces[0].poisson"), HasSubstr("lock"))));
  // A needle among three good ones: h = 1e-6 of its edges.
  const Json positions = {{0, 0, 0}, {1, 0, 0},  {0, 1, 0},        {0, 0, 1},
                          {1, 1, 1}, {0, 0, -1}, {0.3, 0.3, -1e-6}};
  const Json cells = {{0, 1, 2, 3}, {4, 2, 1, 3}, {0, 2, 1, 5}, {0, 2, 1, 6}};
  EXPECT_THAT(scene({{"position", positions}, {"tetrahedra", cells}}, {rubber("stvk")}).warnings,
              ElementsAre(AllOf(HasSubstr("forces[0].elements, number 3"), HasSubstr("a sliver"))));
}

TEST(SolidsInScenes, AreInTheSummary) {
  const Scene read =
      scene(unit_box, {rubber("stvk", {{"elements", {{"inside", {{0, 0, 0}, {1, 1, 0.5}}}}}})});
  const auto elements = run_scene(read).summary.elements;
  ASSERT_EQ(elements.size(), 1u);
  EXPECT_EQ(elements[0].law, "stvk");
  EXPECT_EQ(elements[0].count, 24u);
  EXPECT_NEAR(elements[0].volume, 0.5, 1e-15);
  EXPECT_NEAR(elements[0].min_j, 1, 1e-14);
  EXPECT_THAT(run_scene(scene(unit_box, {})).summary.elements, IsEmpty());
}

}  // namespace
}  // namespace jetlag::testing::solids_in_scenes_test
