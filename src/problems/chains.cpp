// SPDX-License-Identifier: MIT
// Source of the ends: Taylor series in 75-digit arithmetic, each repeated at a second order, but where a closed form is
// named.
#include "problems/chains.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "jetlag/forces/spring.hpp"
#include "problems/laws.hpp"

namespace jetlag::problems {

namespace {

constexpr double pi = std::numbers::pi;

/// `moving` unit masses, particles 1 to `moving`, between two walls.
System<double> between_walls(int moving) {
  System<double> system(1, std::vector<double>(moving + 2, 1.0));
  system.fix(0);
  system.fix(moving + 1);
  return system;
}

/// (0, 1), (1, 2) .. of so many particles.
std::vector<std::array<int, 2>> neighbours(int particles) {
  std::vector<std::array<int, 2>> pairs;
  for (int i = 0; i + 1 < particles; ++i) pairs.push_back({i, i + 1});
  return pairs;
}

Problem moving_chain(System<double> system) {
  State<double> start = at_origin(system);
  return {std::move(system), std::move(start)};
}

}  // namespace

Problem line(const std::vector<double>& mass, const std::vector<double>& stiffness) {
  std::vector<double> all{1.0};
  all.insert(all.end(), mass.begin(), mass.end());
  const bool second_wall = stiffness.size() > mass.size();
  if (second_wall) all.push_back(1.0);
  System<double> system(1, all);
  system.fix(0);
  if (second_wall) system.fix(system.particles() - 1);
  std::vector<std::array<double, 1>> parameters;
  for (const double k : stiffness) parameters.push_back({k});
  system.add<LinearSpring>(neighbours(system.particles()), parameters);
  return moving_chain(std::move(system));
}

Problem chain_between_walls(const std::vector<double>& stiffness) {
  System<double> system = between_walls(static_cast<int>(stiffness.size()) - 1);
  std::vector<std::array<double, 2>> springs;
  for (const double k : stiffness) springs.push_back({k, 1.0});
  system.add<Spring>(neighbours(system.particles()), springs);
  Problem chain = moving_chain(std::move(system));
  for (int i = 0; i < chain.system.particles(); ++i) chain.start.position(i, 0) = i;
  return chain;
}

/// q(t) = cos(sqrt(K) t) q(0), K = [[101, -1], [-1, 2]]: of eigenvalues w^2 = (103 +- s)/2, s = sqrt(99^2 + 4), whose product
/// is 201, and, as K is symmetric, of projections (K - w_slow^2) / s and what is left. In 80 bits: w t is 1e4.
Problem resonant_chain() {
  using Real = long double;
  Problem chain = line({1, 1}, {100, 1, 1});
  chain.until = 1000;
  const Real x = 1, y = -0.5, s = std::sqrt(Real(9805));
  const Real fast = (103 + s) / 2, slow = 201 / fast;
  const Real fast_x = ((101 - slow) * x - y) / s, fast_y = ((2 - slow) * y - x) / s;
  const auto at_end = [&](Real of_fast, Real of_slow) {
    return static_cast<double>(std::cos(std::sqrt(fast) * chain.until) * of_fast +
                               std::cos(std::sqrt(slow) * chain.until) * of_slow);
  };
  chain.start.position.col(0) << 0, 1, -0.5, 0;
  chain.end = Coordinates<double>{{0}, {at_end(fast_x, x - fast_x)}, {at_end(fast_y, y - fast_y)}, {0}};
  chain.stiff = {1};
  chain.slow = {2};
  return chain;
}

Problem light_mass() {
  Problem chain = line({1, 1e-6}, {1, 1});
  chain.start.velocity(1, 0) = 1;
  chain.until = 100;
  chain.end = Coordinates<double>{{0}, {-0.5064085032404720146348}, {-0.5063947665026834389444}};
  chain.stiff = {2};
  chain.slow = {1};
  return chain;
}

Problem stiff_spring() {
  Problem chain = line({1, 1}, {1, 1e6});
  chain.start.position(2, 0) = 1e-3;
  chain.start.velocity(1, 0) = 1;
  chain.until = 100;
  chain.end = Coordinates<double>{{0}, {0.7062645918419748759951}, {0.7074878714915396950005}};
  chain.stiff = {1, 2};
  return chain;
}

Problem stiff_spot_in_a_chain(int moving, double ratio) {
  System<double> system = between_walls(moving);
  std::vector<std::array<double, 1>> stiffness;
  for (int i = 0; i <= moving; ++i)
    stiffness.push_back({i >= moving / 2 - 4 && i < moving / 2 ? ratio : 1.0});
  system.add<CubicSpring>(neighbours(moving + 2), stiffness);
  Problem chain = moving_chain(std::move(system));
  for (int i = 1; i <= moving; ++i)
    chain.start.position(i, 0) =
        0.1 * std::sin(pi * i / (moving + 1) * 2) + 0.02 * std::sin(pi * i / (moving + 1) * 9);
  return chain;
}

Problem fput() {
  System<double> system = between_walls(32);
  system.add<CubicSpring>(neighbours(34), {{1.0}});
  Problem chain = moving_chain(std::move(system));
  for (int i = 1; i <= 32; ++i)
    chain.start.position(i, 0) = 0.1 * std::sin(2 * pi * i / 33) + 0.02 * std::sin(9 * pi * i / 33);
  chain.until = 496;
  chain.largest_step = 1.24;
  return chain;
}

Problem fput_alpha() {
  System<double> system = between_walls(32);
  system.add<QuadraticSpring>(neighbours(34), {{0.25}});
  Problem chain = moving_chain(std::move(system));
  for (int j = 1; j <= 32; ++j) chain.start.position(j, 0) = std::sin(pi * j / 33);
  chain.until = 100;
  return chain;
}

/// x_0 and x_1: mean and difference of each stiff pair, over sqrt(2).
Problem stiff_and_soft_springs() {
  constexpr double omega = 50, r = std::numbers::sqrt2 / 2;
  const auto masses = [](const std::array<double, 3>& mean, const std::array<double, 3>& difference) {
    Coordinates<double> all = Coordinates<double>::Zero(8, 1);
    for (int i = 0; i < 3; ++i) {
      all(2 * i + 1, 0) = r * (mean[i] - difference[i]);
      all(2 * i + 2, 0) = r * (mean[i] + difference[i]);
    }
    return all;
  };
  System<double> system = between_walls(6);
  std::vector<std::array<double, 2>> springs;
  for (int i = 0; i < 7; ++i)
    springs.push_back(i % 2 == 0 ? std::array{0.0, 4.0} : std::array{omega * omega / 2, 0.0});
  system.add<Duffing>(neighbours(8), springs);
  Problem chain{std::move(system), {0.0, masses({1, 0, 0}, {1 / omega, 0, 0}), masses({1, 0, 0}, {1, 0, 0})}};
  chain.until = 10;
  chain.end =
      masses({1.04205763710250895438097, 0.243635570363191095817151, -0.106360437964649122662849},
             {-0.0275579312012517383034702, -0.0005927177946675771468034, 0.000395054059610075512822745});
  return chain;
}

Problem ten_masses() {
  System<double> system(1, std::vector<double>(10, 1.0));
  std::vector<std::array<double, 1>> stiffness;
  for (int i = 0; i < 9; ++i) stiffness.push_back({i % 2 == 0 ? 1.0 : 100.0});
  system.add<HardeningSpring>(neighbours(10), stiffness);
  Problem chain = moving_chain(std::move(system));
  for (int i = 0; i < 10; ++i) {
    chain.start.position(i, 0) = i;
    chain.start.velocity(i, 0) = 0.1 * std::sin(1.0 + i * i);
  }
  chain.start.velocity.array() += 0.05 - chain.start.velocity.mean();
  return chain;
}

double common_period_of_ten_masses(double f) { return f * 2 / std::sqrt(2.0); }

}  // namespace jetlag::problems
