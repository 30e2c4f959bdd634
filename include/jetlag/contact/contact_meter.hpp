// SPDX-License-Identifier: MIT
#pragma once
// What contacts do at a state: how near particles are to others, and how hard they are pushed.

#include "jetlag/model/changing_elements.hpp"

namespace jetlag {

class ContactMeter {
 public:
  /// Keeps no reference to the system. Counted are the elements of its barriers (contact_barrier.hpp) that there are at a state
  /// when nothing is known of the motion before.
  explicit ContactMeter(const System<double>& system);

  /// Throws std::invalid_argument for a state of another shape, and where something is no more than its gap apart.
  void measure(const State<double>& state);

  /// Of each particle the smallest gap of the elements that it is of [m]; infinite where it is of none.
  const std::vector<double>& gap() const { return gap_; }
  /// On each particle, fixed ones too [N], shape (particles, dimension).
  const Coordinates<double>& force() const { return force_; }

 private:
  void add(const Model<double>::Law& law, const State<double>& state);

  ModelAlong along_;
  AlignedVector<double> position_, velocity_, sum_;  // padded rows
  std::vector<double> gap_;
  Coordinates<double> force_;
};

}  // namespace jetlag
