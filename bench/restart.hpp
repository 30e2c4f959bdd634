// SPDX-License-Identifier: MIT
#pragma once
// The way without a tape: the force law called anew, at every order, on jets as long as the series is known.

#include <array>
#include <string>
#include <vector>

#include "jetlag/model/system.hpp"

namespace jetlag::bench {

/// The series of a motion in space by restarts: coefficient k of the force costs O(k^2), the series O(N^3).
class JetRestart {
 public:
  static constexpr int max_degree = 32;
  static constexpr int dimension = 3;

  explicit JetRestart(const System<double>& system);

  /// Coefficients 0 .. degree of all positions, degree <= max_degree.
  void expand(const State<double>& state, int degree);

  /// Coefficients of component c of the position of particle i.
  const std::array<double, max_degree + 1>& series(int i, int c) const { return motion_.position[i][c]; }

  struct Motion {
    std::vector<double> mass;  // [particle]
    std::vector<std::array<std::array<double, max_degree + 1>, dimension>>
        position;                                      // [particle][component][order]
    std::vector<std::array<double, dimension>> force;  // newest coefficient
  };

 private:
  /// Adds coefficient k of the forces of some elements; one such function for each k.
  using AddForces = void (*)(Motion&, const Elements<double>&);
  using Orders = std::array<AddForces, max_degree - 1>;

  template <class Law>
  static const Orders& orders();
  static const Orders& orders_of(const std::string& law);

  std::vector<Elements<double>> elements_;
  std::vector<const Orders*> laws_;
  std::vector<double> inverse_mass_;
  Motion motion_;
};

}  // namespace jetlag::bench
