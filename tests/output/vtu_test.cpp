// SPDX-License-Identifier: MIT
#include "jetlag/output/vtu.hpp"

#include <gmock/gmock.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <limits>
#include <map>

#include "output/scratch.hpp"

namespace jetlag::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::SizeIs;
using Tree = boost::property_tree::ptree;

/// The arrays of a file by their names, and how many points and cells it declares. Throws when it is not XML.
struct Grid {
  explicit Grid(const std::filesystem::path& path) {
    Tree tree;
    boost::property_tree::read_xml(path.string(), tree);
    EXPECT_EQ(tree.get<std::string>("VTKFile.<xmlattr>.type"), "UnstructuredGrid");
    const Tree& grid = tree.get_child("VTKFile.UnstructuredGrid");
    collect(grid.get_child("FieldData"));
    const Tree& piece = grid.get_child("Piece");
    points = piece.get<std::size_t>("<xmlattr>.NumberOfPoints");
    cells = piece.get<std::size_t>("<xmlattr>.NumberOfCells");
    for (const char* part : {"Points", "Cells", "PointData"}) collect(piece.get_child(part));
  }

  void collect(const Tree& part) {
    for (const auto& [name, array] : part) {
      if (name != "DataArray") continue;
      EXPECT_EQ(array.get<std::string>("<xmlattr>.format"), "ascii");
      std::istringstream text(array.data());
      auto& values = arrays[array.get<std::string>("<xmlattr>.Name")];
      for (std::string word; text >> word;) values.push_back(std::strtod(word.c_str(), nullptr));
    }
  }

  std::size_t points, cells;
  std::map<std::string, std::vector<double>> arrays;
};

class Vtu : public Scratch {
 protected:
  Grid written(const Shape& shape, const Frame& frame) const {
    write_vtu(folder / "frame.vtu", shape, frame);
    return Grid(folder / "frame.vtu");
  }

  /// A triangle of springs in the plane, with numbers that need all their digits.
  Vtu() {
    plane.dimension = 2;
    plane.particles = 3;
    plane.lines = {{0, 1}, {1, 2}, {2, 0}};
    plane.fixed = {2};
    frame.time = 1.0 / 3.0;
    frame.position.resize(3, 2);
    frame.position << 1.0 / 3.0, -0.1, 5e-324, 1.7976931348623157e308, 0.1 + 0.2, 1e-7;
    frame.velocity = -frame.position;
  }
  Shape plane;
  Frame frame;
};

TEST_F(Vtu, ShowsTheClocksOfTheParticlesWhereTheyAreKnown) {
  EXPECT_EQ(written(plane, frame).arrays.count("step"), 0u);
  frame.step = {0.1, 1.0 / 3.0, 0.0};
  frame.degree = {3, 6, 0};
  const Grid grid = written(plane, frame);
  EXPECT_THAT(grid.arrays.at("step"), ElementsAre(0.1, 1.0 / 3.0, 0.0));
  EXPECT_THAT(grid.arrays.at("degree"), ElementsAre(3, 6, 0));
}

TEST_F(Vtu, ShowsWhatContactsDoWhereThereAreAny) {
  EXPECT_EQ(written(plane, frame).arrays.count("gap"), 0u);
  frame.gap = {0.1, std::numeric_limits<double>::infinity(), 1.0 / 3.0};
  frame.contact_force = Coordinates<double>{{1, 2}, {0, 0}, {-1, -1.0 / 3.0}};
  const Grid grid = written(plane, frame);
  EXPECT_THAT(grid.arrays.at("gap"), ElementsAre(0.1, -1, 1.0 / 3.0));
  EXPECT_THAT(grid.arrays.at("contact_force"), ElementsAre(1, 2, 0, 0, 0, 0, -1, -1.0 / 3.0, 0));
}

TEST_F(Vtu, ShowsObstaclesBesideTheCells) {  // two particles and the three vertices of an obstacle
  Shape shape;
  shape.dimension = 3;
  shape.particles = 5;
  shape.obstacles = 3;
  shape.surface = {{2, 3, 4}};
  shape.walls = {{2, 3}};
  frame.position = Coordinates<double>::Zero(5, 3);
  frame.velocity = frame.position;
  const Grid loose = written(shape, frame);
  EXPECT_THAT(loose.arrays.at("types"), ElementsAre(5, 1, 1, 3));
  EXPECT_THAT(loose.arrays.at("connectivity"), ElementsAre(2, 3, 4, 0, 1, 2, 3));
  EXPECT_THAT(loose.arrays.at("offsets"), ElementsAre(3, 4, 5, 7));
  EXPECT_THAT(loose.arrays.at("fixed"), ElementsAre(0, 0, 1, 1, 1));
  shape.lines = {{0, 1}};
  EXPECT_THAT(written(shape, frame).arrays.at("types"), ElementsAre(3, 5, 3));
}

