// SPDX-License-Identifier: MIT
#pragma once
// What somebody would write who needs one method, one law and no more: leapfrog of neo-Hookean tetrahedra, eight at a time.

#include <array>
#include <vector>

#include "../problems.hpp"

namespace jetlag::bench {

class LeapfrogByHand {
 public:
  /// A system whose first law is NeoHookean, in space.
  explicit LeapfrogByHand(const Problem& problem);

  /// `steps` steps of h [s] from the start of the problem; positions [m], shape (particles, 3).
  Coordinates<double> run(double h, int steps);

 private:
  static constexpr int lanes = 8;
  typedef double Lanes __attribute__((vector_size(64)));
  struct Block {
    std::array<std::array<int, lanes>, 4> row;  // four numbers a particle
    alignas(64) Lanes parameters[9];            // of NeoHookean
    int elements;                               // the others repeat the last
  };

  void accelerate();

  State<double> start_;
  int particles_;
  std::vector<double> inverse_mass_, x_, v_, a_;  // 0 of what is fixed; four numbers a particle
  std::vector<Block> blocks_;
};

}  // namespace jetlag::bench
