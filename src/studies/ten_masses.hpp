// SPDX-License-Identifier: MIT
#pragma once
// A chain on which asynchronous variational integrators are tried: methods 8.

#include <array>
#include <cmath>
#include <vector>

#include "jetlag/model/system.hpp"

namespace jetlag {

/// V = k (s^2/2 + s^4/4) of a spring of rest length 1 with extension s.
struct Hardening {
  static constexpr const char* name = "hardening spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness"};
  static constexpr int stiffness_parameter = 0;  // at rest length

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T length = d.norm(), s = length - 1.0;
    return T(stiffness * (s + s * s * s) / length) * d;
  }
  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T s = d.norm() - 1.0, square = s * s;
    return stiffness * (0.5 * square + 0.25 * square * square);
  }
};

/// Ten free unit masses on a line, hardening springs of 1 and 100 in turn, velocities 0.1 sin(1 + i^2) shifted to the
/// mean 0.05. Energy 0.040064470729897, momentum 0.5.
struct TenMasses {
  System<double> system{1, std::vector<double>(10, 1.0)};
  State<double> start{0.0, Coordinates<double>(10, 1), Coordinates<double>(10, 1)};

  TenMasses() {
    std::vector<std::array<int, 2>> pairs;
    std::vector<std::array<double, 1>> stiffness;
    for (int i = 0; i < 9; ++i) {
      pairs.push_back({i, i + 1});
      stiffness.push_back({i % 2 == 0 ? 1.0 : 100.0});
    }
    system.add<Hardening>(pairs, stiffness);
    for (int i = 0; i < 10; ++i) {
      start.position(i, 0) = i;
      start.velocity(i, 0) = 0.1 * std::sin(1.0 + i * i);
    }
    start.velocity.array() += 0.05 - start.velocity.mean();
  }
  /// At which all clocks of courant_steps(system, f) ring: steps of the stiff springs are a tenth of the soft ones [s].
  static double common_period(double f) { return f * 2 / std::sqrt(2.0); }
};

}  // namespace jetlag
