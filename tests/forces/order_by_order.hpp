// SPDX-License-Identifier: MIT
#pragma once
// What free bodies keep in each order of their series.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

#include "jetlag/motion/expansion.hpp"

namespace jetlag::testing {

/// sum_i m_i x_i^(k) = 0 and sum_i (x_i x m_i x_i'')^(k) = 0. Rounding of each of some 27 particles, by that of its some 24
/// elements, is 2^-53 of its largest force a time: 1e-14 of the largest term leaves a factor of 90.
inline void expect_momentum_by_order(const System<double>& system, const State<double>& state) {
  using Eigen::RowVector3d;
  constexpr int degree = 16;
  Expansion<> motion(system, degree);
  motion.start(state);
  motion.grow_to(degree);
  const auto& mass = system.mass();
  const auto row = [&](int k, int i) { return RowVector3d(motion.position(k).row(i)); };
  for (int k = 2; k <= degree; ++k) {
    RowVector3d momentum = RowVector3d::Zero(), turn = RowVector3d::Zero();
    double largest = 0, largest_turn = 0;
    for (int i = 0; i < system.particles(); ++i) {
      momentum += mass[i] * row(k, i);
      largest = std::max(largest, mass[i] * row(k, i).norm());
      for (int j = 0; j <= k - 2; ++j) {
        const double factor = mass[i] * (k - j) * (k - j - 1);
        turn += factor * row(j, i).cross(row(k - j, i));
        largest_turn = std::max(largest_turn, factor * row(j, i).norm() * row(k - j, i).norm());
      }
    }
    EXPECT_GT(largest, 0) << "order " << k;
    EXPECT_LE(momentum.norm(), 1e-14 * largest) << "order " << k;
    EXPECT_LE(turn.norm(), 1e-14 * largest_turn) << "order " << k;
  }
}

}  // namespace jetlag::testing
