// SPDX-License-Identifier: MIT
#pragma once
// What a motion conserves, or should.

#include <optional>
#include <vector>

#include "jetlag/model/changing_elements.hpp"

namespace jetlag {

struct Energy {
  double kinetic = 0, potential = 0;  // [J]
  double total() const { return kinetic + potential; }
};

/// Measures the energy of a system: kinetic, and potential for the laws that have one.
class EnergyMeter {
 public:
  explicit EnergyMeter(const Model<double>& model);
  /// Of elements that come and go, those are counted that there are at a state when nothing is known of the motion before.
  explicit EnergyMeter(const System<double>& system);
  /// Goes on with another epoch of the model.
  void move_to(const Model<double>& model);
  /// Throws std::invalid_argument for a state of another shape.
  Energy operator()(const State<double>& state);

 private:
  explicit EnergyMeter(ModelAlong along);

  std::optional<ModelAlong> along_;  // of elements that come and go
  Model<double> model_;
  std::vector<std::optional<ElementBlocks<double>>>
      potentials_;                             // of the laws of the model; of those that have one
  AlignedVector<double> position_, velocity_;  // padded rows
};

/// sum_i m_i v_i [kg m/s]: shape (dimension).
Eigen::VectorXd momentum(const System<double>& system, const State<double>& state);

/// sum_i m_i x_i ^ v_i [kg m^2/s]: shape (1) in the plane, (3) in space, empty on a line.
Eigen::VectorXd angular_momentum(const System<double>& system, const State<double>& state);

}  // namespace jetlag
