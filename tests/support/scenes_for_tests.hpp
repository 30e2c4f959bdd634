// SPDX-License-Identifier: MIT
#pragma once
// Small scenes whose motion is known in closed form, and springs for the laws that hold in any motion.

#include <Eigen/Core>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "jetlag/forces/drag.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/forces/uniform_field.hpp"
#include "jetlag/model/system.hpp"
#include "jetlag/truncation/draws.hpp"

namespace jetlag::testing {

/// A system and where it starts.
struct Scene {
  System<double> system;
  State<double> start;
};

// ---- laws that only tests need ----------------------------------------------------------------------------

/// F = -k x;   E = k/2 x^2. Linear: the motion is that of harmonic oscillators, exactly.
struct Tether {
  static constexpr const char* name = "tether";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"stiffness"};
  static constexpr int stiffness_parameter = 0;

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& stiffness) {
    return T(-stiffness) * p.position[0];
  }

  template <class T, int D>
  static T energy(const Participants<T, D, 1>& p, const T& stiffness) {
    return T(0.5) * stiffness * p.position[0].squaredNorm();
  }
};

/// F = 2 m |x|^2 x. From x = 1, x' = 1 on a line: x = 1 / (1 - t), every coefficient is 1.
struct CubicPush {
  static constexpr const char* name = "cubic push";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    return T(T(2.0) * p.mass[0] * p.position[0].squaredNorm()) * p.position[0];
  }
};

/// F = m cos(omega t) in the first direction.
struct Shaker {
  static constexpr const char* name = "shaker";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"frequency"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& frequency) {
    using std::cos;
    Vector<T, D> f = T(0.0) * p.position[0];
    f[0] = p.mass[0] * cos(T(frequency * p.time));
    return f;
  }
};

// ---- oscillators ------------------------------------------------------------------------------------------

/// x'' = -omega^2 x on a line, from x and v.
inline Scene oscillator(double omega = 1.0, double x = 1.0, double v = 0.0) {
  System<double> system(1, {1.0});
  system.add<Tether>({{0}}, {{omega * omega}});
  return {std::move(system),
          {0.0, Coordinates<double>::Constant(1, 1, x), Coordinates<double>::Constant(1, 1, v)}};
}

/// Round a circle of radius 1 at angular speed omega: the size of every derivative is constant.
inline Scene circular_oscillator(double omega = 1.0) {
  System<double> system(2, {1.0});
  system.add<Tether>({{0}}, {{omega * omega}});
  Scene scene{std::move(system), {0.0, Coordinates<double>(1, 2), Coordinates<double>(1, 2)}};
  scene.start.position << 1.0, 0.0;
  scene.start.velocity << 0.0, omega;
  return scene;
}

// ---- two bodies -------------------------------------------------------------------------------------------

/// A planet round a fixed sun (particle 0) at the origin: semi-major axis 1, period 2 pi, eccentricity e,
/// from the pericentre. The energy is -1/2.
inline Scene planet(double e) {
  System<double> system(2, {1.0, 1.0});
  system.fix(0);
  system.add<Gravity>({{0, 1}}, {{1.0}});
  Scene scene{std::move(system), {0.0, Coordinates<double>::Zero(2, 2), Coordinates<double>::Zero(2, 2)}};
  scene.start.position(1, 0) = 1.0 - e;
  scene.start.velocity(1, 1) = std::sqrt((1.0 + e) / (1.0 - e));
  return scene;
}

/// Where that planet is: Kepler's equation  E - e sin E = t,
///     x = (cos E - e, sqrt(1 - e^2) sin E),   v = (-sin E, sqrt(1 - e^2) cos E) / (1 - e cos E).
/// Solved in 80 bits, so that the truth has more digits than what is compared with it.
struct KeplerPoint {
  Eigen::RowVector2d position, velocity;
};

