// SPDX-License-Identifier: MIT
// Sheets that bend as plates do, or not: by the pattern of their triangles.
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <numbers>

#include "forces/cloth/sheets.hpp"
#include "jetlag/model/energy.hpp"

namespace jetlag::testing::plates_test {
using namespace cloth;

namespace {

using Eigen::RowVector3d;

constexpr double curvature = 1e-3;  // [1/m]

/// The energy of bending at rigidity 1, over that of the plate that the hinges cover: curvature along an angle [degrees] to
/// x. Each hinge stands for a third of its two triangles.
template <class L>
double ratio_to_plate(const Mesh& mesh, double angle) {
  const double phi = angle * std::numbers::pi / 180;
  State<double> bent{0.0, mesh.position, Coordinates<double>::Zero(mesh.position.rows(), 3)};
  for (int i = 0; i < bent.position.rows(); ++i) {
    const double along = std::cos(phi) * bent.position(i, 0) + std::sin(phi) * bent.position(i, 1);
    bent.position(i, 2) = curvature / 2 * along * along;
  }
  double covered = 0;
  for (const auto& [a, b, c, d] : hinges_of(mesh.triangles)) {
    const auto side = [&](int to) -> Eigen::Vector3d { return mesh.position.row(to) - mesh.position.row(a); };
    covered += (side(b).cross(side(c)).norm() + side(b).cross(side(d)).norm()) / 2 / 3;
  }
  const System<double> system = bending_of<L>(mesh);
  return EnergyMeter{Model<double>(system)}(bent).potential / (curvature * curvature / 2 * covered);
}

Mesh square(SheetPattern pattern) {
  return sheet({1.0, pattern == SheetPattern::equilateral ? std::sqrt(0.75) : 1.0}, {40, 40}, pattern);
}

/// Ratios are given to four digits; slopes of 1e-3 and less change the energy of hinges by their squares, 1e-6.
void expect_ratios(SheetPattern pattern, const std::vector<std::array<double, 2>>& ratio_at_angle) {
  const Mesh mesh = square(pattern);
  for (const auto& [angle, ratio] : ratio_at_angle) {
    EXPECT_NEAR(ratio_to_plate<Bending>(mesh, angle), ratio, 1e-4) << angle;
    EXPECT_NEAR(ratio_to_plate<Hinge>(mesh, angle), ratio, 1e-4) << angle;
  }
}
TEST(Plate, OfRightAngledTrianglesIsStifferByTheDirection) {
  expect_ratios(SheetPattern::crisscross,
                {{0, 0.9915}, {90, 0.9915}, {22.5, 1.2521}, {45, 1.5127}, {135, 1.5127}});
  expect_ratios(SheetPattern::uniform,
                {{0, 0.9915}, {90, 0.9915}, {22.5, 2.2011}, {45, 3.0000}, {135, 1.0169}});
}
TEST(Plate, OfEquilateralTrianglesIsThatOfTheory) {
  const Mesh mesh = square(SheetPattern::equilateral);
  // But for what is missing at the borders, of 1/40 of the sheet.
  for (const double angle : {0.0, 22.5, 45.0, 67.5, 90.0, 135.0}) {
    EXPECT_NEAR(ratio_to_plate<Bending>(mesh, angle), 1, 0.0085) << angle;
    EXPECT_NEAR(ratio_to_plate<Hinge>(mesh, angle), 1, 0.0085) << angle;
  }
}

/// A strip clamped by the vertices at x <= clamped, under a load of 1 Pa across, of rigidity 1: how far its end at x >= 1 is
/// bent [m], as the mean of its vertices. The stiffness is minus the forces of each hinge at displacements of 1 m.
double tip(const Mesh& mesh, double clamped) {
  const int n = static_cast<int>(mesh.position.rows());
  const System<double> system = bending_of<Bending>(mesh);
  std::vector<int> unknown(n, -1);
  int unknowns = 0;
  for (int i = 0; i < n; ++i)
    if (mesh.position(i, 0) > clamped + 1e-9) unknown[i] = unknowns++;
  std::vector<Eigen::Triplet<double>> entries;
  const Elements<double>& hinges = system.elements()[0];
  for (std::size_t e = 0; e < hinges.count(); ++e) {
    const int* at = &hinges.particles[4 * e];
    const double* c = &hinges.parameters[3 * e];
    for (int j = 0; j < 4; ++j) {
      Participants<double, 3, 4> bent;
      for (auto& x : bent.position) x.setZero();
      bent.position[j][2] = 1;
      const auto force = Bending::forces(bent, c[0], c[1], c[2]);
      const std::array across{force[0][2], force[1][2], force[2][2], -(force[0] + force[1] + force[2])[2]};
      for (int i = 0; i < 4; ++i)
        if (unknown[at[i]] >= 0 && unknown[at[j]] >= 0)
          entries.emplace_back(unknown[at[i]], unknown[at[j]], -across[i]);
    }
  }
  Eigen::SparseMatrix<double> stiffness(unknowns, unknowns);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd load = Eigen::VectorXd::Zero(unknowns);
  const auto area = lumped_masses(mesh.position, mesh.triangles, 1.0);
  for (int i = 0; i < n; ++i)
    if (unknown[i] >= 0) load[unknown[i]] = area[i];
  const Eigen::VectorXd bent = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(stiffness).solve(load);
  double sum = 0;
  int vertices = 0;
  for (int i = 0; i < n; ++i)
    if (mesh.position(i, 0) > 1 - 1e-9) {
      sum += bent[unknown[i]];
      ++vertices;
    }
  return sum / vertices;
}
Mesh strip(SheetPattern pattern, int columns, int rows) {
  const double height = pattern == SheetPattern::equilateral ? std::sqrt(0.75) : 1.0;
  return sheet({1.0, height * rows / columns}, {columns, rows}, pattern);
}

/// Given to 8 digits; the condition number of the stiffness is some n^4 = 4e7 times 2^-53.
TEST(Strip, OfRightAngledTrianglesDoesNotConverge) {  // a beam of length 1 - 1/2n: 1/8 of its 4th power
  EXPECT_NEAR(tip(strip(SheetPattern::crisscross, 20, 4), 1 / 20.0), 0.13654174, 1e-7);
  EXPECT_NEAR(tip(strip(SheetPattern::crisscross, 40, 8), 1 / 40.0), 0.14480690, 1e-7);
}
TEST(Strip, OfEquilateralTrianglesConvergesButForItsFreeEdges) {
  EXPECT_NEAR(tip(strip(SheetPattern::equilateral, 20, 16), 1.5 / 20), 0.11029814, 1e-7);
  EXPECT_NEAR(tip(strip(SheetPattern::equilateral, 80, 64), 1.5 / 80), 0.12467159, 1e-7);
}

}  // namespace
}  // namespace jetlag::testing::plates_test
