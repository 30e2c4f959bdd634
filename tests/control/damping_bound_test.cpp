// SPDX-License-Identifier: MIT
// Bounds of damping against the eigenvalues of whole systems.
#include "jetlag/control/damping_bound.hpp"

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "jetlag/control/frequency_bound.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "model/whole_tangent.hpp"
#include "support/eigenvalues.hpp"
#include "support/laws/cubic_friction.hpp"
#include "support/laws/elastic_box.hpp"
#include "support/problems.hpp"
#include "support/random.hpp"

namespace jetlag::testing::damping_bound_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Eigenvalues of M^-1/2 C M^-1/2 [1/s], ascending.
Eigen::VectorXd dampings(const Model<double>& model, const State<double>& state) {
  return eigenvalues(over_masses(whole_tangent(model, state, Input::Kind::velocity), model));
}

/// A damper along the line between two particles, F = -c (w . n) n, and a turn of velocities in the plane, F = c (-v_y, v_x).
struct Dashpot {
  static constexpr const char* name = "dashpot";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"coefficient"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& c) {
    const Vector<T, D> d = p.position[1] - p.position[0], w = p.velocity[1] - p.velocity[0];
    return T(c * d.dot(w) / d.squaredNorm()) * d;
  }
};
struct Turn {
  static constexpr const char* name = "turn";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"coefficient"};
  static constexpr std::array dimensions{2};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& c) {
    return Vector<T, D>(T(-c * p.velocity[0][1]), T(c * p.velocity[0][0]));
  }
};

// ---- one number for each element -----------------------------------------------------------------------------

TEST(DampingBound, OfProportionalViscosityIsThatOfTheFrequency) {
  // C = b K at rest, so that gamma_e = b omega_e^2 for the same shares; eigenvalues of 12 rows are known to some 12 roundings.
  const double b = 3e-3;  // [s]
  for (const auto& [cells, poisson] : {std::pair{std::array{4, 4, 4}, 0.3}, {{2, 2, 8}, 0.49}}) {
    const auto box = jetlag::box({1, 0.8, 1.1}, cells);
    System<double> system = elastic(box, 1e5, poisson, 1000);
    const double omega = frequency_bound(system, at_rest(box));
    const Lame<double> of = lame(b * 1e5, poisson);
    system.add_at_rest<KelvinVoigt>(box.tetrahedra, box.position, {{of.lambda, of.mu}});
    const Model<double> model(system);
    EXPECT_TRUE(damping_needs_state(model));
    const double bound = DampingMeter(model)(at_rest(box));
    EXPECT_NEAR(bound, b * omega * omega, 64 * 0x1p-53 * bound + 1e-9 * bound);
    EXPECT_GE(bound, dampings(model, at_rest(box)).maxCoeff());
  }
}

TEST(DampingBound, OfCubicFrictionIsExact) {  // 3 c |v|^2 / m, of the fastest per mass
  System<double> system(2, {2.0, 0.5});
  system.add<CubicFriction>({{0}, {1}}, {{4.0}, {0.25}});
  State<double> state{0.0, Coordinates<double>::Zero(2, 2), Coordinates<double>(2, 2)};
  state.velocity << 3, 4, 0, 8;
  DampingMeter meter(system);
  EXPECT_NEAR(meter(state), 3 * 4.0 * 25 / 2.0, 1e-9 * 150);
  state.velocity.row(0).setZero();
  EXPECT_NEAR(meter(state), 3 * 0.25 * 64 / 0.5, 1e-9 * 96);
  EXPECT_EQ(DampingMeter(meter)(state), meter(state));
}

/// Masses that differ by e^6, some fixed; tetrahedra that are viscous and elastic, dashpots, friction, drag of some or of all.
Problem mixture(std::uint64_t seed) {
  Uniform random(seed);
  const int n = 10;
  std::vector<double> mass(n);
  for (double& m : mass) m = std::exp(random(-3, 3));
  Problem scene{System<double>(3, mass), {0.0, Coordinates<double>(n, 3), Coordinates<double>(n, 3)}};
  Coordinates<double> rest(n, 3);
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) {
      rest(i, c) = random(-1, 1);
      scene.start.position(i, c) = rest(i, c) + random(-0.2, 0.2);
      scene.start.velocity(i, c) = random(-1, 1);
    }
  const auto strength = [&] { return std::exp(random(-3, 3)); };
  for (int i = 0; i < n; ++i) {
    const int step = 1 + static_cast<int>(random(0, 3));
    std::array all{i, (i + step) % n, (i + 2 * step) % n, (i + 3 * step) % n};
    if (random(0, 1) < 0.6) {
      const Eigen::Vector3d a = rest.row(all[1]) - rest.row(all[0]), b = rest.row(all[2]) - rest.row(all[0]),
                            c = rest.row(all[3]) - rest.row(all[0]);
      if (a.cross(b).dot(c) < 0) std::swap(all[0], all[1]);
      scene.system.add_at_rest<KelvinVoigt>({all}, rest, {{strength(), strength()}});
    }
    if (random(0, 1) < 0.4) scene.system.add<Dashpot>({{i, all[3]}}, {{strength()}});
    if (random(0, 1) < 0.4) scene.system.add<CubicFriction>({{i}}, {{strength()}});
    if (seed % 2 == 0 || random(0, 1) < 0.4) scene.system.add<Drag>({{i}}, {{strength()}});
    if (random(0, 1) < 0.2) scene.system.fix(i);
  }
  return scene;
}

