// SPDX-License-Identifier: MIT
// Wavefront's format as other programs write it.
#include <gmock/gmock.h>

#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "jetlag/scenes/scene.hpp"
#include "support/program.hpp"

namespace jetlag::testing::wavefront_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

Mesh read(const std::string& text) {
  const TemporaryFolder folder;
  write(folder / "some.obj", text);
  return read_wavefront(folder / "some.obj");
}

/// A square of two triangles.
const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 -1e-1\n";

void expect_square(const std::string& text) {
  SCOPED_TRACE(text);
  const Mesh mesh = read(text);
  EXPECT_EQ(mesh.position, (Coordinates<double>(4, 3) << 0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, -0.1).finished());
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 2}, std::array{0, 2, 3}));
  EXPECT_EQ(mesh.edges.size(), 5u);
  EXPECT_THAT(mesh.warnings, IsEmpty());
}

TEST(Wavefront, TakesFacesInAllTheirForms) {
  for (const char* faces : {"f 1 2 3\nf 1 3 4\n", "f 1 2 3 4\n", "f -4 -3 -2 -1", "f 1/7 2/8 3/9 4/9\n",
                            "f 1//1 2//1 3//1 4//1\n", "f 1/1/1 2/2/1 \\\n 3/3/1 4/4/1\n",
                            "f 1 2 3 4 # a square\n", "f 1 2 3\\\n4\n", "f 1 2 3 # c:\\\nf 1 3 4\n"})
    expect_square(corners + faces);
}

TEST(Wavefront, PassesOverEverythingElse) {
  expect_square("# made by hand\nmtllib none.mtl\no square\n" + corners +
                "vn 0 0 1\nvt 0.5 abc\ng one\ns off\nusemtl v f\nl 1 2\nf 1 2 3 4\n");
  expect_square(
      "v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0.5\nv 0 1 -1e-1\r\nf 1 2 3 4\r\n");  // weights, colours, returns
}

TEST(Wavefront, TakesAByteOrderMark) { expect_square("\xEF\xBB\xBF" + corners + "f 1 2 3 4\n"); }

/// The area of a dart of 4 m^2 is that of its triangles, whatever corner it begins with; a bow tie has none.
TEST(Wavefront, CutsPolygonsSoThatTheyAreCoveredOnce) {
  const std::string dart = "v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n";
  for (const char* face : {"f 1 2 3 4\n", "f 2 3 4 1\n", "f 3 4 1 2\n", "f 4 1 2 3\n", "f 4 3 2 1\n"}) {
    const Mesh mesh = read(dart + face);
    double twice_area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector3d x = (mesh.position.row(b) - mesh.position.row(a)).transpose(),
                            y = (mesh.position.row(c) - mesh.position.row(a)).transpose();
      twice_area += x.cross(y).norm();
    }
    EXPECT_DOUBLE_EQ(twice_area, 8) << face;
  }
  EXPECT_THAT([&] { read(corners + "f 1 2 4 3\n"); }, ThrowsMessage<SceneError>(HasSubstr("not convex")));
}

TEST(Wavefront, NamesWhatItDoesNotKnow) {
  EXPECT_THAT(read(corners + "f 1 2 3 4\nmagic 7\n").warnings,
              ElementsAre(AllOf(HasSubstr("line 6 with 'magic'"), HasSubstr("passed over"))));
}

TEST(Wavefront, WarnsOfWhatFallsApart) {
  EXPECT_THAT(read(corners + "v 9 9 9\nf 1 2 3 4\n").warnings,
              ElementsAre(AllOf(HasSubstr("1 vertex is in no face"), HasSubstr("5 (particle 4)"))));
  EXPECT_THAT(read(corners + "v 1 0 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 5 6 7\n").warnings,
              ElementsAre(AllOf(HasSubstr("1 vertices are where another one is"), HasSubstr("comes apart"))));
}

TEST(Wavefront, RefusesWhatIsNoSurfaceWithItsLine) {
  for (const auto& [text, line, says] :
       {std::tuple{corners + "f 1 2\n", "line 5", "at least three vertices"},
        {corners + "f 1 2 5\n", "line 5", "got '5'"},
        {corners + "f 0 1 2\n", "line 5", "got '0'"},
        {corners + "f -5 1 2\n", "line 5", "got '-5'"},
        {corners + "f 1 2 x\n", "line 5", "got 'x'"},
        {corners + "f 1 2 1\n", "line 5", "vertex 1 twice"},
        {corners + "f 1 2 3\nf 3 1 2\n", "line 6", "two faces have the vertices 1, 2 and 3"},
        {std::string("v 1 abc 2\n"), "line 1", "got 'abc' for a coordinate"},
        {std::string("v 1 nan 2\n"), "line 1", "got 'nan'"},
        {std::string("v 1 2\n"), "line 1", "three coordinates"},
        {corners, "line 4", "there are no faces"},
        {std::string("f 1 2 3\n"), "line 1", "got '1'"},
        {std::string(), "line 0", "there are no vertices"}}) {
    const std::string& given = text;
    EXPECT_THAT([&] { read(given); },
                ThrowsMessage<SceneError>(AllOf(HasSubstr("some.obj"), HasSubstr(line), HasSubstr(says))))
        << given;
  }
}

TEST(Wavefront, IsAMeshOfClothInScenes) {
  const TemporaryFolder folder;
  write(folder / "shirt.OBJ", corners + "f 1 2 3 4\n");
  const Scene scene = read_scene(
      R"({"particles": {"mesh": "shirt.OBJ", "density": 1000, "thickness": 0.001},
          "forces": [{"type": "membrane", "young": 1e5, "poisson": 0.3, "thickness": 0.001}],
          "integrator": {"type": "taylor", "degree": 4}, "control": {"type": "fixed", "step": 1e-3}, "until": 0.01})",
      "test", folder.path());
  EXPECT_EQ(scene.system->elements()[0].count(), 2u);
  EXPECT_EQ(scene.shape.surface.size(), 2u);
}

}  // namespace
}  // namespace jetlag::testing::wavefront_test
