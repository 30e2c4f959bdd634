// SPDX-License-Identifier: MIT
// Bounds of frequencies at a state, of laws that have no stiffness, against the eigenvalues of whole systems.
#include "jetlag/control/frequency_bound.hpp"

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "model/whole_tangent.hpp"
#include "support/eigenvalues.hpp"
#include "support/laws/elastic_box.hpp"
#include "support/laws/laws_of_many.hpp"
#include "support/problems.hpp"
#include "support/random.hpp"

namespace jetlag::testing::frequency_bound_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// The fastest frequency at a state [rad/s].
double fastest(const Model<double>& model, const State<double>& state) {
  return std::sqrt(std::max(0.0, largest_eigenvalue(over_masses(whole_tangent(model, state), model))));
}

double largest(const std::vector<double>& bounds) { return *std::ranges::max_element(bounds); }

/// A spring that does not say how stiff it is.
struct QuietSpring {
  static constexpr const char* name = "quiet spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness", "rest_length"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& k, const T& length) {
    return Spring::force(p, k, length);
  }
};

TEST(FrequencyBoundAtAState, IsThatOfAllStatesForSprings) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Problem scene = spring_cube(seed);
    EXPECT_FALSE(bounds_need_state(scene.system));
    EXPECT_EQ(frequency_bounds(scene.system, scene.start), frequency_bounds(scene.system));
    EXPECT_EQ(FrequencyMeter(scene.system)(scene.start), frequency_bound(scene.system));
    const auto of_elements = frequency_bounds_of_elements(scene.system, scene.start);
    ASSERT_EQ(of_elements.size(), scene.system.elements().size());
    EXPECT_EQ(largest(of_elements.front()), frequency_bound(scene.system));
  }
}

TEST(FrequencyBoundAtAState, OfSpringsByTheirTangentsIsTheSame) {
  // At rest length K = k (n; -n) (n; -n)^T, kappa = 2 k: the rule of springs. Rounding: eigenvalues of matrices of six rows,
  // some 6 roundings each of kappa, then of omega^2.
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Problem scene = spring_cube(seed);
    System<double> quiet(3, scene.system.mass());
    for (const auto& group : scene.system.elements()) {
      std::vector<std::array<int, 2>> pairs;
      std::vector<std::array<double, 2>> parameters;
      for (std::size_t e = 0; e < group.count(); ++e) {
        const int a = group.particles[2 * e], b = group.particles[2 * e + 1];
        pairs.push_back({a, b});
        parameters.push_back(
            {group.parameters[2 * e], (scene.start.position.row(a) - scene.start.position.row(b)).norm()});
      }
      quiet.add<QuietSpring>(pairs, parameters);
    }
    EXPECT_TRUE(bounds_need_state(quiet));
    const auto by_tangents = frequency_bounds(quiet, scene.start), known = frequency_bounds(scene.system);
    for (std::size_t i = 0; i < known.size(); ++i)
      EXPECT_NEAR(by_tangents[i], known[i], 64 * 0x1p-53 * known[i]) << "seed " << seed;
  }
}

// ---- bodies ------------------------------------------------------------------------------------------------

struct Body {
  std::array<int, 3> cells;
  std::array<double, 3> lengths;
  double poisson, omega, ratio;
};

TEST(FrequencyBoundAtAState, OfBodiesIsThatOfAnIndependentProgram) {
  for (const Body& body : {Body{{4, 4, 4}, {1, 1, 1}, 0.3, 138.8340, 1.369},
                           {{4, 4, 4}, {1, 1, 1}, 0.49, 523.6273, 1.531},
                           {{2, 2, 8}, {0.4, 0.4, 1.6}, 0.3, 175.1087, 1.356},
                           {{4, 4, 4}, {1, 1, 0.25}, 0.3, 435.8596, 1.231}}) {
    const auto box = jetlag::box(body.lengths, body.cells);
    const Model<double> model(elastic(box, 1e5, body.poisson, 1000));
    const double truth = fastest(model, at_rest(box)), bound = frequency_bound(model, at_rest(box));
    EXPECT_NEAR(truth, body.omega, 5e-5 * (1 + 1e-6));
    EXPECT_NEAR(bound / truth, body.ratio, 1e-3);  // one in the last place that it gave
  }
}

