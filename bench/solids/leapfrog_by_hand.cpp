// SPDX-License-Identifier: MIT
#include "leapfrog_by_hand.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "jetlag/forces/forces.hpp"

namespace jetlag::bench {

LeapfrogByHand::LeapfrogByHand(const Problem& problem)
    : start_(problem.start),
      particles_(problem.system.particles()),
      x_(4 * particles_),
      v_(4 * particles_),
      a_(4 * particles_) {
  const Elements<double>& all = problem.system.elements().at(0);
  if (all.law.name != NeoHookean::name) throw std::invalid_argument("LeapfrogByHand: neo_hookean only");
  for (int i = 0; i < particles_; ++i)
    inverse_mass_.push_back(problem.system.fixed()[i] ? 0.0 : 1 / problem.system.mass()[i]);
  const int count = static_cast<int>(all.count());
  for (int first = 0; first < count; first += lanes) {
    Block& block = blocks_.emplace_back();
    block.elements = std::min<int>(lanes, count - first);
    for (int lane = 0; lane < lanes; ++lane) {
      const int e = std::min(first + lane, count - 1);
      for (int i = 0; i < 4; ++i) block.row[i][lane] = 4 * all.particles[4 * e + i];
      for (int p = 0; p < 9; ++p) block.parameters[p][lane] = all.parameters[9 * e + p];
    }
  }
}

/// The forces of forces/solids/neo_hookean.hpp, divided by the masses.
#if defined(__x86_64__)
__attribute__((target_clones("avx512f", "avx2", "default")))
#endif
void LeapfrogByHand::accelerate() {
  std::ranges::fill(a_, 0.0);
  for (const Block& block : blocks_) {
    Lanes d[3][3], c[3][3];
    for (int k = 0; k < 3; ++k) {
      Lanes last;
      for (int lane = 0; lane < lanes; ++lane) last[lane] = x_[block.row[3][lane] + k];
      for (int i = 0; i < 3; ++i) {
        for (int lane = 0; lane < lanes; ++lane) d[i][k][lane] = x_[block.row[i][lane] + k];
        d[i][k] -= last;
      }
    }
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        const Lanes *a = d[(i + 2) % 3], *b = d[(i + 1) % 3];
        c[i][k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
      }
    const auto& p = block.parameters;
    const Lanes delta = d[0][0] * c[0][0] + d[0][1] * c[0][1] + d[0][2] * c[0][2], ratio = delta / p[6];
    Lanes logarithm;
    for (int lane = 0; lane < lanes; ++lane) logarithm[lane] = std::log(ratio[lane]);
    const Lanes pull = (p[8] - p[7] * logarithm) / delta;
    for (int k = 0; k < 3; ++k) {
      const Lanes f[3] = {pull * c[0][k] - p[0] * d[0][k] - p[1] * d[1][k] - p[2] * d[2][k],
                          pull * c[1][k] - p[1] * d[0][k] - p[3] * d[1][k] - p[4] * d[2][k],
                          pull * c[2][k] - p[2] * d[0][k] - p[4] * d[1][k] - p[5] * d[2][k]};
      for (int lane = 0; lane < block.elements; ++lane) {
        for (int i = 0; i < 3; ++i) a_[block.row[i][lane] + k] += f[i][lane];
        a_[block.row[3][lane] + k] -= f[0][lane] + f[1][lane] + f[2][lane];
      }
    }
  }
  for (int i = 0; i < particles_; ++i)
    for (int k = 0; k < 3; ++k) a_[4 * i + k] *= inverse_mass_[i];
}

Coordinates<double> LeapfrogByHand::run(double h, int steps) {
  for (int i = 0; i < particles_; ++i)
    for (int k = 0; k < 3; ++k) {
      x_[4 * i + k] = start_.position(i, k);
      v_[4 * i + k] = start_.velocity(i, k);
    }
  accelerate();
  for (int step = 0; step < steps; ++step) {
    for (std::size_t n = 0; n < x_.size(); ++n) {
      v_[n] += h / 2 * a_[n];
      x_[n] += h * v_[n];
    }
    accelerate();
    for (std::size_t n = 0; n < x_.size(); ++n) v_[n] += h / 2 * a_[n];
  }
  Coordinates<double> position(particles_, 3);
  for (int i = 0; i < particles_; ++i)
    for (int k = 0; k < 3; ++k) position(i, k) = x_[4 * i + k];
  return position;
}

}  // namespace jetlag::bench
