// SPDX-License-Identifier: MIT
// Medit's format as other programs write it: their sections, their numbers, the way they turn tetrahedra.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "scenes/meshes/numbers.hpp"
#include "support/program.hpp"

namespace jetlag::testing {
namespace {

using Json = nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

/// A corner of a cube and its opposite one: two tetrahedra that share the face 2 3 4.
const std::string head = "MeshVersionFormatted 2\nDimension 3\n",
                  vertices = "Vertices\n5\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n1 1 1 1\n",
                  tetrahedra = "Tetrahedra\n2\n1 2 3 4 1\n2 5 3 4 1\n", end = "End\n";

Mesh read(const std::string& text) {
  const TemporaryFolder folder;
  write(folder / "some.mesh", text);
  return read_medit(folder / "some.mesh");
}

/// Whether it is the mesh above, without a warning.
void expect_both(const std::string& text) {
  SCOPED_TRACE(text);
  const Mesh mesh = read(text);
  EXPECT_EQ(mesh.position, read(head + vertices + tetrahedra + end).position);
  EXPECT_EQ(mesh.tetrahedra, (std::vector<std::array<int, 4>>{{0, 1, 2, 3}, {1, 4, 2, 3}}));
  EXPECT_EQ(mesh.edges.size(), 9u);
  EXPECT_THAT(mesh.warnings, IsEmpty());
}

TEST(Medit, PassesOverSectionsWhateverTheyAreCalled) {
  for (const char* section :
       {"RequiredTriangles\n2\n1\n2\n", "Triangles\n1\n1 2 3 4\n", "NormalAtTriangleVertices 1\n1 2 3\n",
        "AngleOfCornerBound 0.5\n", "SubDomainFromMesh\n1\n3 1 1 2\n", "Empty\n0\n", "Bare\n",
        "Identifier \"written by Tetrahedra 7 # of a mesher\"\n", "Tangents\n1\n.5 -1e-3 +2.\n",
        "VerticesOnGeometricVertices\n1\n1 1\n"}) {
    expect_both(head + section + vertices + tetrahedra + end);
    expect_both(head + vertices + section + tetrahedra + end);
    expect_both(head + vertices + tetrahedra + section + end);
    expect_both(head + vertices + tetrahedra + section);
  }
}

TEST(Medit, TakesWordsInAnyCase) {
  for (const char* last : {"END\n", "end", "", "End\nof the file"})
    expect_both(head + vertices + tetrahedra + last);
  expect_both("MESHVERSIONFORMATTED 1\ndimension\n3\nVERTICES" + vertices.substr(8) + "tetrahedra" +
              tetrahedra.substr(10) + end);
}

TEST(Medit, TakesNumbersAsOtherLanguagesWriteThem) {
  for (const char* one : {"+1.0", "1.0D+00", "1d0", "1.E0", "+.1Q+01", "10.0-001", "1.0+000", "1"})
    expect_both(head + "Vertices\n5\n0 0 0 1\n" + one + " 0 0 1\n0 1 0 1\n0 0 1 1\n1 1 1 1\n" + tetrahedra);
  for (const char* none : {"1e-400", "-1.0D-99999999999999999999", "0.0D+00", "-0", "+0."})
    expect_both(head + "Vertices\n5\n0 0 0 1\n1 " + none + " 0 1\n0 1 0 1\n0 0 1 1\n1 1 1 1\n" + tetrahedra);
  expect_both(head +
              "Vertices\n5.0\n0 0 0 1.0\n1 0 0 1D0\n0 1 0 -1\n0 0 1 +7\n1 1 1 1e0\nTetrahedra\n2.\n1.0 2.0 "
              "+3 4 1.0\n2 5 3 4 99999999999999999999\n");
}

TEST(Medit, KeepsCoordinatesThatAreSubnormal) {
  EXPECT_EQ(read(head + "Vertices\n4\n0 0 0 0\n1 4.9D-324 0 0\n0 1 0 0\n0 0 1 0\nTetrahedra\n1\n1 2 3 4 0\n")
                .position(1, 1),
            std::numeric_limits<double>::denorm_min());
}

TEST(NumberOf, KnowsWhatIsTooSmallFromWhatIsTooLarge) {
  const std::string zeros(400, '0');
  for (const std::string& tiny :
       {std::string("1e-400"), "0." + zeros + "1", "1" + zeros + "e-900", std::string("0.001e-330")})
    EXPECT_EQ(number_of(tiny), 0.0) << tiny;
  for (const std::string& huge :
       {std::string("1e400"), "1" + zeros, "0." + zeros + "1e900", std::string("1e99999999999999999999")})
    EXPECT_EQ(number_of(huge), std::nullopt) << huge;
  EXPECT_EQ(number_of("0." + zeros + "1e401"), 1.0);
  EXPECT_TRUE(std::signbit(*number_of("-1e-400")));
  for (const char* none :
       {"", "+", "-", "e5", "1e", "1.5.5", "nan", "inf", "0x1p3", "1e5d5", "1,5", "++1", "+-1"})
    EXPECT_EQ(number_of(none), std::nullopt) << none;
}

TEST(WholeNumberOf, TakesAPointWhereNothingIsBehindIt) {
  EXPECT_EQ(whole_number_of("2.0"), 2);
  EXPECT_EQ(whole_number_of("+2"), 2);
  EXPECT_EQ(whole_number_of("-0.2D+01"), -2);
  EXPECT_EQ(whole_number_of("9223372036854775807"), 9223372036854775807);
  for (const char* none : {"2.5", "9007199254740994.0", "1e30", "two"})
    EXPECT_EQ(whole_number_of(none), std::nullopt);
}

TEST(Medit, TurnsNegativeTetrahedraRoundWithOneWarning) {
  const Mesh one = read(head + vertices + "Tetrahedra\n2\n1 2 3 4 1\n2 3 5 4 1\n");
  EXPECT_THAT(one.warnings, ElementsAre(AllOf(HasSubstr("some.mesh"), HasSubstr("1 of 2 tetrahedra"),
                                              HasSubstr("line 13"), HasSubstr("turned round"))));
  const Mesh all = read(head + vertices + "Tetrahedra\n2\n1 3 2 4 1\n2 3 5 4 1\n");
  EXPECT_THAT(all.warnings, ElementsAre(HasSubstr("2 of 2")));
  for (const Mesh& mesh : {one, all}) {
    for (const auto& t : mesh.tetrahedra) EXPECT_GT(six_volumes(mesh.position, t), 0);
    EXPECT_EQ(mesh.edges.size(), 9u);
  }
}

TEST(Medit, NamesVerticesThatAreInNoTetrahedron) {
  const Mesh one = read(head + vertices + "Tetrahedra\n1\n1 2 3 5 1\n");
  EXPECT_EQ(one.position.rows(), 5);
  EXPECT_THAT(one.warnings, ElementsAre(AllOf(HasSubstr("in no tetrahedron"), HasSubstr("4 (particle 3)"))));
  std::string many = "Vertices\n20\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
  for (int i = 0; i < 16; ++i) many += "2 2 2 0\n";
  EXPECT_THAT(read(head + many + "Tetrahedra\n1\n1 2 3 4 1\n").warnings,
              ElementsAre(AllOf(HasSubstr("5 (particle 4), 6 (particle 5)"),
                                HasSubstr("14 (particle 13) and 6 more"))));
}

TEST(Medit, WarnsInTheRunThatUsesIt) {
  const TemporaryFolder folder;
  write(folder / "odd.mesh", head + vertices + "Tetrahedra\n1\n1 3 2 4 1\n");
  const std::string scene =
      R"(body --set particles='{"mesh": "odd.mesh"}' --set until=0.01 --set output.frames=0)"
      " --set output.pictures=false";
  const Ended run = program("run " + scene + " --out out", folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  for (const std::string& said : {run.output, program("check " + scene, folder.path()).output})
    EXPECT_THAT(said, AllOf(HasSubstr("particles.mesh"), HasSubstr("1 of 1 tetrahedra"),
                            HasSubstr("5 (particle 4)")));
  EXPECT_EQ(Json::parse(content(folder / "out/summary.json"))["warnings"].size(), 2u);
}

TEST(Medit, ReadsNoFurtherThanALineMayBeLong) {
  const TemporaryFolder folder;
  write(folder / "long.mesh", head);
  std::filesystem::resize_file(folder / "long.mesh", std::uintmax_t{1} << 36);  // all NUL, on no disk
  EXPECT_THAT(
      [&] { read_medit(folder / "long.mesh"); },
      ThrowsMessage<SceneError>(AllOf(HasSubstr("line 3"), HasSubstr("longer than 100000 characters"))));
}

TEST(Medit, NeedsNoMemoryForALineThatIsTooLong) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "takes terabytes of addresses for itself";
#endif
  const TemporaryFolder folder;
  write(folder / "long.mesh", "");
  std::filesystem::resize_file(folder / "long.mesh", std::uintmax_t{3} << 30);
  const Ended refused = program("--version && ulimit -v 1000000 && '" JETLAG_PROGRAM
                                R"(' check body --set particles='{"mesh": "long.mesh"}' 2>&1)",
                                folder.path());
  EXPECT_EQ(refused.exit_code, 2) << refused.output;
  EXPECT_THAT(refused.output, AllOf(HasSubstr("line 1"), HasSubstr("longer than 100000 characters")));
}

TEST(Medit, SaysWhichFileCannotBeRead) {
  const TemporaryFolder folder;
  const std::string mesh = R"(check body --set particles='{"mesh": ")";
  const Ended too_long = program(mesh + std::string(300, 'a') + "\"}'", folder.path());
  EXPECT_EQ(too_long.exit_code, 2);
  EXPECT_THAT(too_long.output, AllOf(HasSubstr("particles.mesh"), HasSubstr("File name too long")));
  const Ended memory = program(mesh + "/proc/self/mem\"}'", folder.path());
  EXPECT_EQ(memory.exit_code, 2);
  EXPECT_THAT(memory.output,
              AllOf(HasSubstr("particles.mesh"), HasSubstr("/proc/self/mem"), HasSubstr("cannot be read")));
}

}  // namespace
}  // namespace jetlag::testing
