// SPDX-License-Identifier: MIT
#include "jetlag/pictures/pictures.hpp"

#include <gmock/gmock.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <cstdlib>
#include <set>

#include "jetlag/output/energy_table.hpp"
#include "jetlag/output/files.hpp"
#include "output/scratch.hpp"

namespace jetlag::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Tree = boost::property_tree::ptree;

/// What an SVG consists of. Throws when it is not XML.
struct Drawing {
  explicit Drawing(const fs::path& path) {
    Tree tree;
    boost::property_tree::read_xml(path.string(), tree);
    visit(tree.get_child("svg"));
  }
  void visit(const Tree& tree) {
    for (const auto& [name, part] : tree) {
      if (name == "polygon") ++polygons, fills.insert(part.get<std::string>("<xmlattr>.fill"));
      if (name == "path") strokes.insert(part.get<std::string>("<xmlattr>.stroke", "none"));
      if (name == "text") texts += part.data() + "\n";
      visit(part);
    }
  }
  std::size_t polygons = 0;
  std::set<std::string> fills, strokes;  // colours
  std::string texts;
};

/// A variable of the environment for the time of a test.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before, there_ = true;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() { there_ ? ::setenv(name_, before_.c_str(), 1) : ::unsetenv(name_); }

 private:
  const char* name_;
  std::string before_;
  bool there_ = false;
};

/// Stands on the floor and bends to the right, faster and faster.
struct Tower {
  Tower() : shape(box(2, 6, 2, position)) {
    for (int i = 0; i < shape.particles; ++i)
      if (position(i, 1) == 0.0) shape.fixed.push_back(i);
    for (int f = 0; f < 20; ++f) {
      Frame frame{0.05 * f, position, 0.0 * position};
      frame.position.col(0) += 0.03 * f * position.col(1).cwiseAbs2();
      frame.velocity.col(0) = 0.6 * f * position.col(1).cwiseAbs2();
      frames.push_back(frame);
    }
  }
  Coordinates<double> position;
  Shape shape;
  std::vector<Frame> frames;
};

/// Particles on a turning ring; next neighbours may be connected.
struct Ring {
  Ring(int dimension, int particles, bool springs) {
    shape.dimension = dimension;
    shape.particles = particles;
    for (int i = 0; springs && i < particles; ++i) shape.lines.push_back({i, (i + 1) % particles});
    for (int f = 0; f < 30; ++f) {
      Frame frame{0.1 * f, Coordinates<double>::Zero(particles, dimension), {}};
      frame.velocity = frame.position;
      for (int i = 0; i < particles; ++i) {
        const double angle = 0.1 * f + 2 * M_PI * i / particles,
                     radius = 1.0 + 0.02 * f * std::sin(3 * angle);
        frame.position(i, 0) = radius * std::cos(angle);
        if (dimension > 1) frame.position(i, 1) = radius * std::sin(angle);
        frame.velocity(i, 0) = 0.1 * i;
      }
      frames.push_back(frame);
    }
  }
  Shape shape;
  std::vector<Frame> frames;
};

class Pictures : public Scratch {
 protected:
  void SetUp() override {
    if (!can_draw()) GTEST_SKIP() << "gnuplot is not in PATH";
  }

  Drawing film(const Shape& shape, const std::vector<Frame>& frames,
               const std::string& title = "title") const {
    draw_film(folder / "film.svg", shape, frames, title);
    return Drawing(folder / "film.svg");
  }

  fs::path energy_table(double error) const {
    std::vector<EnergyRow> rows;
    for (int i = 0; i < 50; ++i)
      rows.push_back({0.1 * i, {std::cos(0.1 * i), -std::cos(0.1 * i)}, error * i});
    write_energy_csv(folder / "energy.csv", rows);
    return folder / "energy.csv";
  }
};

