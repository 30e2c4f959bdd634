// SPDX-License-Identifier: MIT
#pragma once
// The forces of some elements of a system, and their exact Jacobians, entry by entry.
//
// Coefficient 1 of the forces along x(t) = x + t u, v(t) = v + t w is dF/dx u + dF/dv w. Particles of one colour share
// no neighbour: one such product gives a column for each of them (Curtis, Powell, Reid, IMA J. Appl. Math. 13 (1974)
// 117). They are coloured when a Jacobian is asked for, which costs the sum over particles of their neighbours'
// neighbours. Elements of three and more participants would need too many colours: their tangents are taken one by one.

#include <cstdint>
#include <functional>
#include <vector>

#include "jetlag/model/model.hpp"
#include "model/element_tangents.hpp"

namespace jetlag {

/// dF of component `row` / d of component `column`; components of all particles are numbered particle * dimension + c.
struct JacobianEntry {
  int row, column;
  double value;
};

class ElementJacobian {
 public:
  /// wanted(particles of an element): whether it is one of them. column(particle): whether `derivatives` are wanted by
  /// its position and velocity; of all that move where it is left out.
  ElementJacobian(
      const Model<double>& model, const std::function<bool(std::span<const int>)>& wanted,
      const std::function<bool(int)>& column = [](int) { return true; });

  /// Whether an element acts on a particle, and whether forces depend on velocities.
  bool touches(int particle) const { return touched_[particle]; }
  bool reads_velocity() const { return reads_velocity_; }

  /// The forces at a state [N], shape (particles, dimension); those on fixed particles are among them.
  Coordinates<double> force(const State<double>& state);

  /// dF/dx u + dF/dv w at the state of the last `force`, shapes (particles, dimension). Fixed particles go in no
  /// direction.
  Coordinates<double> product(const Coordinates<double>& u, const Coordinates<double>& w);

  /// Their derivatives at the state of the last `force`, by positions or by velocities of moving particles, on moving
  /// particles. Entries of the same row and column are to be added up.
  enum class By { position, velocity };
  void derivatives(By by, std::vector<JacobianEntry>& entries);

  std::uint64_t element_coefficients() const { return element_coefficients_; }

 private:
  void run(ElementBlocks<double>& law, int k);
  void run(int k);
  void run_coloured();
  void colour();
  void add_tangents(By by, std::vector<JacobianEntry>& entries);
  Coordinates<double> result() const;

  int particles_, dimension_, stride_;
  std::vector<ElementBlocks<double>> laws_;
  std::vector<ElementTangents> tangents_;  // of those of three and more participants
  std::vector<bool> touched_, fixed_, is_column_;
  bool reads_velocity_ = false;
  std::vector<std::vector<int>> neighbours_;  // moving ones in coloured elements, of moving particles
  std::vector<std::vector<int>> rows_;        // wanted moving particle: those that it acts upon, itself first
  std::vector<std::vector<int>> colours_;     // the particles of each
  bool is_coloured_ = false;
  AlignedVector<double> x_, v_, f_;  // orders 0 and 1; padded rows
  State<double> state_;              // of the last `force`
  std::uint64_t element_coefficients_ = 0;
};

}  // namespace jetlag