TEST(DampingBound, HoldsForRandomMassesAndMixtures) {
  // Eigenvalues are known to some 30 roundings of the largest, which is at most some 10 elements' loads.
  const double rounding = 300 * 0x1p-53;
  std::vector<double> over;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Problem scene = mixture(seed);
    const Model<double> model(scene.system);
    const Eigen::VectorXd all = dampings(model, scene.start);
    const auto fixed = std::ranges::count(scene.system.fixed(), true) * 3;  // their rows are zero
    const double most = all.maxCoeff(), least = all(fixed);
    const double bound = DampingMeter(model)(scene.start);
    EXPECT_GE(bound, most * (1 - rounding)) << "seed " << seed;
    EXPECT_LE(least_damping(model), least + rounding * most) << "seed " << seed;
    EXPECT_TRUE(seed % 2 == 1 || least_damping(model) > 0.0);
    over.push_back(bound / most);
    EXPECT_NEAR(std::ranges::max(DampingMeter(model).of_particles(scene.start)), bound, 1e-9 * bound);
    EXPECT_NO_THROW(require_damping(model, scene.start));
  }
  std::ranges::sort(
      over);  // and is of use, though tetrahedra are of any shape and masses differ by e^6: measured 2.2
  EXPECT_LE(over[50], 3.0);
}

TEST(DampingBound, HoldsAlongAMotionWithWeightsOfItsStart) {
  const Problem scene = mixture(4);
  const Model<double> model(scene.system);
  DampingMeter meter(model), of_particles(model);
  State<double> state = scene.start;
  Uniform random(2);
  for (int n = 0; n < 100; ++n) {
    const double truth = dampings(model, state).maxCoeff() * (1 - 300 * 0x1p-53) * (1 - 1e-9);
    EXPECT_GE(meter(state), truth);
    EXPECT_GE(std::ranges::max(of_particles.of_particles(state)), truth);
    for (Eigen::Index i = 0; i < state.position.size(); ++i) {
      state.position.data()[i] += random(-0.1, 0.1);
      state.velocity.data()[i] += random(-0.3, 0.3);
    }
  }
}

TEST(DampingBound, OfDragIsThatOfAllStates) {
  Problem scene = dumbbell(8.0, 1.0, 2.0);
  EXPECT_EQ(least_damping(scene.system), 0.0);
  scene.system.add<Drag>({{0}, {1}}, {{0.3}, {0.8}});
  EXPECT_FALSE(damping_needs_state(scene.system));
  EXPECT_EQ(least_damping(scene.system), 0.3);
  EXPECT_EQ(damping_bound(scene.system), 0.4);
  EXPECT_THAT(damping_bounds(scene.system), ::testing::ElementsAre(0.3, 0.4));
  EXPECT_EQ(DampingMeter(scene.system)(scene.start), 0.4);
  scene.system.fix(0);
  EXPECT_EQ(least_damping(scene.system), 0.4);
  scene.system.fix(1);
  EXPECT_EQ(least_damping(scene.system), 0.0);
}

// ---- errors ------------------------------------------------------------------------------------------------

TEST(DampingBound, IsRefusedForWhatDoesMoreThanDamp) {
  System<double> system(2, {1.0});
  const auto state = [](double v) {
    return State<double>{0.5, Coordinates<double>::Zero(1, 2), Coordinates<double>::Constant(1, 2, v)};
  };
  system.add<Turn>({{0}}, {{1.0}});
  EXPECT_THAT([&] { require_damping(system, state(1)); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("turn depends on velocities and does more than damp them at t = 0.5")));
  System<double> driven(2, {1.0});
  driven.add<CubicFriction>({{0}}, {{-1.0}});
  EXPECT_NO_THROW(require_damping(driven, state(0)));
  EXPECT_THAT([&] { require_damping(driven, state(1)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("cubic friction")));
}

TEST(DampingBound, IsNotKnownWhereATangentIsNotFinite) {
  System<double> system(2, {1.0, 1.0});
  system.add<Dashpot>({{0, 1}}, {{1.0}});
  const State<double> state{0.0, Coordinates<double>::Zero(2, 2), Coordinates<double>::Zero(2, 2)};
  EXPECT_THAT(
      [&] { require_damping(system, state); },
      ThrowsMessage<std::invalid_argument>(HasSubstr("the tangent of dashpot by velocities is not finite")));
  EXPECT_TRUE(std::isnan(DampingMeter(system)(state)));
  EXPECT_TRUE(DampingMeter(system).of_particles(state).empty());
}

}  // namespace
}  // namespace jetlag::testing::damping_bound_test