TEST_F(Pictures, OfASceneWithAnotherWayUpAreThoseOfTheTurnedScene) {
  const Tower tower;
  const auto picture = [&](const Shape& shape, const std::vector<Frame>& frames) {
    film(shape, frames);
    return content(folder / "film.svg");
  };
  for (const bool springs : {false, true}) {
    Shape shape = tower.shape;
    if (springs) shape.surface.clear(), shape.lines = {{0, 1}, {1, 2}, {3, 20}};
    const std::string upright = picture(shape, tower.frames);
    std::vector<Frame> turned = tower.frames;  // y becomes z, and z becomes -y: exact
    for (Frame& frame : turned)
      for (auto* rows : {&frame.position, &frame.velocity}) {
        rows->col(1).swap(rows->col(2));
        rows->col(1) *= -1;
      }
    EXPECT_NE(picture(shape, turned), upright);
    shape.up = {0, 0, 1};
    EXPECT_EQ(picture(shape, turned), upright);
  }
}

TEST_F(Pictures, AreFilesOfTheirKind) {
  const Tower tower;
  draw_film(folder / "film.png", tower.shape, tower.frames, "tower");
  const std::string png = content(folder / "film.png");
  EXPECT_TRUE(png.starts_with("\x89PNG\r\n\x1a\n"));
  EXPECT_EQ(png.substr(16, 4), std::string("\0\0\x06\x40", 4)) << "1600 pixels wide";
  EXPECT_GT(png.size(), 30000) << "an empty sheet of this size has some 8000 bytes";
  EXPECT_THROW(draw_film(folder / "film.jpg", tower.shape, tower.frames, "tower"), std::invalid_argument);
  EXPECT_EQ(count(), 1);
}

TEST_F(Pictures, OfASolidShowLitTrianglesOfManyColours) {
  const Tower tower;
  const Drawing drawing = film(tower.shape, tower.frames, "tower");
  // 8 snapshots; of 2 x 56 triangles some 40 % are seen, each drawn twice, and all cast a shadow.
  EXPECT_GT(drawing.polygons, 8 * (112 + 80));
  EXPECT_GT(drawing.fills.size(), 120 + 200) << "120 of them are in the legend";
  for (const char* text : {"tower\n", "\n0 s\n", "\n0.95 s\n", "speed\n", "m/s\n"})
    EXPECT_THAT(drawing.texts, HasSubstr(text));
}

TEST_F(Pictures, OfSpringsShowTheirStrain) {
  const Ring ring(2, 40, true);
  const Drawing drawing = film(ring.shape, ring.frames);
  EXPECT_GT(drawing.strokes.size(), 50);
  EXPECT_THAT(drawing.texts, HasSubstr("strain"));
}

TEST_F(Pictures, OfAFewBodiesShowFadingOrbits) {
  const Ring ring(3, 3, false);
  const Drawing drawing = film(ring.shape, ring.frames);
  EXPECT_EQ(drawing.polygons, 2 * 3) << "a dot with a rim for each body";
  EXPECT_GT(drawing.strokes.size(), 100);
}

TEST_F(Pictures, ShowObstaclesByTheirEdgesOnly) {
  Ring ring(3, 6, false);
  ring.shape.obstacles = 3;
  const std::size_t without = film(ring.shape, ring.frames).strokes.size();
  ring.shape.walls = {{3, 4}, {4, 5}};
  const Drawing drawing = film(ring.shape, ring.frames);
  EXPECT_EQ(drawing.polygons, 2 * 3) << "no dots of their vertices";
  EXPECT_EQ(drawing.strokes.size(), without + 1);
  ring.shape.surface = {{3, 4, 5}};  // a surface of obstacles alone is no body
  EXPECT_EQ(film(ring.shape, ring.frames).polygons, 2 * 3);
}

TEST_F(Pictures, OfASolidShowObstaclesInOneColour) {
  Tower tower;
  const std::size_t all = film(tower.shape, tower.frames).fills.size();
  tower.shape.obstacles = tower.shape.particles - 1;  // all but a few triangles
  EXPECT_LT(film(tower.shape, tower.frames).fills.size(), all - 100);
}

TEST_F(Pictures, OfManyParticlesShowTheirSpeed) {
  const Ring ring(2, 100, false);
  const Drawing drawing = film(ring.shape, ring.frames);
  EXPECT_GT(drawing.polygons, 8 * 2 * 100);
  EXPECT_GT(drawing.fills.size(), 120 + 100) << "120 of them are in the legend";
  EXPECT_THAT(drawing.texts, HasSubstr("speed"));
}

