// SPDX-License-Identifier: MIT
#pragma once
// Forces along quantized states: a polynomial for each pair of particles that act upon each other, renewed where one
// of the two has changed.
//
//        i --- link --- j         the force on the second one, about the time at which it was last computed
//        |
//       own                       what acts on i alone
//
// Laws that read velocities are kept apart from the others: only these have to follow a change of a velocity.

#include <array>
#include <functional>
#include <vector>

#include "jetlag/model/model.hpp"

namespace jetlag {

class QuantizedForces {
 public:
  /// The quantized polynomial of a position (kind 0) or velocity (1) about a time, into `orders` numbers at the
  /// distance `next`.
  using Signal = std::function<void(int kind, int particle, double time, double* to, std::size_t next)>;

  /// orders: coefficients of the forces, 1 to 3.
  QuantizedForces(const Model<double>& model, int orders, Signal signal);

  /// Computes anew all forces about `time` that depend on the position of a moving particle (kind 0), or on its
  /// velocity (1). Where one is not finite all stay as they were, and the result is false.
  bool renew(int kind, int particle, double time);

  /// Who was pushed by the last `renew`: moving particles, each once.
  const std::vector<int>& pushed() const { return pushed_; }

  /// The acceleration of a moving particle about a time, component by component; orders beyond `orders` are 0.
  std::array<std::array<double, 3>, 3> acceleration(int particle, double time) const;

  std::uint64_t element_coefficients() const { return element_coefficients_; }

 private:
  /// The force polynomial of a pair on its second particle, or of one particle.
  struct Force {
    int first, second;  // first -1: one particle
    double time = 0;
    std::array<std::array<double, 3>, 3> c{};  // [order][component]
  };
  /// Laws that read velocities, or that do not.
  struct Part {
    std::vector<std::size_t> laws;
    std::vector<Force> forces;
    std::vector<std::vector<int>> of;  // particle: those that act on it, its own one first
  };

  void add_links(Part& part);
  void run(const Part& part, int particle, double time);
  void fill(const Part& part, int particle, double time);

  Model<double> model_;
  int orders_, stride_;
  Signal signal_;
  std::array<Part, 2> parts_;                // without and with velocities
  std::vector<ElementBlocks<double>> laws_;  // none of the elements yet
  std::vector<int> places_, pushed_;
  std::vector<bool> seen_;
  std::size_t rows_ = 0;
  AlignedVector<double> x_, v_;               // [order][row][padded component]
  std::array<AlignedVector<double>, 2> f_{};  // of each part
  std::uint64_t element_coefficients_ = 0;
};

}  // namespace jetlag
