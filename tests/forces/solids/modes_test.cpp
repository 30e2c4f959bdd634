// SPDX-License-Identifier: MIT
// Small vibrations and small loads of meshes of linear elements: how far they are from those of the body is known, mesh by
// mesh (M. Geradin, D. Rixen, Mechanical Vibrations, chapter 5; R. Cook, Improved two-dimensional finite element,
// J. Struct. Div. ASCE 100 (1974) 1851).
#include <gtest/gtest.h>

#include <cmath>

#include "forces/solids/bodies.hpp"
#include "forces/solids/vibrations.hpp"

namespace jetlag::testing::modes_test {
namespace {

using namespace solids;

/// The standard material, held where x = 0.
Vibrations held(const Mesh& mesh, double ratio) {
  System<double> system(3, lumped_masses(mesh.position, mesh.tetrahedra, density));
  const auto [lambda, mu] = lame(young, ratio);
  system.add_at_rest<Stvk>(mesh.tetrahedra, mesh.position, {{lambda, mu}});
  for (int i = 0; i < system.particles(); ++i)
    if (mesh.position(i, 0) == 0) system.fix(i);
  return {system, {0.0, mesh.position, Coordinates<double>::Zero(mesh.position.rows(), 3)}};
}

/// Iterations beside a value that is known to ten digits, at a distance of 1e-3 of it, find it to some 1e-10 in two or three
/// steps; 1e-7 are asked for. That no frequency is lower tell iterations towards zero: their quotient never is below the
/// lowest, and is at most a tenth above it after six, whatever two or three modes near the lowest there are.
void expect_lowest(const Vibrations& body, double omega) {
  const double square = omega * omega;
  EXPECT_NEAR(std::sqrt(body.square_beside(0.999 * square, 8, body.mixture())), omega, 1e-7 * omega);
  const double lowest = std::sqrt(body.square_beside(0.0, 6, body.mixture()));
  EXPECT_GT(lowest, (1 - 1e-7) * omega);
  EXPECT_LT(lowest, 1.1 * omega);
}

/// The same from above, of a value known to some five digits: after 200 iterations with K the quotient is within a hundredth.
void expect_highest(const Vibrations& body, double omega) {
  const double beside = std::pow(1.0001 * omega, 2);
  EXPECT_NEAR(std::sqrt(body.square_beside(beside, 8, body.mixture())), omega, 1e-5 * omega);
  const double highest = std::sqrt(body.square_below_largest(200, body.mixture()));
  EXPECT_LT(highest, (1 + 1e-5) * omega);
  EXPECT_GT(highest, 0.99 * omega);
}

struct Cantilever {
  int cells;
  double poisson, lowest, highest;  // [1], [1/s]
};

/// Bending of linear elements locks: Euler and Bernoulli's beam has 2.029972 /s, the meshes 1.741, 1.255 and 1.062 times
/// that, with orders 1.5 and 2.0; nearly incompressible ones 3.7 to 2.8 times.
TEST(Cantilever, VibratesAsItsMeshDoes) {
  for (const auto& [k, nu, lowest, highest] :
       {Cantilever{1, 0.3, 3.533498246, 181.439}, Cantilever{2, 0.3, 2.548482468, 350.214},
        Cantilever{4, 0.3, 2.156490845, 693.753}, Cantilever{1, 0.499, 7.521281971, 0},
        Cantilever{2, 0.499, 7.024291495, 0}, Cantilever{4, 0.499, 5.734378793, 8223.0415}}) {
    SCOPED_TRACE(::testing::Message() << k << " cells across, Poisson's ratio " << nu);
    const Vibrations beam = held(jetlag::box({1, 0.2, 0.2}, {5 * k, k, k}), nu);
    expect_lowest(beam, lowest);
    if (highest > 0) expect_highest(beam, highest);
  }
}

/// pi/2 sqrt(E/rho)/L = 15.70796 /s of the rod, from below.
TEST(LongitudinalMode, ConvergesFromBelow) {
  const double omega[] = {15.01502830, 15.56352264, 15.67740525};
  for (int n = 0; n < 3; ++n) {
    const int k = 1 << n;
    const Mesh mesh = jetlag::box({1, 0.5, 0.5}, {2 * k, k, k});
    const Vibrations bar = held(mesh, 0.0);
    Eigen::VectorXd wave = Eigen::VectorXd::Zero(bar.unknowns());
    for (int i = 0; i < mesh.position.rows(); ++i)
      if (const int row = bar.row(i, 0); row >= 0) wave[row] = std::sin(std::acos(0.0) * mesh.position(i, 0));
    const double square = omega[n] * omega[n];
    EXPECT_NEAR(std::sqrt(bar.square_beside(0.999 * square, 8, wave)), omega[n], 1e-7 * omega[n]);
    // The wave itself is so near the mode that its quotient is at most 4 % above.
    EXPECT_LT(bar.quotient(wave), 1.04 * square);
    EXPECT_GT(bar.quotient(wave), 0.96 * square);
  }
}

/// Cook's membrane: how far the middle of the loaded edge goes.
double cook(int n, bool cut_along_the_long_way) {
  Mesh mesh = jetlag::rectangle({1, 1}, {n, n});
  for (auto&& x : mesh.position.rowwise()) {
    const double u = x[0], v = cut_along_the_long_way ? x[1] : 1 - x[1];
    x = Eigen::RowVector2d(48 * u, 44 * u + v * (44 - 28 * u));
  }
  if (!cut_along_the_long_way)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  System<double> system(2, std::vector<double>(mesh.position.rows(), 1.0));
  const Lame<double> of = plane_stress(lame(1.0, 1.0 / 3));
  system.add_at_rest<PlaneStvk>(mesh.triangles, mesh.position, {{of.lambda, of.mu, 1.0}});
  for (int i = 0; i <= n; ++i) system.fix(i);
  const Vibrations membrane(system, {0.0, mesh.position, Coordinates<double>::Zero(mesh.position.rows(), 2)});
  Eigen::VectorXd load = Eigen::VectorXd::Zero(membrane.unknowns());
  for (int j = 0; j <= n; ++j) load[membrane.row(n * (n + 1) + j, 1)] = (j == 0 || j == n ? 0.5 : 1.0) / n;
  return membrane.under(load)[membrane.row(n * (n + 1) + n / 2, 1)];
}

TEST(CooksMembrane, GoesAsFarAsItsMeshLetsIt) {  // towards 23.96
  const double by_refinement[] = {11.99280262, 18.28368045, 22.02241814,
                                  23.41200020, 23.81549356, 23.92412404};
  for (int level = 0; level < 6; ++level) {
    const double found = cook(2 << level, false);
    EXPECT_NEAR(found, by_refinement[level], 1e-7 * found) << (2 << level);
  }
  EXPECT_NEAR(cook(2, true), 6.74253006, 1e-7 * 7);
  EXPECT_NEAR(cook(8, true), 17.33116292, 1e-7 * 17);
}

}  // namespace
}  // namespace jetlag::testing::modes_test