TEST_F(Vtu, KeepsEveryBitAndPadsThePlaneToSpace) {
  const Grid grid = written(plane, frame);
  EXPECT_EQ(grid.points, 3);
  EXPECT_THAT(grid.arrays.at("position"),
              ElementsAre(1.0 / 3.0, -0.1, 0.0, 5e-324, 1.7976931348623157e308, 0.0, 0.1 + 0.2, 1e-7, 0.0));
  EXPECT_THAT(grid.arrays.at("velocity"), ElementsAre(-1.0 / 3.0, 0.1, 0.0, -5e-324, -1.7976931348623157e308,
                                                      0.0, -0.1 - 0.2, -1e-7, 0.0));
  EXPECT_THAT(grid.arrays.at("TimeValue"), ElementsAre(1.0 / 3.0));
  EXPECT_THAT(grid.arrays.at("fixed"), ElementsAre(0, 0, 1));
}

TEST_F(Vtu, HasLinesForSprings) {
  const Grid grid = written(plane, frame);
  EXPECT_EQ(grid.cells, 3);
  EXPECT_THAT(grid.arrays.at("connectivity"), ElementsAre(0, 1, 1, 2, 2, 0));
  EXPECT_THAT(grid.arrays.at("offsets"), ElementsAre(2, 4, 6));
  EXPECT_THAT(grid.arrays.at("types"), ElementsAre(3, 3, 3));
}

TEST_F(Vtu, HasTrianglesForAPlateWithoutSprings) {
  plane.lines.clear();
  plane.surface = {{0, 1, 2}};
  const Grid grid = written(plane, frame);
  EXPECT_THAT(grid.arrays.at("connectivity"), ElementsAre(0, 1, 2));
  EXPECT_THAT(grid.arrays.at("types"), ElementsAre(5));
}

TEST_F(Vtu, HasVerticesForLooseParticles) {
  plane.lines.clear();
  const Grid grid = written(plane, frame);
  EXPECT_THAT(grid.arrays.at("connectivity"), ElementsAre(0, 1, 2));
  EXPECT_THAT(grid.arrays.at("types"), ElementsAre(1, 1, 1));
}

TEST_F(Vtu, HasTetrahedraForASolid) {
  const Shape solid = box(1, 2, 1, frame.position);
  frame.velocity = frame.position;
  const Grid grid = written(solid, frame);
  EXPECT_EQ(grid.points, 12);
  EXPECT_EQ(grid.cells, 12);
  EXPECT_THAT(grid.arrays.at("connectivity"), SizeIs(4 * 12));
  EXPECT_THAT(grid.arrays.at("types"), ElementsAreArray(std::vector<double>(12, 10.0)));
  EXPECT_EQ(grid.arrays.at("offsets").back(), 48);
}

TEST_F(Vtu, IsNotWrittenWithANumberThatIsNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Frame broken = frame;
    broken.velocity(1, 0) = bad;
    EXPECT_THROW(write_vtu(folder / "frame.vtu", plane, broken), std::invalid_argument);
  }
  EXPECT_EQ(count(), 0);
}

TEST_F(Vtu, IsNotWrittenForAFrameOfAnotherShape) {
  plane.lines.push_back({0, 3});
  EXPECT_THROW(write_vtu(folder / "frame.vtu", plane, frame), std::invalid_argument);
  plane.lines.clear();
  plane.particles = 4;
  EXPECT_THROW(write_vtu(folder / "frame.vtu", plane, frame), std::invalid_argument);
  EXPECT_EQ(count(), 0);
}

TEST_F(Vtu, FilmNamesEachFileAtItsTime) {
  write_pvd(folder / "run.pvd", {0.0, 0.1}, {"a.vtu", "<b> & \"c\".vtu"});
  Tree tree;
  boost::property_tree::read_xml((folder / "run.pvd").string(), tree);
  std::vector<std::pair<double, std::string>> film;
  for (const auto& [name, entry] : tree.get_child("VTKFile.Collection"))
    if (name == "DataSet")
      film.emplace_back(entry.get<double>("<xmlattr>.timestep"), entry.get<std::string>("<xmlattr>.file"));
  EXPECT_THAT(film, ElementsAre(std::pair(0.0, "a.vtu"), std::pair(0.1, "<b> & \"c\".vtu")));
  EXPECT_THROW(write_pvd(folder / "run.pvd", {0.0}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing
