// SPDX-License-Identifier: MIT
#include "scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "jetlag/forces/gravity.hpp"
#include "jetlag/forces/spring.hpp"

namespace jetlag::bench {

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

std::size_t Scene::elements() const {
  std::size_t count = 0;
  for (const auto& elements : system.elements()) count += elements.count();
  return count;
}

Scene cloth(int side) {
  constexpr double spacing = 0.1, stiffness = 5e3;  // [m], [N/m]
  const auto particle = [&](int i, int j) { return i * side + j; };

  State<double> state{0.0, Coordinates<double>::Zero(side * side, 3),
                      Coordinates<double>::Zero(side * side, 3)};
  Disturbance disturbance;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      auto x = state.position.row(particle(i, j));
      x[0] = (i + 0.01 * disturbance()) * spacing;
      x[1] = (j + 0.01 * disturbance()) * spacing;
      x[2] = 0.02 * std::sin(3.0 * i * spacing) * std::cos(2.0 * j * spacing);
      state.velocity(particle(i, j), 2) = 0.1 * disturbance();
    }

  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 2>> parameters;
  const auto connect = [&](int i, int j, int other_i, int other_j) {
    if (std::max(i, other_i) >= side || std::max(j, other_j) >= side) return;
    pairs.push_back({particle(i, j), particle(other_i, other_j)});
    parameters.push_back({stiffness, spacing * std::hypot(other_i - i, other_j - j)});
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

  System<double> system(3, std::vector<double>(side * side, 1.0));
  system.add<Spring>(pairs, parameters);
  return {"cloth" + std::to_string(side), std::move(system), std::move(state)};
}

Scene kepler() {
  State<double> state{0.0, Coordinates<double>(2, 3), Coordinates<double>(2, 3)};
  state.position << -0.2, 0.1, 0.05, 0.6, -0.3, -0.15;
  state.velocity << 0.1, 0.3, -0.2, -0.3, -0.9, 0.6;
  System<double> system(3, {3.0, 1.0});
  system.add<Gravity>({{0, 1}}, {{1.0}});
  return {"kepler", std::move(system), std::move(state)};
}

Scene planar_kepler() {
  State<double> state{0.0, Coordinates<double>(2, 2), Coordinates<double>(2, 2)};
  state.position << 0, 0, 0.5, 0;
  state.velocity << 0, 0, 0, std::sqrt(3.0);
  System<double> system(2, {1.0, 1e-9});
  system.add<Gravity>({{0, 1}}, {{1.0}});
  return {"planar_kepler", std::move(system), std::move(state)};
}

Scene solar() {
  const std::vector<double> mass{1.00000597682,      0.000954786104043,  0.000285583733151,
                                 0.0000437273164546, 0.0000517759138449, 1 / 1.3e8};
  State<double> state{0.0, Coordinates<double>(6, 3), Coordinates<double>(6, 3)};
  state.position << 0, 0, 0,                 //
      -3.5023653, -3.8169847, -1.5507963,    //
      9.0755314, -3.0458353, -1.6483708,     //
      8.3101420, -16.2901086, -7.2521278,    //
      11.4707666, -25.7294829, -10.8169456,  //
      -15.5387357, -25.2225594, -3.1902382;
  state.velocity << 0, 0, 0,                 //
      0.00565429, -0.00412490, -0.00190589,  //
      0.00168318, 0.00483525, 0.00192462,    //
      0.00354178, 0.00137102, 0.00055029,    //
      0.00288930, 0.00114527, 0.00039677,    //
      0.00276725, -0.00170702, -0.00136504;
  std::vector<std::array<int, 2>> pairs;
  for (int i = 0; i < 6; ++i)
    for (int j = i + 1; j < 6; ++j) pairs.push_back({i, j});
  System<double> system(3, mass);
  system.add<Gravity>(pairs, {{2.95912208286e-4}});
  return {"solar", std::move(system), std::move(state)};
}

namespace {
struct SineOfAngle {
  static constexpr const char* name = "sine of angle";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    using std::sin;
    Vector<T, D> f;
    for (int c = 0; c < D; ++c) f[c] = -sin(p.position[0][c]);
    return f;
  }
};
}  // namespace

Scene pendulum() {
  State<double> state{0.0, Coordinates<double>::Constant(1, 1, 1.3), Coordinates<double>::Zero(1, 1)};
  System<double> system(1, {1.0});
  system.add<SineOfAngle>({{0}}, {{}});
  return {"pendulum", std::move(system), std::move(state)};
}

Uneven chain() {
  constexpr int moving = 128;
  Uneven scene{System<double>(1, std::vector<double>(moving + 2, 1.0)),
               {0.0, Coordinates<double>::Zero(moving + 2, 1), Coordinates<double>::Zero(moving + 2, 1)},
               20,
               1.25,
               0.005};
  scene.system.fix(0);
  scene.system.fix(moving + 1);
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 1>> stiffness;
  for (int i = 0; i <= moving; ++i) {
    pairs.push_back({i, i + 1});
    stiffness.push_back({i >= 60 && i < 64 ? 1e4 : 1.0});
  }
  scene.system.add<CubicSpring>(pairs, stiffness);
  for (int i = 1; i <= moving; ++i)
    scene.state.position(i, 0) = 0.1 * std::sin(std::numbers::pi * i / (moving + 1) * 2) +
                                 0.02 * std::sin(std::numbers::pi * i / (moving + 1) * 9);
  return scene;
}

Scene scene(const std::string& name) {
  if (name.starts_with("cloth")) return cloth(std::stoi(name.substr(5)));
  if (name == "kepler") return kepler();
  if (name == "planar_kepler") return planar_kepler();
  if (name == "solar") return solar();
  if (name == "pendulum") return pendulum();
  throw std::invalid_argument("scene: '" + name +
                              "' is not one of cloth<side>, kepler, planar_kepler, solar, pendulum");
}

}  // namespace jetlag::bench
