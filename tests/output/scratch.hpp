// SPDX-License-Identifier: MIT
#pragma once
// An empty folder for the time of a test, and a body to draw in it.

#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "jetlag/output/shape.hpp"

namespace jetlag {

class Scratch : public ::testing::Test {
 protected:
  Scratch() {
    std::string name = ::testing::TempDir() + "/jetlag-output-XXXXXX";
    EXPECT_NE(::mkdtemp(name.data()), nullptr);
    folder = name;
  }
  ~Scratch() override { std::filesystem::remove_all(folder); }

  /// Files and folders in the folder.
  std::size_t count() const {
    std::size_t n = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++n;
    return n;
  }

  std::filesystem::path folder;
};

inline std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// nx x ny x nz cubes of edge 0.1 m, six tetrahedra each; half of these are wound the other way.
inline Shape box(int nx, int ny, int nz, Coordinates<double>& position) {
  const auto corner = [&](int i, int j, int k) { return (i * (ny + 1) + j) * (nz + 1) + k; };
  Shape shape;
  shape.dimension = 3;
  shape.particles = (nx + 1) * (ny + 1) * (nz + 1);
  position.resize(shape.particles, 3);
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j)
      for (int k = 0; k <= nz; ++k) position.row(corner(i, j, k)) << 0.1 * i, 0.1 * j, 0.1 * k;
  // Six ways from a cube's lowest corner to its highest, along one axis after the other.
  constexpr std::array<std::array<int, 3>, 6> ways = {
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k)
        for (const auto& way : ways) {
          std::array<int, 3> at = {i, j, k};
          std::array<int, 4> tetrahedron = {corner(i, j, k)};
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[static_cast<std::size_t>(way[step])];
            tetrahedron[step + 1] = corner(at[0], at[1], at[2]);
          }
          shape.tetrahedra.push_back(tetrahedron);
        }
  shape.surface = boundary(shape.tetrahedra, position);
  return shape;
}

}  // namespace jetlag
