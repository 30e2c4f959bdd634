// SPDX-License-Identifier: MIT
#pragma once
// Motions that are known, and what kinks make of their steps.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "jetlag/model/kinks.hpp"

namespace jetlag::testing {

/// Motions that are known: coefficients of polynomials in the time since `now`, [particle][order][component].
struct Polynomials final : Paths {
  int dimension;
  double time = 0;
  std::vector<std::vector<std::vector<double>>> c;
  mutable std::size_t asked = 0;

  explicit Polynomials(int d) : dimension(d) {}
  double now() const override { return time; }
  void at(int particle, double s, double* x) const override {
    ++asked;
    for (int d = 0; d < dimension; ++d) {
      x[d] = 0;
      for (std::size_t n = c[particle].size(); n-- > 0;) x[d] = x[d] * s + c[particle][n][d];
    }
  }
  void velocity(int particle, double* v) const override {
    for (int d = 0; d < dimension; ++d) v[d] = c[particle][1][d];
  }
  double curve(int particle, double h) const {
    double sum = 0;
    for (std::size_t n = 2; n < c[particle].size(); ++n)
      for (double x : c[particle][n]) sum += std::abs(x) * std::pow(h, static_cast<double>(n));
    return sum;
  }
  Kinks::Step step(int particle, double h) const { return {particle, h, curve(particle, h)}; }
  bool take(Kinks& kinks, int particle, double h) const {
    return kinks.take(step(particle, h), time, c[particle][0].data(), c[particle][1].data());
  }
};

inline System<double> masses(int dimension, int count) {
  return System<double>(dimension, std::vector<double>(count, 1.0));
}

inline double shortened(const System<double>& system, const Polynomials& paths, double h, double depth) {
  Kinks kinks(system);
  std::vector<Kinks::Step> steps;
  for (int i = 0; i < system.particles(); ++i)
    if (!system.fixed()[i]) steps.push_back(paths.step(i, h));
  EXPECT_TRUE(kinks.shorten(steps, depth, paths).empty());
  for (const Kinks::Step& step : steps) h = std::min(h, step.h);
  return h;
}

}  // namespace jetlag::testing