/// How far the particles of a body have gone from rest after 1500 steps of leapfrog, from velocities of 1e-8 m/s.
double distance_gone(double omega_h) {
  const auto box = jetlag::box({0.6, 0.4, 0.4}, {3, 2, 2});
  const System<double> system = elastic(box, 1e5, 0.3, 1000);
  State<double> state = at_rest(box);
  Uniform random(7);
  for (Eigen::Index i = 0; i < state.velocity.size(); ++i) state.velocity.data()[i] = random(-1e-8, 1e-8);
  Lockstep lockstep(std::make_unique<Leapfrog>(system, omega_h / fastest(system, state)));
  RunOptions options;
  options.max_steps = 1500;
  const Report report = lockstep.run(state, std::numeric_limits<double>::infinity(), options);
  if (report.outcome == Outcome::non_finite) return std::numeric_limits<double>::infinity();
  return (state.position - at_rest(box).position).cwiseAbs().maxCoeff();
}

TEST(FrequencyBoundAtAState, BoundsWhatLeapfrogDoesNotBlowUp) {
  // Linear as long as it is small. At .99 * 2 no mode goes farther than 1/sqrt(1 - .99^2) = 7.1 times its free flight, 1500 h
  // v < 2e-7 m; the sum over the modes is one of squares times masses, and the whole has up to 288 times the mass of a
  // particle. At 1.01 one mode grows by exp(2 acosh 1.01) = 1.33 a step, to where nothing is finite.
  EXPECT_LT(distance_gone(0.99 * 2), 7.1 * 2e-7 * std::sqrt(288.0));
  EXPECT_EQ(distance_gone(1.01 * 2), std::numeric_limits<double>::infinity());
}

// ---- mixtures ----------------------------------------------------------------------------------------------

/// Particles in a box with tetrahedra, angles, springs that say their stiffness and such that do not, and anchors; of masses
/// that differ by e^6, some fixed.
Problem mixture(std::uint64_t seed) {
  Uniform random(seed);
  const int n = 10;
  std::vector<double> mass(n);
  for (double& m : mass) m = std::exp(random(-3, 3));
  Problem scene{System<double>(3, mass), {0.0, Coordinates<double>(n, 3), Coordinates<double>::Zero(n, 3)}};
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) scene.start.position(i, c) = random(-1, 1);
  const auto strength = [&] { return std::exp(random(-3, 3)); };
  const auto others = [&](int i) {
    const int step = 1 + static_cast<int>(random(0, 3));
    return std::array{i, (i + step) % n, (i + 2 * step) % n, (i + 3 * step) % n};
  };
  for (int i = 0; i < n; ++i) {
    const auto [a, b, c, d] = others(i);
    if (random(0, 1) < 0.6)
      scene.system.add<Tetrahedron>({{a, b, c, d}}, {{100 * strength(), random(0, 0.2)}});
    if (random(0, 1) < 0.6) scene.system.add<AngleByHand>({{a, b, c}}, {{strength(), random(-1, 1)}});
    if (random(0, 1) < 0.4) scene.system.add<Spring>({{a, d}}, {{strength(), 0.5}});
    if (random(0, 1) < 0.4) scene.system.add<QuietSpring>({{b, d}}, {{strength(), 0.5}});
    if (random(0, 1) < 0.2) scene.system.add<Anchors>({{a, c}}, {{strength()}});
    if (random(0, 1) < 0.2) scene.system.fix(i);
  }
  return scene;
}