TEST_F(Pictures, OnALineShowPositionsAgainstTime) {
  const Ring ring(1, 20, true);
  const Drawing drawing = film(ring.shape, ring.frames);
  EXPECT_GT(drawing.strokes.size(), 20);
  EXPECT_THAT(drawing.texts, HasSubstr("position [m]"));
}

TEST_F(Pictures, OfEnergyShowItsPartsAndItsError) {
  draw_energy(energy_table(1e-9), folder / "energy.svg", "energy");
  const Drawing drawing(folder / "energy.svg");
  for (const char* text : {"kinetic", "potential", "total", "relative error", "time [s]", "energy\n"})
    EXPECT_THAT(drawing.texts, HasSubstr(text));
}

TEST_F(Pictures, OfEnergyDoWithoutAnErrorThatIsNotDefined) {
  draw_energy(energy_table(std::nan("")), folder / "energy.svg", "energy");
  EXPECT_THAT(Drawing(folder / "energy.svg").texts, HasSubstr("time [s]"));
  draw_energy(energy_table(0.0), folder / "energy.svg", "energy");
  EXPECT_THROW(draw_energy(folder / "lost.csv", folder / "energy.svg", ""), std::runtime_error);
}

TEST_F(Pictures, ExistForTheSmallestScenes) {
  for (const int dimension : {1, 2, 3}) {
    Shape shape;
    shape.dimension = dimension;
    shape.particles = 1;
    const Frame still{0.0, Coordinates<double>::Zero(1, dimension), Coordinates<double>::Zero(1, dimension)};
    film(shape, {still});
    film(shape, {still, still});
    shape.fixed = {0};
    film(shape, {still});
    EXPECT_THROW(film(shape, {}), std::invalid_argument);
  }
  Shape spring{
      .dimension = 2, .particles = 2, .lines = {{0, 1}}, .surface = {}, .tetrahedra = {}, .fixed = {}};
  film(spring, {{0.0, Coordinates<double>::Zero(2, 2), Coordinates<double>::Zero(2, 2)}});
}

TEST_F(Pictures, TakeTitlesAsTheyAre) {
  const Ring ring(2, 3, false);
  const std::string title = "it's `touch trap` $(touch trap) {/:Bold @x}_2 <b> & \"c\" \\";
  EXPECT_THAT(film(ring.shape, ring.frames, title + "\nset print 'trap'\n").texts,
              HasSubstr(title + " set print 'trap'"));
  draw_energy(energy_table(1e-9), folder / "energy.svg", title);
  EXPECT_THAT(Drawing(folder / "energy.svg").texts, HasSubstr(title));
  EXPECT_FALSE(fs::exists("trap"));
}

TEST_F(Pictures, LeaveNoTemporaryFiles) {
  fs::create_directory(folder / "tmp");
  const Variable temporary("TMPDIR", (folder / "tmp").string());
  const Ring ring(2, 3, false);
  film(ring.shape, ring.frames);
  EXPECT_TRUE(fs::is_empty(folder / "tmp"));
  EXPECT_EQ(count(), 2);
}

TEST_F(Pictures, ReportWhatGnuplotSaysAndKeepTheOldPicture) {
  for (const char* name : {"tmp", "bin"}) fs::create_directory(folder / name);
  write_file(folder / "bin/gnuplot", "#!/bin/sh\necho out of ink >&2\nexit 1\n");
  write_file(folder / "film.svg", "old");
  fs::permissions(folder / "bin/gnuplot", fs::perms::owner_all);
  const Variable temporary("TMPDIR", (folder / "tmp").string()), path("PATH", (folder / "bin").string());
  const Ring ring(2, 3, false);
  try {
    film(ring.shape, ring.frames);
    FAIL() << "gnuplot failed, draw_film did not";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("out of ink"));
  }
  EXPECT_EQ(content(folder / "film.svg"), "old");
  EXPECT_TRUE(fs::is_empty(folder / "tmp"));
}

TEST(PicturesWithoutGnuplot, AreRefused) {
  const Variable path("PATH", "/nowhere");
  EXPECT_FALSE(can_draw());
  const Ring ring(2, 3, false);
  EXPECT_THROW(draw_film(::testing::TempDir() + "/film.svg", ring.shape, ring.frames, ""),
               std::runtime_error);
}

}  // namespace
}  // namespace jetlag::testing