inline KeplerPoint kepler(double e, double t) {
  using Real = long double;
  const Real turn = boost::math::constants::two_pi<Real>();
  const Real mean = std::remainder(static_cast<Real>(t), turn);
  const auto f = [&](Real anomaly) {
    return std::pair(anomaly - e * std::sin(anomaly) - mean, 1 - e * std::cos(anomaly));
  };
  const Real anomaly = boost::math::tools::newton_raphson_iterate(
      f, mean + e * std::sin(mean), mean - e, mean + e, std::numeric_limits<Real>::digits - 1);
  const Real c = std::cos(anomaly), s = std::sin(anomaly), b = std::sqrt((1 - Real(e)) * (1 + Real(e)));
  const Real distance = 1 - e * c;
  KeplerPoint point;
  point.position << static_cast<double>(c - e), static_cast<double>(b * s);
  point.velocity << static_cast<double>(-s / distance), static_cast<double>(b * c / distance);
  return point;
}

/// Two bodies of masses 1 and 3, `distance` apart at rest. They meet at pi/2 sqrt(distance^3 / (2 * 4)).
inline Scene falling_together(double distance) {
  System<double> system(2, {1.0, 3.0});
  system.add<Gravity>({{0, 1}}, {{1.0}});
  Scene scene{std::move(system), {0.0, Coordinates<double>::Zero(2, 2), Coordinates<double>::Zero(2, 2)}};
  scene.start.position(1, 0) = distance;
  return scene;
}
inline double time_of_collision(double distance) {
  return std::numbers::pi / 2 * std::sqrt(distance * distance * distance / 8.0);
}

// ---- particles and springs --------------------------------------------------------------------------------

/// One particle thrown into a uniform field: x = x_0 + v_0 t + g t^2 / 2.
inline Scene free_fall() {
  System<double> system(3, {2.0});
  system.add<UniformField>({{0}}, {{0.5, -0.25, -9.75}});
  Scene scene{std::move(system), {0.0, Coordinates<double>(1, 3), Coordinates<double>(1, 3)}};
  scene.start.position << 1.0, 2.0, 3.0;
  scene.start.velocity << -1.0, 0.5, 4.0;
  return scene;
}

/// Two masses on a line, a spring of rest length 1 between them, stretched by 0.2: as long as the masses do
/// not pass each other the motion is linear, of frequency sqrt(k (1/m_0 + 1/m_1)).
inline Scene dumbbell(double stiffness, double mass_0, double mass_1) {
  System<double> system(1, {mass_0, mass_1});
  system.add<Spring>({{0, 1}}, {{stiffness, 1.0}});
  Scene scene{std::move(system), {0.0, Coordinates<double>::Zero(2, 1), Coordinates<double>::Zero(2, 1)}};
  scene.start.position(1, 0) = 1.2;
  return scene;
}

/// Eight particles near the corners of a cube, all pairs at rest length, moving slowly; masses, stiffnesses
/// (1 .. 3) and velocities from the seed. Nothing acts from outside. Its frequencies are below 7.
inline Scene spring_cube(std::uint64_t seed) {
  std::uint64_t drawn = 0;
  const auto random = [&](double low, double high) { return low + (high - low) * uniform(seed, 0, drawn++); };
  std::vector<double> mass(8);
  for (double& m : mass) m = random(1.0, 2.0);
  System<double> system(3, mass);
  Scene scene{std::move(system), {0.0, Coordinates<double>(8, 3), Coordinates<double>(8, 3)}};
  for (int i = 0; i < 8; ++i)
    for (int c = 0; c < 3; ++c) {
      scene.start.position(i, c) = ((i >> c) & 1) + random(-0.1, 0.1);
      scene.start.velocity(i, c) = random(-0.2, 0.2);
    }
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 2>> springs;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < i; ++j) {
      pairs.push_back({j, i});
      springs.push_back(
          {random(1.0, 3.0), (scene.start.position.row(i) - scene.start.position.row(j)).norm()});
    }
  scene.system.add<Spring>(pairs, springs);
  return scene;
}

}  // namespace jetlag::testing
