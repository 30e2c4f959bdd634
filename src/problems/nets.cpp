// SPDX-License-Identifier: MIT
#include "problems/nets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "jetlag/forces/spring.hpp"
#include "jetlag/truncation/draws.hpp"

namespace jetlag::problems {

namespace {

/// Numbers in [-1/2, 1/2), the same everywhere.         Source: Knuth's MMIX generator.
class Disturbance {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) * 0x1p-53 - 0.5;
  }

 private:
  std::uint64_t state_ = 12345;
};

}  // namespace

Problem spring_cube(std::uint64_t seed) {
  std::uint64_t drawn = 0;
  const auto random = [&](double low, double high) { return low + (high - low) * uniform(seed, 0, drawn++); };
  std::vector<double> mass(8);
  for (double& m : mass) m = random(1.0, 2.0);
  System<double> system(3, mass);
  State<double> start = at_origin(system);
  for (int i = 0; i < 8; ++i)
    for (int c = 0; c < 3; ++c) {
      start.position(i, c) = ((i >> c) & 1) + random(-0.1, 0.1);
      start.velocity(i, c) = random(-0.2, 0.2);
    }
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 2>> springs;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < i; ++j) {
      pairs.push_back({j, i});
      springs.push_back({random(1.0, 3.0), (start.position.row(i) - start.position.row(j)).norm()});
    }
  system.add<Spring>(pairs, springs);
  return {std::move(system), std::move(start)};
}

Problem cloth(int side) {
  constexpr double spacing = 0.1, stiffness = 5e3;  // [m], [N/m]
  const auto particle = [&](int i, int j) { return i * side + j; };

  System<double> system(3, std::vector<double>(side * side, 1.0));
  State<double> start = at_origin(system);
  Disturbance disturbance;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      auto x = start.position.row(particle(i, j));
      x[0] = (i + 0.01 * disturbance()) * spacing;
      x[1] = (j + 0.01 * disturbance()) * spacing;
      x[2] = 0.02 * std::sin(3.0 * i * spacing) * std::cos(2.0 * j * spacing);
      start.velocity(particle(i, j), 2) = 0.1 * disturbance();
    }

  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 2>> springs;
  const auto connect = [&](int i, int j, int other_i, int other_j) {
    if (std::max(i, other_i) >= side || std::max(j, other_j) >= side) return;
    pairs.push_back({particle(i, j), particle(other_i, other_j)});
    springs.push_back({stiffness, spacing * std::hypot(other_i - i, other_j - j)});
  };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      connect(i, j, i + 1, j);
      connect(i, j, i, j + 1);
      connect(i, j, i + 1, j + 1);
      connect(i + 1, j, i, j + 1);
      connect(i, j, i + 2, j);
      connect(i, j, i, j + 2);
    }
  system.add<Spring>(pairs, springs);
  return {std::move(system), std::move(start)};
}

Problem cloth_with_a_stiff_patch() {
  constexpr int side = 50, first = 16, last = 27;
  constexpr double spacing = 0.1, pi = std::numbers::pi;
  System<double> system(3, std::vector<double>(side * side, 1.0));
  State<double> start = at_origin(system);
  const auto in_patch = [](int i) { return first <= i && i <= last; };
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 2>> springs;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const double x = static_cast<double>(i) / side, y = static_cast<double>(j) / side;
      start.position.row(i * side + j) << spacing * i, spacing * j, 0.0;
      start.velocity.row(i * side + j) << 0.1 * std::sin(3 * y), 0.1 * std::cos(4 * x),
          0.3 * std::sin(pi * x) * std::sin(2 * pi * y);
      for (const auto& [a, b] : {std::pair(0, 1), {1, 0}, {1, 1}, {1, -1}, {0, 2}, {2, 0}}) {
        const int k = i + a, l = j + b;
        if (k >= side || l < 0 || l >= side) continue;
        const bool stiff = in_patch(i) && in_patch(j) && in_patch(k) && in_patch(l);
        pairs.push_back({i * side + j, k * side + l});
        springs.push_back({stiff ? 5e3 : 5.0, spacing * std::hypot(a, b)});
      }
    }
  system.add<Spring>(pairs, springs);
  Problem problem{std::move(system), std::move(start)};
  problem.until = 4;
  problem.largest_step = 0.25;
  return problem;
}

}  // namespace jetlag::problems