TEST(FrequencyBoundAtAState, HoldsForRandomMassesAndMixtures) {
  // Eigenvalues are known to some n roundings of the largest, here of 30 rows and of at most the loads of some 10 elements.
  const double rounding = 1 - 300 * 0x1p-53;
  double loosest = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Problem scene = mixture(seed);
    const Model<double> model(scene.system);
    const double truth = fastest(model, scene.start), bound = frequency_bound(model, scene.start);
    EXPECT_GE(bound, truth * rounding) << "seed " << seed;
    loosest = std::max(loosest, bound / truth);
    const auto of_particles = frequency_bounds(model, scene.start);
    double of_elements = 0;
    for (const auto& law : frequency_bounds_of_elements(model, scene.start))
      if (!law.empty()) of_elements = std::max(of_elements, largest(law));
    EXPECT_EQ(largest(of_particles), bound);
    EXPECT_EQ(of_elements, bound);
  }
  EXPECT_LE(loosest, 3.0);  // and is of use
  EXPECT_GE(loosest, 1.05);
}

TEST(FrequencyBoundAtAState, HoldsAlongAMotionWithWeightsOfItsStart) {
  const Problem scene = mixture(4);
  const Model<double> model(scene.system);
  FrequencyMeter meter(model);
  State<double> state = scene.start;
  Uniform random(2);
  for (int n = 0; n < 100; ++n) {
    const double bound = meter(state), truth = fastest(model, state);
    EXPECT_GE(bound, truth * (1 - 300 * 0x1p-53) * (1 - 1e-9));
    EXPECT_EQ(FrequencyMeter(meter)(state), meter(state));  // a copy goes on as the first
    if (n == 0) {
      EXPECT_NEAR(bound, frequency_bound(model, state), 1e-9 * bound);
    }
    for (Eigen::Index i = 0; i < state.position.size(); ++i) state.position.data()[i] += random(-0.1, 0.1);
  }
}

/// F = (c y - k x^3, -c x): at x = 0 the tangent is not zero, but its symmetric part is.
struct TurningCubic {
  static constexpr const char* name = "turning cubic";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"turn", "stiffness"};
  static constexpr std::array dimensions{2};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& c, const T& k) {
    const T &x = p.position[0][0], &y = p.position[0][1];
    return Vector<T, D>(T(c * y) - T(k * x * x * x), T(-c * x));
  }
};

TEST(FrequencyBoundAtAState, IsFoundAnewWhereItWasZero) {  // then sqrt(3 k x^2 / m)
  System<double> system(2, {2.0});
  system.add<TurningCubic>({{0}}, {{1.0, 6.0}});
  FrequencyMeter meter(system);
  State<double> state{0.0, Coordinates<double>::Zero(1, 2), Coordinates<double>::Zero(1, 2)};
  EXPECT_EQ(meter(state), 0.0);
  state.position(0, 0) = 1;
  EXPECT_NEAR(meter(state), 3.0, 1e-9 * 3);  // largest_square is known to 1e-9
}

// ---- errors ------------------------------------------------------------------------------------------------

TEST(FrequencyBoundAtAState, IsNotKnownWhereATangentIsNotFinite) {
  System<double> system(3, {1.0, 1.0});
  system.add<QuietSpring>({{0, 1}}, {{1.0, 1.0}});
  const State<double> state{0.0, Coordinates<double>::Zero(2, 3), Coordinates<double>::Zero(2, 3)};
  EXPECT_THAT([&] { frequency_bound(system, state); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("the tangent of quiet spring is not finite")));
  EXPECT_TRUE(std::isnan(FrequencyMeter(system)(state)));
}

TEST(FrequencyBoundAtAState, LeavesOutWhatSaysThatItIsUnbounded) {
  Problem scene = dumbbell(8.0, 1.0, 2.0);
  scene.system.add<Gravity>({{0, 1}}, {{1e-9}});
  scene.system.add<Drag>({{0}}, {{0.1}});
  scene.system.add<UniformField>({{0}}, {{1.0, 0.0, 0.0}});
  EXPECT_FALSE(bounds_need_state(scene.system));
  EXPECT_EQ(frequency_bound(scene.system, scene.start), std::sqrt(12.0));
  EXPECT_THAT(frequency_bounds_of_elements(scene.system, scene.start)[1], ::testing::ElementsAre(0.0));
}

}  // namespace
}  // namespace jetlag::testing::frequency_bound_test
