// SPDX-License-Identifier: MIT
#pragma once
// Networks in which some particles are much faster than others.

#include <numbers>

#include "support/scenes_for_tests.hpp"

namespace jetlag::testing {

/// F = k (1 + |d|^2) d: of no rest length, so that the ends may pass each other.
struct CubicSpring {
  static constexpr const char* name = "cubic spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return T(stiffness * (1.0 + d.squaredNorm())) * d;
  }
};

/// `moving` unit masses between two walls (particles 0 and moving + 1), at displacements of two long waves, at rest;
/// four springs in the middle are stiffer.         Source: methods 15b, with 128 masses.
inline Scene stiff_spot_in_a_chain(int moving, double ratio) {
  System<double> system(1, std::vector<double>(moving + 2, 1.0));
  system.fix(0);
  system.fix(moving + 1);
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 1>> stiffness;
  for (int i = 0; i <= moving; ++i) {
    pairs.push_back({i, i + 1});
    stiffness.push_back({i >= moving / 2 - 4 && i < moving / 2 ? ratio : 1.0});
  }
  system.add<CubicSpring>(pairs, stiffness);
  Scene scene{std::move(system),
              {0.0, Coordinates<double>::Zero(moving + 2, 1), Coordinates<double>::Zero(moving + 2, 1)}};
  for (int i = 1; i <= moving; ++i)
    scene.start.position(i, 0) = 0.1 * std::sin(std::numbers::pi * i / (moving + 1) * 2) +
                                 0.02 * std::sin(std::numbers::pi * i / (moving + 1) * 9);
  return scene;
}

/// The same scene with particle i called number[i]; the order of the elements stays.
inline Scene renumbered(const Scene& scene, const std::vector<int>& number) {
  const int particles = scene.system.particles();
  std::vector<double> mass(particles);
  for (int i = 0; i < particles; ++i) mass[number[i]] = scene.system.mass()[i];
  Scene result{System<double>(scene.system.dimension(), mass), scene.start};
  for (int i = 0; i < particles; ++i) {
    if (scene.system.fixed()[i]) result.system.fix(number[i]);
    result.start.position.row(number[i]) = scene.start.position.row(i);
    result.start.velocity.row(number[i]) = scene.start.velocity.row(i);
  }
  for (Elements<double> elements : scene.system.elements()) {
    for (int& particle : elements.particles) particle = number[particle];
    result.system.add(elements.law, elements.particles, elements.parameters);
  }
  return result;
}

}  // namespace jetlag::testing
